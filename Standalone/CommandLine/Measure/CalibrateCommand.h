// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib calibrate`: an actuator's profile from a sweep, played live or recorded elsewhere.
#pragma once
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct CalibrateOptions {
    std::string device;
    int channel = 1, input = 1;           ///< from 1
    int sampleRateHz = 0;                 ///< 0: as the device stands
    std::string playedPath, recordedPath; ///< WAV pair, instead of a device
    std::string sweepPath;                ///< write the sweep and nothing else
    std::string profilePath;              ///< to write
    bool isLoopback = false;              ///< a cable instead of an actuator: its latency, no profile
    std::string name = "calibrated";
    std::string band;                     ///< "LO-HI" to declare; empty: within 10 dB of the peak
    double levelDb = -12.0, seconds = 5.0;
    double gPerUnit = 0.0;                ///< acceleration of a recorded sample of 1; 0: not known
    double driveVolts = 0.0;              ///< at a played sample of 1; 0: not known
};

void declareCalibrate(OptionTable& command, CalibrateOptions& options);

/// Writes the profile, with a line on how sure it is on stdout, or tells the latency of a loop; the code to leave with.
int runCalibrate(const CalibrateOptions& options);

} // namespace physvib
