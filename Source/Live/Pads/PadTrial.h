// SPDX-License-Identifier: MIT
// Trial of a controller's motors, one after the other: the user feels them, or the controller's accelerometer
// measures them and a model is fitted.
#pragma once
#include "Core/Pads/PadMotors.h"
#include "Io/Result.h"
#include "Live/Pads/GamePads.h"
#include <functional>
#include <vector>

namespace physvib {

/// Clock of a trial: real, or simulated by a test.
struct PadTrialClock {
    std::function<double()> seconds; ///< any starting point
    std::function<void()> tick;      ///< waits about 1 ms and polls controllers
    std::function<bool()> keepGoing; ///< false: the trial ends and the motors stop
};

/// Acceleration recorded while one motor had one command, and after it.
struct PadStep {
    struct Sample {
        double seconds; ///< since the command
        std::array<float, 3> metresPerSecond2;
    };
    double command = 0.0;
    double onSeconds = 0.0; ///< then the command is 0
    std::vector<Sample> samples;
};

/// Steps one motor from 0.1 to 1 with rests between: 15 s. One line if the controller has no accelerometer,
/// is disconnected, or the trial is ended. The caller's thread.
Result<std::vector<PadStep>> recordMotor(GamePad& pad, bool isHeavy, const PadTrialClock& clock);

/// Fits threshold, half and full command, rise and fall time to such steps; one line if nothing moved, or
/// strength does not grow with the command. Any thread.
Result<PadMotor> fitMotor(const std::vector<PadStep>& steps);

/// Holds both commands for that time, repeated as needed; false: ended early.
bool holdMotors(GamePad& pad, double low, double high, double seconds, const PadTrialClock& clock);

/// Holds each motor at four commands, then plays ten impacts of 20 ms with increasing level, as `play` sends
/// them; `say` gets a line before each part. Empty, or one line: the pad is gone, or the trial was ended.
std::string tryMotors(GamePad& pad, const PadModel& law, const PadTrialClock& clock,
                      const std::function<void(const std::string&)>& say);

} // namespace physvib
