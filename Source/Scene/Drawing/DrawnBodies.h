// SPDX-License-Identifier: MIT
// Creates body descriptions from points drawn in the field, without a name and with material 0.
#pragma once
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <vector>

namespace physvib {

// One-line error if the body would be too small. Places in metres of the field. Any thread.

Result<BodyDescription> drawnBall(const Vector& centre, const Vector& rim);
Result<BodyDescription> drawnBox(const Vector& corner, const Vector& opposite);

/// Equal balls in rows that fill the rectangle, without touching.
Result<std::vector<BodyDescription>> drawnRain(const Vector& corner, const Vector& opposite, int count);

/// The convex hull of the points; of more than eight corners, the most significant.
Result<BodyDescription> drawnPolygon(const std::vector<Vector>& corners);

/// A static bar from one place to the other.
Result<BodyDescription> drawnWall(const Vector& from, const Vector& to, double thicknessMetres);

/// A static line along a drawn path that collides on both sides, within `toleranceMetres` of the path.
Result<BodyDescription> drawnLine(const std::vector<Vector>& way, double toleranceMetres);

/// True if a new body should be a haptic source: it moves, and other moving bodies are sources, or there are
/// none, or the scene has no source at all. Any thread.
bool startsAsSource(const Scene& scene, const BodyDescription& body);

/// The nearest multiple of `gridMetres`; 0: unchanged. Any thread.
Vector snapped(const Vector& place, double gridMetres);

} // namespace physvib
