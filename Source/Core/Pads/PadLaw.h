// SPDX-License-Identifier: MIT
// Model of a game controller's two rumble motors, and the parameters by which events become motor commands.
// Docs/pads.md names the sources of the figures.
#pragma once
#include <algorithm>
#include <cmath>

namespace physvib {

/// One motor: a command from 0 to 1 leads, with delay, to a strength from 0 to 1.
struct PadMotor {
    double threshold = 0.3;    ///< command below which the motor does not turn
    double half = 0.5;         ///< command that gives half of the strength
    double full = 0.86;        ///< command above which it gets no stronger
    double riseSeconds = 0.15; ///< from rest to 90 % of the commanded strength
    double fallSeconds = 0.15; ///< from there to 10 %
    bool operator==(const PadMotor&) const = default;

    /// Steady-state strength of a command: straight lines through (threshold, 0), (half, 1/2) and (full, 1).
    /// Any thread, as all functions here.
    double strengthOf(double command) const noexcept {
        if (command <= threshold) return 0.0;
        if (command <= half) return 0.5 * (command - threshold) / (half - threshold);
        return std::min(1.0, 0.5 + 0.5 * (command - half) / (full - half));
    }
    /// The command that gives this strength; for 1 and more, a command of 1.
    double commandOf(double strength) const noexcept {
        if (strength >= 1.0) return 1.0;
        if (strength <= 0.5) return threshold + 2.0 * std::max(0.0, strength) * (half - threshold);
        return half + (2.0 * strength - 1.0) * (full - half);
    }
    /// The share of a change of strength that is reached after `seconds`: a first-order lag.
    double shareOfWay(double seconds, bool rises) const noexcept {
        constexpr double logOfTen = 2.302585092994046;
        return 1.0 - std::exp(-logOfTen * seconds / (rises ? riseSeconds : fallSeconds));
    }
    double strengthAfter(double strength, double command, double seconds) const noexcept {
        const double towards = strengthOf(command);
        return strength + (towards - strength) * shareOfWay(seconds, towards > strength);
    }
};

/// Parameters of the conversion of events to commands for two motors.
struct PadLaw {
    PadMotor low{}, high{};          ///< the heavy motor, in the left grip; the light one, in the right grip
    double commandsPerSecond = 30.0; ///< at most; more frequent commands queue up on the link to the
                                     ///< controller
    double leadSeconds = 0.03; ///< an impact's command is sent this much earlier, because motors are slow
    double splitHz = 100.0;    ///< below it the heavy motor has the larger share
    double side = 0.5;         ///< weight of the impact's place beside its frequency, 0 to 1
    double floor = 0.01;       ///< weakest perceptible amplitude, of full scale
    double exponent = 0.7;     ///< strength grows with this power of the amplitude
    bool operator==(const PadLaw&) const = default;
};

} // namespace physvib
