// SPDX-License-Identifier: GPL-3.0-or-later
// Output buses of a build: which exist, which arrangements a host may choose, and the output of each channel.
#pragma once
#include "Core/Limits.h"
#include <array>
#include <juce_audio_processors/juce_audio_processors.h>
#include <vector>

namespace physvib {

/// One bus of 1 to 16 channels, or many buses of one or two for hosts that know no wider ones.
struct BusPlan {
    enum class Kind { oneBus, manyBuses };
    Kind kind = Kind::oneBus;
    int channels = 4;           ///< of the one bus until the host asks for another width; LV2 cannot ask
    bool hasMusicPorts = false; ///< of LV2, whose ports cannot be off: two for music are always on

    static constexpr int widestBus = 16; // VST3 gives up to 19 speakers names; LV2 and hosts stop at 16
    static constexpr int busCount = 15;  // stereo: 32 channels cost memory in every block (decision 12)
    static constexpr int busesOfANewInstance = 2; // the thesis' four enchanters; the host enables the others
};

/// `channels` channels as a set that `format` carries in this order. VST3: the first N speaker types;
/// discrete channels arrive permuted or crash hosts that set no arrangement (decision 12). Any thread.
juce::AudioChannelSet channelsInOrder(int channels, juce::AudioProcessor::WrapperType format);

struct OutputBus {
    juce::String name;
    juce::AudioChannelSet channels;
    bool isOn = true;
};

/// The buses of a new instance. Any thread.
std::vector<OutputBus> busesOf(const BusPlan& plan, juce::AudioProcessor::WrapperType format);

/// Whether music can come in: by a side chain, which is off until a host turns it on; in LV2, which has no
/// ports that are off, by a build with ports for it. Any thread.
bool hasSideChain(const BusPlan& plan, juce::AudioProcessor::WrapperType format) noexcept;

/// Whether every channel of `layout` would arrive where it should. Any thread.
bool isAccepted(const BusPlan& plan, juce::AudioProcessor::WrapperType format,
                const juce::AudioProcessor::BusesLayout& layout);

/// For each enchanter the channel of the process block that it leaves by; -1: not connected. A bus that is
/// off keeps its places, so that enchanters behind it stay where they are.
struct BusMap {
    std::array<int, limits::maxEnchanters> channelOf{};

    BusMap() { channelOf.fill(-1); }
    /// M, while nothing is rendered.
    explicit BusMap(const juce::AudioProcessor& processor);
    /// How many of the first `enchanters` are connected. Any thread.
    int connected(int enchanters) const noexcept;
    /// The number of actuators before the first that is not connected. Any thread.
    int leading() const noexcept;
};

} // namespace physvib
