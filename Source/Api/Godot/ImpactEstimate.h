// SPDX-License-Identifier: MIT
// Estimates when and how fast two surfaces meet. Any thread.
#pragma once
#include <algorithm>
#include <cmath>

namespace physvib::godot {

/// Speed and time of an impact, from estimateImpact().
struct ImpactEstimate {
    double approachMetresPerSecond;
    double fraction; ///< moment of the impact, in steps after the overlap test
};

/// Godot adds the gravity of a step to velocities, tests for overlaps, and moves bodies straight on.
/// Positions therefore lie on a parabola, and at the overlap test the bodies approach half a step's gravity
/// slower than `solverSpeed`, that of the solver in m/s. They meet where the parabola crosses the other
/// surface: before the test if they overlap (`gapMetres`, m, below 0), else after it. `acceleration`: gravity
/// of one towards the other, m/s^2.
inline ImpactEstimate estimateImpact(double solverSpeed, double gapMetres, double acceleration,
                                     double stepSeconds) {
    const double overlapSpeed = solverSpeed - 0.5 * acceleration * stepSeconds;
    if (!(overlapSpeed > 0.0)) return {solverSpeed, 0.0}; // the bodies rest, or move apart
    const double impactSpeedSquared = overlapSpeed * overlapSpeed + 2.0 * acceleration * gapMetres;
    const double impactSpeed = impactSpeedSquared > 0.0 ? std::sqrt(impactSpeedSquared) : overlapSpeed;
    return {impactSpeed, std::clamp(2.0 * gapMetres / (overlapSpeed + impactSpeed) / stepSeconds, -1.0, 1.0)};
}

} // namespace physvib::godot
