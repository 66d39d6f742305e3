// SPDX-License-Identifier: MIT
// Two motors of a game controller in numbers, and how they follow what is sent to them. Docs/pads.md says
// where the figures are from.
#pragma once
#include <algorithm>
#include <cmath>

namespace physvib {

/// One motor: commands from 0 to 1 become a strength from 0 to 1, late.
struct PadMotor {
    double threshold = 0.3;    ///< command below which nothing turns
    double half = 0.5;         ///< command that gives half of the strength
    double full = 0.86;        ///< command above which it becomes no stronger
    double riseSeconds = 0.15; ///< from rest to 90 % of what is asked for
    double fallSeconds = 0.15; ///< from there to 10 %
    bool operator==(const PadMotor&) const = default;

    /// Of a command that lasts: straight lines through (threshold, 0), (half, 1/2) and (full, 1). Any thread,
    /// as what follows.
    double strengthOf(double command) const noexcept {
        if (command <= threshold) return 0.0;
        if (command <= half) return 0.5 * (command - threshold) / (half - threshold);
        return std::min(1.0, 0.5 + 0.5 * (command - half) / (full - half));
    }
    /// The command of that strength; of 1 and more, a command of 1.
    double commandOf(double strength) const noexcept {
        if (strength >= 1.0) return 1.0;
        if (strength <= 0.5) return threshold + 2.0 * std::max(0.0, strength) * (half - threshold);
        return half + (2.0 * strength - 1.0) * (full - half);
    }
    /// The share of the way to another strength that it has gone after `seconds`: a first-order lag.
    double shareOfWay(double seconds, bool rises) const noexcept {
        constexpr double logOfTen = 2.302585092994046;
        return 1.0 - std::exp(-logOfTen * seconds / (rises ? riseSeconds : fallSeconds));
    }
    double strengthAfter(double strength, double command, double seconds) const noexcept {
        const double towards = strengthOf(command);
        return strength + (towards - strength) * shareOfWay(seconds, towards > strength);
    }
};

/// How events become commands of two motors.
struct PadLaw {
    PadMotor low{}, high{};          ///< the heavy motor, in the left grip; the light one, in the right grip
    double commandsPerSecond = 30.0; ///< at most; closer commands queue up on the way to the pad
    double leadSeconds = 0.03;       ///< a hit begins that much before it is to be felt, as motors are slow
    double splitHz = 100.0;          ///< below it the heavy motor has the larger share
    double side = 0.5;     ///< how much the place of a hit counts beside its frequency: 0 not at all, to 1
    double floor = 0.01;   ///< weakest amplitude, of full scale, that is to be felt
    double exponent = 0.7; ///< strength grows with the amplitude to that power
    bool operator==(const PadLaw&) const = default;
};

} // namespace physvib
