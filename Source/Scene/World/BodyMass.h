// SPDX-License-Identifier: MIT
// Mass, centre and inertia of bodies; moments, widths and insets of shapes; distance and rotation of points.
#pragma once
#include "Core/PortableMath.h"
#include "Scene/Scene.h"
#include <vector>

namespace physvib {
struct BodyMoments {
    double massKg = 0.0;
    Vector centreMetres;                ///< from the body's origin
    double inertiaKgSquareMetres = 0.0; ///< about the centre
};

/// Moments by density and area of the fixtures (not the rounded masses of Table 5.1), scaled to the body's
/// own massKg if it is above 0. Any thread.
BodyMoments bodyMoments(const BodyDescription& body, const Scene& scene) noexcept;

/// Mass for Eq. 5.4 in kg: the body's own if above 0, else by density and area. Any thread.
double massKg(const BodyDescription& body, const Scene& scene) noexcept;

/// Moments of a shape of constant thickness, in its own coordinates. Area 0: it has no mass (chains).
struct ShapeMoments {
    double areaSquareMetres = 0.0;
    Vector centroidMetres;
    double inertiaPerKg = 0.0; ///< about the centroid, m^2
};

/// Moments of a shape. A polygon must be convex and counter-clockwise. Any thread.
ShapeMoments momentsOf(const Shape& shape) noexcept;

/// Smallest and largest width of a shape over all directions (a box: its sides), in m. Any thread.
double thicknessMetres(const Shape& shape) noexcept;
double lengthMetres(const Shape& shape) noexcept;

/// True if the vertices are a strictly convex outline, counter-clockwise, once around. Any thread.
bool isConvexCounterClockwise(const std::vector<Vector>& vertices) noexcept;

/// A convex, counter-clockwise outline moved inwards by `marginMetres`; empty if nothing is left. Any thread.
std::vector<Vector> inset(const std::vector<Vector>& outline, double marginMetres);

namespace detail {

inline double distance(const Vector& a, const Vector& b) { return portable::hypot(b.x - a.x, b.y - a.y); }

inline Vector rotated(const Vector& v, double angleRadians) {
    const double c = portable::cos(angleRadians), s = portable::sin(angleRadians);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

} // namespace detail

} // namespace physvib
