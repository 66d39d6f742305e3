// SPDX-License-Identifier: MIT
// Mass, centre and inertia of bodies; area, centroid, inertia, extents and insets of their shapes.
#pragma once
#include "Scene/Scene.h"
#include <vector>

namespace physvib {
struct BodyMoments {
    double massKg = 0.0;
    Vector centreMetres;                ///< from the body's origin
    double inertiaKgSquareMetres = 0.0; ///< about the centre
};

/// Moments by density and area of the fixtures, not the rounded masses of Table 5.1, scaled to the body's own
/// mass where it states one. Any thread.
BodyMoments bodyMoments(const BodyDescription& body, const Scene& scene) noexcept;

/// Mass for Eq. 5.4, kg: the one it states, else by density and area. Any thread.
double massKg(const BodyDescription& body, const Scene& scene) noexcept;

/// Moments of a shape of constant thickness, in its own coordinates. Area 0: it has no mass (chains).
struct ShapeMoments {
    double areaSquareMetres = 0.0;
    Vector centroidMetres;
    double inertiaPerKg = 0.0; ///< about the centroid, m^2
};

/// Any thread. A polygon must be convex and counter-clockwise.
ShapeMoments momentsOf(const Shape& shape) noexcept;

/// Smallest and largest width over all directions.
double thicknessMetres(const Shape& shape) noexcept;
double lengthMetres(const Shape& shape) noexcept;

/// True if the vertices go round a strictly convex outline once, counter-clockwise.
bool isConvexCounterClockwise(const std::vector<Vector>& vertices) noexcept;

/// The part of a convex, counter-clockwise outline that is at least `margin` m inside; empty if nothing is.
std::vector<Vector> inset(const std::vector<Vector>& outline, double margin);

} // namespace physvib
