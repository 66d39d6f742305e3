// SPDX-License-Identifier: GPL-3.0-or-later
// What is wanted of a device, and what it tells.
#pragma once
#include "Host/Devices/OutputMap.h"
#include "Stimuli/PinkNoise.h"
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

class InputTap;

/// Master level that a session starts at: a quarter of what the amplifier would give, since hands are
/// attached.
constexpr double safeStartDecibels = -12.0;
constexpr float safeStartLevel = 0.25118864f; // the same as a gain

constexpr double leastContactDb = -90.0, safeContactDb = -20.0, mostContactDb = 0.0;

/// What is heard on outputs of the same device that are no enchanter's, e.g. on headphones; apart from the
/// master level, not from the silence button. Outputs from 0; empty: off.
struct ListeningSettings {
    std::vector<int> noise;             ///< pink noise that masks what actuators sound like
    double noiseDb = PinkNoise::safeDb; ///< its root mean square in dB of full scale, within PinkNoise's
    std::vector<int> contacts;          ///< the contact sound of each hit; of a session that makes one
    double contactDb = safeContactDb; ///< no sample is larger: that of a hit at full scale, leastContactDb to
                                      ///< mostContactDb

    std::vector<int> marks; ///< pulses at onsets, at full scale, for machines; of a session that makes them

    bool operator==(const ListeningSettings&) const = default;
    HeardOutputs outputs() const { return {noise, contacts, marks}; }
};

/// What is wanted of a device.
struct AudioOutputSettings {
    std::string device;           ///< name, or type:name where two drivers have the same name
    std::vector<int> channelMap;  ///< enchanter j plays on device output channelMap[j], from 0; empty: j on j
    int sampleRateHz = 0;         ///< 0: as the device stands
    int blockFrames = 0;          ///< 0: as the device stands
    float level = safeStartLevel; ///< master gain, 0 to 1, reached in a ramp
    int enchanters = 0;           ///< how many there are to be felt; 0: as many as the session has channels
    bool opensAll = false;        ///< every output of the device, so that assign() need not open it again
    ListeningSettings listening{};
    std::vector<int> onOff{};    ///< enchanters, from 0, that are motors which are on or off
                                 ///< (Core/Actuators/VibrationConverter.h)
    double onOffThreshold = 0.1; ///< from 0 to 1 full scale
    std::vector<int> inputs{};   ///< of the device, from 0, whose mean `tap` takes; empty: none
    InputTap* tap = nullptr;     ///< outlives the output
};

/// A moment of the output, for people.
struct AudioOutputStatus {
    std::uint64_t blocks = 0;
    float load = 0.0f; ///< of the last block: time taken / time it lasts
    float worstLoad = 0.0f;
    int deviceXruns = 0; ///< as the device counts them; -1: it does not
    bool isRunning = false;
    int losses = 0;            ///< times the device had to be opened again
    float guardGain = 1.0f;    ///< of the actuator that is turned down most, in the renderer or at the device
    std::uint64_t guarded = 0; ///< how often it began to
};

} // namespace physvib
