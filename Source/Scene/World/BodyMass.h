// SPDX-License-Identifier: MIT
// Mass, centre and inertia of a scene's bodies.
#pragma once
#include "Scene/Scene.h"

namespace physvib {

struct BodyMoments {
    double massKg = 0.0;
    Vector centreMetres;                ///< from the body's origin
    double inertiaKgSquareMetres = 0.0; ///< about the centre
};

/// Moments by density and area of the fixtures, not the rounded masses of Table 5.1, scaled to the body's own
/// mass where it states one. Any thread.
BodyMoments bodyMoments(const BodyDescription& body, const Scene& scene) noexcept;

/// Mass for Eq. 5.4, kg: of a body that is not dynamic, the one it states. Any thread.
double massKg(const BodyDescription& body, const Scene& scene) noexcept;

} // namespace physvib
