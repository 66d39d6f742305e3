// SPDX-License-Identifier: MIT
// The points at which two bodies meet, solved together.
#pragma once
#include "Contacts/FedBodies.h"
#include "Contacts/Vector2.h"
#include <span>

namespace physvib {

/// One of them. New points are to part at `restitution` times the speed at which they near each other; old
/// ones only hold.
struct MeetingPoint {
    Vector2 point, normal; ///< from A to B, of length 1
    double approach = 0.0; ///< m/s, before the engine's solver
    double restitution = 0.0;
    bool isNew = false;
    double newtonSeconds = 0.0; ///< set by solve
};

/// The impulses along the normals: none pulls, none lets its surfaces near each other, and none pushes more
/// than it needs (the linear complementarity problem of a rigid impact, by projected Gauss-Seidel). Where
/// masses leave it open which point pushes, all push alike. Bodies are known ones. M only; no allocation.
void solve(const FedBodies& bodies, std::int32_t a, std::int32_t b, std::span<MeetingPoint> points);

} // namespace physvib
