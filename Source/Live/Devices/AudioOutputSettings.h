// SPDX-License-Identifier: MIT
// Settings of an audio device, and the state that the device reports.
#pragma once
#include "Live/Devices/OutputMap.h"
#include "Stimuli/PinkNoise.h"
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

class InputTap;
class VibrationConverter;

/// Master level at which a session starts: a quarter of the amplifier's full output, since the actuators
/// touch skin.
constexpr double safeStartDecibels = -12.0;
constexpr float safeStartLevel = 0.25118864f; // safeStartDecibels as a gain

constexpr double leastContactDb = -90.0, safeContactDb = -20.0, mostContactDb = 0.0;

/// What plays on outputs of the same device that drive no actuator, e.g. on headphones. The master level does
/// not apply to them, the silence button does. Outputs count from 0; empty: off.
struct ListeningSettings {
    std::vector<int> noise;             ///< pink noise that masks the sound of the actuators
    double noiseDb = PinkNoise::safeDb; ///< RMS level in dB of full scale, within PinkNoise's limits
    std::vector<int> contacts;          ///< sounds of contacts; needs a session that makes them
    /// Level of a hit at full scale, and so the upper limit of every sample; leastContactDb to mostContactDb.
    double contactDb = safeContactDb;
    std::vector<int> marks; ///< full-scale pulses at onsets; needs a session that makes marks

    bool operator==(const ListeningSettings&) const = default;
    HeardOutputs outputs() const { return {noise, contacts, marks}; }
};

/// Which device to open, and how.
struct AudioOutputSettings {
    std::string device;           ///< name, or type:name where two drivers have the same name
    std::vector<int> channelMap;  ///< actuator j plays on output channelMap[j], from 0; empty: on output j
    int sampleRateHz = 0;         ///< 0: device default
    int blockFrames = 0;          ///< 0: device default
    float level = safeStartLevel; ///< master gain, 0 to 1, reached in a ramp
    int enchanters = 0;           ///< number of actuators to drive; 0: as many as the session has channels
    bool opensAll = false;        ///< opens every output, so that assign() need not reopen the device
    ListeningSettings listening{};
    /// Actuators, from 0, that are motors which are either on or off (Core/Actuators/VibrationConverter.h).
    std::vector<int> onOff{};
    double onOffThreshold = 0.1;             ///< they are on while samples exceed this, 0 to 1 full scale
    std::vector<int> inputs{};               ///< device inputs, from 0, whose mean goes to `tap`; empty: none
    InputTap* tap = nullptr;                 ///< outlives the output
    VibrationConverter* converter = nullptr; ///< gets actuators' samples on R, until false; outlives it
};

/// State of the output at one moment, for display.
struct AudioOutputStatus {
    std::uint64_t blocks = 0;
    float load = 0.0f; ///< of the last block: processing time / duration
    float worstLoad = 0.0f;
    int deviceXruns = 0; ///< counted by the device; -1: the device does not count
    bool isRunning = false;
    int losses = 0;            ///< how often the device had to be reopened
    float guardGain = 1.0f;    ///< lowest gain of OutputGuard, in the renderer or at the device
    std::uint64_t guarded = 0; ///< how often OutputGuard started to attenuate
};

} // namespace physvib
