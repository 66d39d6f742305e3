// SPDX-License-Identifier: MIT
// Area, centroid, inertia and extents of shapes.
#pragma once
#include "Scene/Scene.h"
#include <vector>

namespace physvib {

/// Of a shape of constant thickness, in its own coordinates. Area 0: it has no mass (chains).
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

/// The part of a convex, counter-clockwise outline that is at least `margin` inside; empty if nothing is.
std::vector<Vector> inset(const std::vector<Vector>& outline, double margin);

} // namespace physvib
