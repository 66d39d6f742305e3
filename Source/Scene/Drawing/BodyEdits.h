// SPDX-License-Identifier: MIT
// Editor operations on bodies (size, place, joints, copies), each as the actions of one edit; new scenes; and
// bodies from drawn points.
#pragma once
#include "Core/PortableMath.h"
#include "Io/Result.h"
#include "Scene/Drawing/SceneDrawing.h"
#include "Scene/Scene.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {
/// New place of a body.
struct BodyPlace {
    Vector metres;
    double angleRadians = 0.0;
};

/// Bounding box of a body's outline around its origin, before rotation; editor handles lie on it. Any thread.
struct Reach {
    Vector least, most;
};
Reach reachOf(const BodyDescription& body);

/// Scales along the body's own axes; circles by the larger factor. Sizes stay in limits. Any thread.
BodyDescription scaledBody(BodyDescription body, double factorX, double factorY);

/// Mean density of a body, kg/m^2; 0: it has no area. Any thread.
double densityOf(const Scene& scene, const BodyDescription& body);
/// Sets its mass to that of this density; 0: to that of its materials. Any thread.
void setDensity(BodyDescription& body, double kgPerSquareMetre);

/// Makes a body a haptic source, or not. A line gets the mass that Eq. 5.4 needs, if it has none. Any thread.
void setSource(const Scene& scene, BodyDescription& body, bool isSource);

/// True if any fixture of the body is a haptic source. Any thread.
bool isSource(const BodyDescription& body);

/// Makes a body static, at rest, or dynamic. A line stays static. Any thread.
void setMoving(BodyDescription& body, bool moves);

/// Actions that move bodies, at rest, with their joints; bodies joined to them return to their start. Any
/// thread.
std::vector<Action> movedTo(const SceneDrawing& drawing, const std::map<std::string, BodyPlace>& places);

/// The action that changes a body and keeps its place and motion. Any thread.
Action changed(BodyDescription body);

/// Actions that remove bodies and their joints. Any thread.
std::vector<Action> erased(const SceneDrawing& drawing, const std::vector<std::string>& names);

/// The scene without these bodies, their joints, and script inputs for either. Any thread.
Scene without(Scene scene, const std::vector<std::string>& names);

/// Copied bodies and the joints between them. Any thread.
struct Copied {
    std::vector<BodyDescription> bodies;
    std::vector<JointDescription> joints;
};
Copied copied(const SceneDrawing& drawing, const std::vector<std::string>& names);
/// Actions that insert the copy, shifted by `beside` (m), under new names, which are appended to `names`.
std::vector<Action> pasted(const SceneDrawing& drawing, const Copied& copy, const Vector& beside,
                           std::vector<std::string>& names);

enum class JointKind { pin, rope, spring, slider, motor };

/// Joins two bodies that are at `a` and `b` now: a pin or motor at `from`, a rope, spring or slider from
/// there to `to`. Bodies that have moved get their present place as start, at rest. Any thread.
Result<std::vector<Action>> joined(const SceneDrawing& drawing, JointKind kind,
                                   const std::pair<std::string, BodyPlace>& a,
                                   const std::pair<std::string, BodyPlace>& b, const Vector& from,
                                   const Vector& to);

/// The hinge or wheel that drives a body, or that could: the last one that joins it. Null: none. Any thread.
const JointDescription* motorOf(const Scene& scene, const std::string& body);

/// Speed and torque of a motor.
struct MotorDrive {
    double radiansPerSecond = 0.0, maxTorqueNewtonMetres = 0.0;
    bool operator==(const MotorDrive&) const = default;
};
MotorDrive driveOf(const JointDescription& motor); ///< zero for other joints

/// Joins it again with another drive. If its anchor has moved, its bodies start at their present places, at
/// rest. Any thread.
Result<std::vector<Action>> driven(const SceneDrawing& drawing, const std::string& joint,
                                   const MotorDrive& drive, const PoseNow& now);

/// The last spring between a body and another. Null: none. Any thread.
const JointDescription* springOf(const Scene& scene, const std::string& body);
double springHzOf(const JointDescription& spring); ///< zero for other joints

/// Joins it again with another stiffness, given as the frequency at which its bodies swing; they return to
/// their start, so it keeps its length. Any thread.
Result<std::vector<Action>> sprung(const SceneDrawing& drawing, const std::string& joint, double hz);

/// The drawn scene with its bodies at their present places; joints keep their points on them. Any thread.
Scene sceneNow(const Scene& drawn, const PoseNow& now);

/// The scene with its field, gravity, materials and names alone. Any thread.
Scene emptied(Scene scene);

enum class SceneGround { empty, box, floor };

/// A new scene with field, gravity and materials of another. Walls and floor are haptic sources of its first
/// material that vibrates; without one, of its first material, and not felt. Any thread.
Scene newScene(const Scene& like, SceneGround ground);

// Body descriptions from points drawn in the field, in metres, without a name and with material 0; or one
// error line if the body would be too small. Any thread.

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

/// True if a new body should be a haptic source: it moves. Any thread.
bool startsAsSource(const BodyDescription& body);

/// The nearest multiple of `gridMetres`; 0: unchanged. Any thread.
Vector snapped(const Vector& place, double gridMetres);

} // namespace physvib

// Transform of points that move with a body, for edits of places and joints. Any thread.

namespace physvib::detail {

inline Vector turned(const Vector& v, double angle) {
    const double c = portable::cos(angle), s = portable::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Transform from one place of a body to another.
class Motion {
public:
    Motion(const BodyPlace& from, const BodyPlace& to)
        : from_{from}
        , to_{to} {}
    double angle() const { return to_.angleRadians - from_.angleRadians; }
    Vector way(const Vector& axis) const { return turned(axis, angle()); }
    Vector operator()(const Vector& place) const {
        const Vector at = turned({place.x - from_.metres.x, place.y - from_.metres.y}, angle());
        return {to_.metres.x + at.x, to_.metres.y + at.y};
    }

private:
    BodyPlace from_, to_;
};

inline BodyPlace placeOf(const BodyDescription& body) { return {body.positionMetres, body.angleRadians}; }

} // namespace physvib::detail
