// SPDX-License-Identifier: GPL-3.0-or-later
// BusPlan: the buses of a build, and what a host may choose; BusMap: the host's channel of each actuator.
#pragma once
#include "Core/Limits.h"
#include "ModuleIdentity.h"
#include <array>
#include <juce_audio_processors/juce_audio_processors.h>
#include <vector>

namespace physvib {

struct BusPlan {
    using Kind = ModuleIdentity::Buses;
    Kind kind = Kind::oneBus;
    int channels = 4;           ///< of the one bus, until the host asks for others; LV2 hosts cannot ask
    bool hasMusicPorts = false; ///< whether an LV2 build has two ports for music, which cannot be off

    static constexpr int maxBusChannels = 16; // VST3 gives up to 19 speakers names; LV2 and hosts stop at 16
    static constexpr int busCount = 15;       // stereo: 32 channels cost memory in every block (decision 12)
    static constexpr int initialBusCount = 2; // for four actuators; the host may enable the others
};

/// A set of `channels` channels whose order `format` preserves. VST3: the first N speaker types, since
/// discrete channels arrive permuted, or crash hosts that set no arrangement (decision 12). Any thread.
juce::AudioChannelSet channelsInOrder(int channels, juce::AudioProcessor::WrapperType format);

struct OutputBus {
    juce::String name;
    juce::AudioChannelSet channels;
    bool isOn = true;
};

/// The buses of a new instance. Any thread.
std::vector<OutputBus> newBuses(const BusPlan& plan, juce::AudioProcessor::WrapperType format);

/// True if music can come in: by a side chain, which is off until a host turns it on; in LV2, whose ports
/// are never off, by a build with ports for it. Any thread.
bool hasSideChain(const BusPlan& plan, juce::AudioProcessor::WrapperType format) noexcept;

/// True if every channel of `layout` would arrive at its actuator. Any thread.
bool isAccepted(const BusPlan& plan, juce::AudioProcessor::WrapperType format,
                const juce::AudioProcessor::BusesLayout& layout);

/// For each actuator its channel in the process block; -1: not connected. A bus that is off still counts its
/// channels, so that the actuators of later buses stay where they are.
struct BusMap {
    std::array<int, limits::maxActuators> channels{};

    BusMap() { channels.fill(-1); }
    /// Reads the present buses. M, while nothing is rendered.
    explicit BusMap(const juce::AudioProcessor& processor);
    /// How many of the first `actuators` are connected. Any thread.
    int connectedCount(int actuators) const noexcept;
    /// The number of actuators before the first that is not connected. Any thread.
    int leadingConnected() const noexcept;
};

} // namespace physvib
