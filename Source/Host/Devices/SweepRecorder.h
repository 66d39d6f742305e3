// SPDX-License-Identifier: GPL-3.0-or-later
// Plays samples on one output of a device and records one of its inputs meanwhile, frame for frame.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include "Io/Result.h"
#include <string>
#include <vector>

namespace physvib {

/// Outputs and inputs from 0.
struct SweepPorts {
    std::string device; ///< name, or type:name
    int output = 0;
    int input = 0;
    int sampleRateHz = 0; ///< 0: as the device stands
};

struct RecordedSweep {
    double rateHz = 0.0;
    std::vector<float> played, recorded; ///< equally long; they begin together
    int xruns = 0;                       ///< as the device counts them; -1: it does not
};

/// What to play at a rate that only the open device knows.
using SweepSource = std::function<std::vector<float>(double rateHz)>;

/// Opens that device and no other, plays once, closes it; all other outputs stay silent. One line if
/// something is missing or the device stops calling. M only; takes as long as the sweep.
Result<RecordedSweep> recordSweep(const SweepPorts& ports, const SweepSource& source,
                                  const AudioDeviceTypes& types = systemAudioDeviceTypes);

} // namespace physvib
