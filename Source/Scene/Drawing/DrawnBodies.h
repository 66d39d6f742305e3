// SPDX-License-Identifier: MIT
// Bodies as hands draw them: from places in the field to descriptions, without a name and of material 0.
#pragma once
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <vector>

namespace physvib {

// What is too small to be a body is refused in one line. Places in metres of the field. Any thread.

Result<BodyDescription> drawnBall(const Vector& centre, const Vector& rim);
Result<BodyDescription> drawnBox(const Vector& corner, const Vector& opposite);

/// The convex outline around the places; of more than eight corners, those that matter most.
Result<BodyDescription> drawnPolygon(const std::vector<Vector>& corners);

/// A static bar from one place to the other.
Result<BodyDescription> drawnWall(const Vector& from, const Vector& to, double thicknessMetres);

/// A static line along the way of a hand that is hit from both sides, at most `toleranceMetres` beside it.
Result<BodyDescription> drawnLine(const std::vector<Vector>& way, double toleranceMetres);

/// Whether a new body is to be felt: as others that move are, or as the first of a scene in which none is.
/// Any thread.
bool startsAsSource(const Scene& scene, const BodyDescription& body);

/// The nearest multiple of `gridMetres`; 0: as it is. Any thread.
Vector snapped(const Vector& place, double gridMetres);

} // namespace physvib
