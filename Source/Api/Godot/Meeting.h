// SPDX-License-Identifier: MIT
// When and how fast two surfaces met. Any thread.
#pragma once

#include <algorithm>
#include <cmath>

namespace physvib::godot {

struct Meeting {
    double approachMetresPerSecond;
    double fraction; ///< in steps after the moment at which the engine looked
};

/// Godot adds a step's gravity to velocities, looks where bodies overlap, and moves them straight on. So its
/// places lie on a parabola whose speed at the look is half a step's gravity below the `speed` of the solver,
/// and the surfaces met where that parabola crosses the other surface: before the look if they overlap
/// (`gap` below 0), after it if Jolt saw them coming. `pull`: acceleration of one towards the other.
inline Meeting meetingOf(double speed, double gap, double pull, double seconds) {
    const double looked = speed - 0.5 * pull * seconds;
    if (!(looked > 0.0)) return {speed, 0.0}; // rests, or parts
    const double squared = looked * looked + 2.0 * pull * gap;
    const double met = squared > 0.0 ? std::sqrt(squared) : looked;
    return {met, std::clamp(2.0 * gap / (looked + met) / seconds, -1.0, 1.0)};
}

} // namespace physvib::godot
