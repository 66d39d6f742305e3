// SPDX-License-Identifier: MIT
// What an editor does to bodies that stand there: sizes, places, joints between them, copies; as actions of
// one edit.
#pragma once
#include "Io/Result.h"
#include "Scene/Drawing/SceneDrawing.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// Where a body is to be.
struct BodyPlace {
    Vector metres;
    double angleRadians = 0.0;
};

/// How a body's outline reaches around its origin, before it is turned: what handles lie on. Any thread.
struct Reach {
    Vector least, most;
};
Reach reachOf(const BodyDescription& body);

/// Larger or smaller along its own axes; circles by the larger factor. Sizes stay within what a scene may
/// have. Any thread.
BodyDescription scaledBody(BodyDescription body, double factorX, double factorY);

/// Density of a body as a whole, kg/m^2; 0: it has no area. Any thread.
double densityOf(const Scene& scene, const BodyDescription& body);
/// Its mass becomes that of this density; 0: its materials' again. Any thread.
void setDensity(BodyDescription& body, double kgPerSquareMetre);

/// Collisions of it are felt, or not any more. What is not dynamic gets the mass that Eq. 5.4 asks for, if it
/// states none. Any thread.
void setSource(const Scene& scene, BodyDescription& body, bool isSource);

/// Static or dynamic. A line stays static. Any thread.
void setMoving(const Scene& scene, BodyDescription& body, bool moves);

/// Puts bodies somewhere else, at rest, with the joints on them; what is joined to them goes back to its
/// start. Any thread.
std::vector<Action> movedTo(const SceneDrawing& drawing, const std::map<std::string, BodyPlace>& places);

/// Changes a body where it is and as it moves. Any thread.
Action changed(BodyDescription body);

/// Takes bodies away, with the joints on them. Any thread.
std::vector<Action> erased(const SceneDrawing& drawing, const std::vector<std::string>& names);

/// Bodies and the joints between them, to be put elsewhere. Any thread.
struct Copied {
    std::vector<BodyDescription> bodies;
    std::vector<JointDescription> joints;
};
Copied copied(const SceneDrawing& drawing, const std::vector<std::string>& names);
/// The same again, so far beside it, under new names: these are appended to `names`.
std::vector<Action> pasted(const SceneDrawing& drawing, const Copied& copy, const Vector& beside,
                           std::vector<std::string>& names);

enum class JointKind { pin, rope, slider, motor };

/// Joins two bodies that are at `a` and `b` now: a pin or motor at `from`, a rope or slider from there to
/// `to`. Bodies that have moved since the start start where they are now, at rest. Any thread.
Result<std::vector<Action>> joined(const SceneDrawing& drawing, JointKind kind,
                                   const std::pair<std::string, BodyPlace>& a,
                                   const std::pair<std::string, BodyPlace>& b, const Vector& from,
                                   const Vector& to);

/// The scene as it is drawn, but with its bodies where they are now: joints hold the same points of them. Any
/// thread.
Scene sceneNow(const Scene& drawn, const PoseNow& now);

enum class SceneGround { empty, box, floor };

/// A scene to draw in: field, gravity and materials as another's. Walls and floor are of its first material.
/// Any thread.
Scene newScene(const Scene& like, SceneGround ground);

} // namespace physvib
