// SPDX-License-Identifier: MIT
// Plays samples on one output of a device and records one of its inputs at the same time, aligned frame by
// frame.
#pragma once
#include "Io/Result.h"
#include "Live/Devices/AudioDevice.h"
#include <string>
#include <vector>

namespace physvib {

/// The device, and its output and input, from 0.
struct SweepPorts {
    std::string device; ///< name, or driver:name
    int output = 0;
    int input = 0;
    int sampleRateHz = 0; ///< 0: device default
};

struct RecordedSweep {
    double rateHz = 0.0;
    std::vector<float> played, recorded; ///< of equal length and start
    int xruns = 0;                       ///< counted by the device; -1: the device does not count
};

/// Makes the samples to play, at a rate known only once the device is open.
using SweepSource = std::function<std::vector<float>(double rateHz)>;

/// Opens that device and no other, plays once and closes it; all other outputs stay silent. An error if
/// something is missing or the device stops. Message thread; blocks for the duration of the sweep.
Result<RecordedSweep> recordSweep(const SweepPorts& ports, const SweepSource& source,
                                  const AudioDrivers& drivers);

} // namespace physvib
