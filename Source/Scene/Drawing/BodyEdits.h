// SPDX-License-Identifier: MIT
// Editor operations on bodies (size, mass, place, joints, copies), as the actions of one edit; new scenes;
// bodies from drawn points; and the transform of points that move with a body.
#pragma once
#include "Io/Result.h"
#include "Scene/Drawing/SceneDrawing.h"
#include "Scene/Scene.h"
#include "Scene/World/BodyMass.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {
/// Place of a body in the world.
struct BodyPlace {
    Vector metres;
    double angleRadians = 0.0;
};

/// Bounding box of a body's outline around its origin, before rotation; editor handles lie on it. Any thread.
struct LocalBounds {
    Vector min, max;
};
LocalBounds localBounds(const BodyDescription& body);

/// Scales along the body's own axes; circles by the larger factor. Sizes stay in limits. Any thread.
BodyDescription scaledBody(BodyDescription body, double factorX, double factorY);

/// Mean density of a body, kg/m^2; 0: it has no area. Any thread.
double densityOf(const Scene& scene, const BodyDescription& body);
/// Sets a body's mass by a mean density; 0: its materials determine the mass again. Any thread.
void setDensity(BodyDescription& body, double kgPerSquareMetre);

/// Makes all fixtures of a body haptic sources, or none. A source without mass (a line) gets 1 kg, because
/// Eq. 5.4 needs a mass. Any thread.
void setSource(const Scene& scene, BodyDescription& body, bool isSource);

/// True if any fixture of the body is a haptic source. Any thread.
bool isSource(const BodyDescription& body);

/// Makes a body dynamic, or static and at rest. A line stays as it is. Any thread.
void setMoving(BodyDescription& body, bool moves);

/// Actions that move bodies (by name) and the anchors of their joints; joined bodies restart. Any thread.
std::vector<Action> moveActions(const SceneDrawing& drawing, const std::map<std::string, BodyPlace>& places);

/// The action that changes a body and keeps its place and motion. Any thread.
Action changeAction(BodyDescription body);

/// Actions that remove bodies and their joints. Any thread.
std::vector<Action> removeActions(const SceneDrawing& drawing, const std::vector<std::string>& names);

/// The scene without these bodies, their joints, and script inputs for either. Any thread.
Scene sceneWithout(Scene scene, const std::vector<std::string>& names);

/// Copied bodies and the joints between them. Any thread.
struct CopiedBodies {
    std::vector<BodyDescription> bodies;
    std::vector<JointDescription> joints;
};
CopiedBodies copyBodies(const SceneDrawing& drawing, const std::vector<std::string>& names);
/// Actions that insert the copy, shifted by `shift` (m), under new names, which are appended to `names`.
std::vector<Action> pasteActions(const SceneDrawing& drawing, const CopiedBodies& copy, const Vector& shift,
                                 std::vector<std::string>& names);

enum class JointKind { pin, rope, spring, slider, motor };

/// Actions that join bodies `a` and `b`, given by name and present place: a pin or motor at `from`; a rope,
/// spring or slider from `from` to `to`. Moved bodies start where they are now, at rest. Any thread.
Result<std::vector<Action>> joinActions(const SceneDrawing& drawing, JointKind kind,
                                        const std::pair<std::string, BodyPlace>& a,
                                        const std::pair<std::string, BodyPlace>& b, const Vector& from,
                                        const Vector& to);

/// The last hinge or wheel that joins the body, whether it has a motor or not; nullptr: none. Any thread.
const JointDescription* findMotor(const Scene& scene, const std::string& body);

/// Speed and maximum torque of a motor.
struct MotorDrive {
    double speedRadiansPerSecond = 0.0, maxTorqueNewtonMetres = 0.0;
    bool operator==(const MotorDrive&) const = default;
};
MotorDrive driveOf(const JointDescription& motor); ///< zero for other joints

/// Actions that replace a hinge or wheel by one with another drive. If its anchor has moved, or its bodies
/// within its limits, they start where they are, at rest. Any thread.
Result<std::vector<Action>> motorActions(const SceneDrawing& drawing, const std::string& joint,
                                         const MotorDrive& drive, const CurrentPose& findPose);

/// The last spring that joins the body; nullptr: none. Any thread.
const JointDescription* findSpring(const Scene& scene, const std::string& body);
double springHzOf(const JointDescription& spring); ///< zero for other joints

/// Actions that replace a spring by one with another frequency, i.e. stiffness. Its bodies return to their
/// start, so that it keeps its length. Any thread.
Result<std::vector<Action>> springActions(const SceneDrawing& drawing, const std::string& joint,
                                          double springHz);

/// The drawn scene with its bodies at their present places; joints keep their points and rest. Any thread.
Scene sceneNow(const Scene& drawn, const CurrentPose& findPose);

/// The scene with its field, gravity, materials and names alone. Any thread.
Scene sceneWithoutBodies(Scene scene);

enum class SceneGround { empty, box, floor };

/// A new scene with field, gravity and materials of another. Walls and floor are haptic sources of the first
/// material that vibrates; if none does, they are of the first material and no sources. Any thread.
Scene newScene(const Scene& original, SceneGround ground);

// Bodies from points that were drawn in the field, in metres: without a name, of material 0. One error line
// if a body would be too small. Any thread.

Result<BodyDescription> makeBall(const Vector& centre, const Vector& rim);
Result<BodyDescription> makeBox(const Vector& corner, const Vector& opposite);

/// Equal balls in rows that fill the rectangle, without touching.
Result<std::vector<BodyDescription>> makeRain(const Vector& corner, const Vector& opposite, int count);

/// The convex hull of the points, reduced to eight corners.
Result<BodyDescription> makePolygon(const std::vector<Vector>& corners);

/// A static bar along the line between two places.
Result<BodyDescription> makeWall(const Vector& from, const Vector& to, double thicknessMetres);

/// A static line along a drawn path that collides on both sides, within `toleranceMetres` of the path.
Result<BodyDescription> makeLine(const std::vector<Vector>& path, double toleranceMetres);

/// True if a new body should be a haptic source, i.e. if it is dynamic. Any thread.
bool startsAsSource(const BodyDescription& body);

/// The nearest multiple of `gridMetres`; 0: unchanged. Any thread.
Vector snapToGrid(const Vector& place, double gridMetres);

} // namespace physvib

namespace physvib::detail {

/// Transform of points that move with a body from one place to another. Any thread.
class Motion {
public:
    Motion(const BodyPlace& from, const BodyPlace& to)
        : from_{from}
        , to_{to} {}
    double angleRadians() const { return to_.angleRadians - from_.angleRadians; }
    Vector rotate(const Vector& axis) const { return rotated(axis, angleRadians()); }
    Vector operator()(const Vector& place) const {
        const Vector offset = rotated({place.x - from_.metres.x, place.y - from_.metres.y}, angleRadians());
        return {to_.metres.x + offset.x, to_.metres.y + offset.y};
    }

private:
    BodyPlace from_, to_;
};

inline BodyPlace placeOf(const BodyDescription& body) { return {body.positionMetres, body.angleRadians}; }

} // namespace physvib::detail
