// SPDX-License-Identifier: MIT
// Assignment of device outputs to actuators and listeners; settings and status of an AudioOutput.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include "Live/Devices/AudioDevice.h"
#include "Stimuli/PinkNoise.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Sources on outputs that drive no actuator: noise and contact sounds for listeners, which may share an
/// output, and marks for measuring devices.
enum class ListeningSource { noise, contacts, marks };
constexpr std::size_t listeningSourceCount = 3;

/// Device outputs from 0, per ListeningSource.
using ListeningOutputs = std::array<std::vector<int>, listeningSourceCount>;

/// Message thread (M), except channelOf() (any thread) and play() (render thread, R).
class OutputMap {
public:
    OutputMap() {
        for (auto& channel : channels_) channel = -1;
        for (auto& source : listeningChannels_)
            for (auto& channel : source) channel = -1;
        playingChannels_.fill(-1);
    }

    /// Requests that actuator j play on device output channelMap[j], from 0; an empty list stands for j, and
    /// actuators beyond the list get no output. `drivenCount` actuators are driven (0: all); `listening` are
    /// the listening outputs. An output may not have two actuators (their sum could exceed its ceiling), an
    /// actuator and listeners, or marks and anything else. Returns empty; or the reason in one line, and
    /// nothing has changed. applyRequest() applies it.
    std::string request(int actuatorCount, const std::vector<int>& channelMap, int drivenCount = 0,
                        const ListeningOutputs& listening = {});

    /// Those of the `deviceOutputs` outputs of a device that the request uses.
    ChannelSet outputs(int deviceOutputs) const;

    /// Index of the highest listening output, from 0; -1: none.
    int highestListeningOutput() const noexcept;

    /// Applies the request. A callback gets the `active` outputs only, packed together.
    void applyRequest(const ChannelSet& active);

    /// Ends all fades: every actuator plays on its own output at once. M, while R does not run.
    void finishFades(int sampleRateHz) noexcept;

    /// Processes the next `frames` samples of an actuator in place. If its output has changed, it fades out
    /// (limits::channelRampSeconds) and then in on the new output, once no other actuator plays there.
    /// Returns the callback channel to play on; -1: none. R, wait-free.
    int play(int actuator, float* samples, int frames) noexcept;

    /// Callback channel of an actuator; -1: none.
    int channelOf(int actuator) const noexcept {
        return channels_[static_cast<std::size_t>(actuator)].load(std::memory_order_relaxed);
    }

    /// Callback channel of the i-th output of `source`; -1: none, or i is too large.
    int listeningChannel(ListeningSource source, int i) const noexcept {
        return listeningChannels_[static_cast<std::size_t>(source)][static_cast<std::size_t>(i)].load(
            std::memory_order_relaxed);
    }
    static constexpr int maxListeningOutputs = 8; ///< outputs per source: four pairs of headphones

    int drivenActuators() const noexcept { return drivenCount_; } ///< number that are to be driven
    /// Number of driven actuators without a callback channel, although the request gave them an output.
    int unassignedActuators() const noexcept;

private:
    std::vector<int> requestedOutputs_; // per actuator; -1: no output, -2: not specified
    int drivenCount_ = 0;
    ListeningOutputs listening_;
    std::array<std::atomic<int>, limits::maxActuators> channels_{};
    std::array<std::array<std::atomic<int>, maxListeningOutputs>, listeningSourceCount> listeningChannels_{};

    // R; set while R does not run
    std::array<int, limits::maxActuators> playingChannels_; // as channels_, delayed by the fades
    std::array<GainRamp, limits::maxActuators> ramps_;
};

class InputTap;
class VibrationConverter;

/// Master level at which a session starts: a quarter of the amplifier's full output, since the actuators
/// touch skin.
constexpr double defaultLevelDb = -12.0;
constexpr float defaultLevel = 0.25118864f; // defaultLevelDb as a gain

constexpr double minContactDb = -90.0, defaultContactDb = -20.0, maxContactDb = 0.0;

/// What plays on outputs of the same device that drive no actuator, e.g. on headphones. The master level does
/// not apply to them, the silence button does. Outputs count from 0; empty: off.
struct ListeningSettings {
    std::vector<int> noise;             ///< pink noise that masks the sound of the actuators
    double noiseDb = PinkNoise::safeDb; ///< RMS level in dB of full scale, within PinkNoise's limits
    std::vector<int> contacts;          ///< sounds of contacts; needs a session that makes them
    /// Level of a hit at full scale, and so the upper limit of every sample; minContactDb to maxContactDb.
    double contactDb = defaultContactDb;
    std::vector<int> marks; ///< full-scale pulses at onsets; needs a session that makes marks

    bool operator==(const ListeningSettings&) const = default;
    ListeningOutputs outputs() const { return {noise, contacts, marks}; }
};

/// The device to open, its outputs and its levels.
struct AudioOutputSettings {
    std::string device;          ///< name, or type:name where two drivers have the same name
    std::vector<int> channelMap; ///< actuator j plays on output channelMap[j], from 0; empty: on output j
    int sampleRateHz = 0;        ///< 0: device default
    int blockFrames = 0;         ///< 0: device default
    float level = defaultLevel;  ///< master gain, 0 to 1, reached in a ramp
    int actuatorCount = 0;       ///< number of actuators to drive; 0: as many as the session has channels
    bool opensAll = false;       ///< opens every output, so that assign() need not reopen the device
    ListeningSettings listening{};
    /// Actuators, from 0, that are motors which are either on or off (Core/Actuators/VibrationConverter.h).
    std::vector<int> onOffActuators{};
    double onOffThreshold = 0.1;             ///< they are on while samples exceed this, 0 to 1 full scale
    std::vector<int> inputs{};               ///< device inputs, from 0, whose mean goes to `tap`; empty: none
    InputTap* tap = nullptr;                 ///< outlives the output
    VibrationConverter* converter = nullptr; ///< converts samples on R until false; outlives it
};

/// State of the output at one moment, for display.
struct AudioOutputStatus {
    std::uint64_t blocks = 0;
    float load = 0.0f; ///< of the last block: processing time / duration
    float worstLoad = 0.0f;
    int deviceXruns = 0; ///< counted by the device; -1: the device does not count
    bool isRunning = false;
    int losses = 0;                  ///< how often the device had to be reopened
    float guardGain = 1.0f;          ///< lowest gain of OutputGuard, in the renderer or at the device
    std::uint64_t guardEpisodes = 0; ///< how often OutputGuard started to attenuate
};

} // namespace physvib
