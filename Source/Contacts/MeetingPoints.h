// SPDX-License-Identifier: MIT
// Impulses at the points where two bodies collide, solved together.
#pragma once
#include "Contacts/ReportedBodies.h"
#include "Contacts/Vector3.h"
#include <span>

namespace physvib {

/// One contact point. New points are to separate at `restitution` times their approach speed; old ones only
/// stay closed.
struct MeetingPoint {
    Vector3 point, normal; ///< normal: from A to B, of length 1
    double approach = 0.0; ///< m/s, before the engine's solver
    double restitution = 0.0;
    bool isNew = false;
    double newtonSeconds = 0.0; ///< result of solve
};

/// Computes the impulses along the normals such that none pulls, no surfaces approach, and none is larger
/// than necessary (the linear complementarity problem of a rigid impact, by projected Gauss-Seidel). Where
/// the masses leave the distribution open, all points get equal impulses. The bodies must be registered.
/// World thread (M) only; no allocation.
void solve(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, std::span<MeetingPoint> points);

} // namespace physvib
