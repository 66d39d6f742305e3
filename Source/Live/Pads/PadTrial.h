// SPDX-License-Identifier: MIT
// A controller's motors one after the other: felt, or measured by the controller's own accelerometer.
#pragma once
#include "Core/Pads/PadLaw.h"
#include "Io/Result.h"
#include "Live/Pads/GamePads.h"
#include <functional>
#include <vector>

namespace physvib {

/// How time goes on in a trial: real, or a test's.
struct PadTrialTime {
    std::function<double()> seconds; ///< since any moment
    std::function<void()> tick;      ///< a millisecond or so; controllers are looked at
    std::function<bool()> goesOn;    ///< false: the trial ends, motors at rest
};

/// What was told while one motor had one command, and after it.
struct PadStep {
    struct Sample {
        double seconds; ///< since the command
        std::array<float, 3> metresPerSecond2;
    };
    double command = 0.0;
    double onSeconds = 0.0; ///< then 0
    std::vector<Sample> samples;
};

/// Commands from 0.1 to 1 of one motor, with rests between them: 15 s. One line if the controller does not
/// tell its acceleration, is unplugged, or the trial is ended. The caller's thread.
Result<std::vector<PadStep>> recordMotor(GamePad& pad, bool isHeavy, const PadTrialTime& time);

/// Threshold, half, full, rise and fall of such steps; one line if nothing moved, or not more with more. Any
/// thread.
Result<PadMotor> fitMotor(const std::vector<PadStep>& steps);

/// Holds both commands for so long, sent again as often as it takes; false: ended before.
bool holdMotors(GamePad& pad, double low, double high, double seconds, const PadTrialTime& time);

} // namespace physvib
