// SPDX-License-Identifier: MIT
// Estimates when and how fast two surfaces meet. Any thread.
#pragma once

#include <algorithm>
#include <cmath>

namespace physvib::godot {

struct Meeting {
    double approachMetresPerSecond;
    double fraction; ///< moment of the impact, in steps after the overlap test
};

/// Godot adds the gravity of a step to velocities, tests for overlaps, and moves bodies straight on.
/// Positions therefore lie on a parabola, and at the overlap test the bodies approach half a step's gravity
/// slower than `speed`, that of the solver in m/s. They meet where the parabola crosses the other surface:
/// before the test
/// if they overlap (`gap`, m, below 0), else after it. `pull`: gravity of one towards the other, m/s^2.
inline Meeting meetingOf(double speed, double gap, double pull, double seconds) {
    const double looked = speed - 0.5 * pull * seconds;
    if (!(looked > 0.0)) return {speed, 0.0}; // rests, or parts
    const double squared = looked * looked + 2.0 * pull * gap;
    const double met = squared > 0.0 ? std::sqrt(squared) : looked;
    return {met, std::clamp(2.0 * gap / (looked + met) / seconds, -1.0, 1.0)};
}

} // namespace physvib::godot
