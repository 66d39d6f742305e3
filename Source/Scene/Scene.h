// SPDX-License-Identifier: MIT
// A physics scene as plain data, without Box2D: materials, shapes, bodies, joints, and actions of scripts,
// users and editors. Simulations, pictures and files are made from it.
#pragma once
#include "Contacts/Grains.h"
#include "Contacts/HapticFixture.h"
#include "Io/Text/NameList.h"
#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace physvib {

/// Components along x (right) and y (up), in the unit that the member's name says.
struct Vector {
    double x = 0.0;
    double y = 0.0;
    bool operator==(const Vector&) const = default;
};

/// What a fixture is made of; frequency and decay are those of its contact sound (thesis 5.2.1, Table 5.1).
struct Material {
    std::string name;
    double densityKgPerSquareMetre = 0.0; ///< 2-D: per area
    double friction = 0.0;
    double restitution = 0.0;
    double frequencyHz = 0.0; ///< 0: never vibrates (allowed only where no haptic source needs it)
    double decayPerSecond = 0.0;
    double grainMetres = 0.0; ///< surface texture, as are all members up to `rolling`
    double roughness = 1.0;
    GrainPattern grainPattern = GrainPattern::random;
    double rolling = 0.2;
    int colour = 0; ///< in pictures: 1 to 8; 0: by index
    bool operator==(const Material&) const = default;

    void setTexture(const Texture& t) noexcept {
        grainMetres = t.grainMetres;
        roughness = t.roughness;
        grainPattern = t.pattern;
        rolling = t.rolling;
    }
    Texture texture() const noexcept { return {grainMetres, roughness, grainPattern, rolling}; }
};

struct CircleShape {
    double radiusMetres = 0.0;
    bool operator==(const CircleShape&) const = default;
};
struct BoxShape {
    double widthMetres = 0.0;
    double heightMetres = 0.0;
    bool operator==(const BoxShape&) const = default;
};
/// 3 to 8 corners of a convex outline, counter-clockwise.
struct PolygonShape {
    std::vector<Vector> verticesMetres;
    bool operator==(const PolygonShape&) const = default;
};
/// A line of edges without thickness or mass, for bodies that are not dynamic. Bodies collide only with its
/// right side as seen along it: draw ground right to left, containers clockwise, obstacles counter-clockwise.
struct ChainShape {
    std::vector<Vector> verticesMetres;
    bool isLoop = false; ///< the last vertex is joined to the first
    bool operator==(const ChainShape&) const = default;
};
using Shape = std::variant<CircleShape, BoxShape, PolygonShape, ChainShape>;

/// A shape of a material at its place in the body.
struct FixtureDescription {
    Shape shape;
    Vector offsetMetres; ///< of the shape's origin (circle, box: centre) from the body's
    double angleRadians = 0.0;
    int material = 0;      ///< index into Scene::materials
    bool isCamera = false; ///< haptic source: collisions of this fixture are felt (thesis 5.1.1)
    Voice voice = Voice::own;
    std::optional<double> restitution{}; ///< of this fixture; nullopt: the material's
    std::string part{}; ///< part of the user's body whose actuators play it (Core/NameNumbers.h); empty:
                        ///< all actuators, by place
    bool operator==(const FixtureDescription&) const = default;
};

/// A static body never moves, a kinematic one moves at its set velocity, a dynamic one by forces.
enum class BodyType { staticBody, kinematicBody, dynamicBody };

/// One rigid body in its start state.
struct BodyDescription {
    std::string name; ///< unique in the scene
    BodyType type = BodyType::dynamicBody;
    std::vector<FixtureDescription> fixtures;
    Vector positionMetres;
    double angleRadians = 0.0;
    Vector velocityMetresPerSecond;
    double spinRadiansPerSecond = 0.0;
    double linearDampingPerSecond = 0.0;
    double angularDampingPerSecond = 0.0;
    /// 0: from density and area. Bodies that are not dynamic have no mass in Box2D, but Eq. 5.4 needs one if
    /// a fixture is a haptic source.
    double massKg = 0.0;
    bool operator==(const BodyDescription&) const = default;
};

struct Interval {
    double lower = 0.0;
    double upper = 0.0;
    bool operator==(const Interval&) const = default;
};

/// A hinge. Limits are angles of body B relative to body A, 0 at the start; without torque it has no motor.
struct RevoluteJoint {
    Vector anchorMetres; ///< in the world, at the start
    std::optional<Interval> limitsRadians;
    double motorRadiansPerSecond = 0.0;
    double maxTorqueNewtonMetres = 0.0;
    bool operator==(const RevoluteJoint&) const = default;
};
/// A wheel (body B) that slides along an axis of body A on a spring, and may be driven.
struct WheelJoint {
    Vector anchorMetres;
    Vector axis{0.0, 1.0};     ///< any length above 0
    double suspensionHz = 0.0; ///< 0: no spring, only limits
    double dampingRatio = 0.0;
    std::optional<Interval> travelMetres;
    double motorRadiansPerSecond = 0.0;
    double maxTorqueNewtonMetres = 0.0;
    double restMetres = 0.0; ///< where along the axis its spring rests, 0 at the start
    bool operator==(const WheelJoint&) const = default;
};
/// Keeps two points as far apart as they start; a frequency makes it a spring.
struct DistanceJoint {
    Vector anchorAMetres;
    Vector anchorBMetres;
    double springHz = 0.0;
    double dampingRatio = 0.0;
    bool isSlack = false;    ///< a rope: limits the distance; springHz is unused
    double restMetres = 0.0; ///< how much longer it is at rest than at the start
    bool operator==(const DistanceJoint&) const = default;
};
/// Fixes two bodies to each other; with a frequency by a torsion spring.
struct WeldJoint {
    Vector anchorMetres;
    double springHz = 0.0;
    double dampingRatio = 0.0;
    double restRadians = 0.0; ///< angle of body B relative to body A at which it rests, 0 at the start
    bool operator==(const WeldJoint&) const = default;
};
/// Body B slides along an axis of body A without rotation. Without force it has no motor.
struct SliderJoint {
    Vector anchorMetres;
    Vector axis{1.0, 0.0}; ///< any length above 0
    std::optional<Interval> travelMetres;
    double motorMetresPerSecond = 0.0;
    double maxForceNewtons = 0.0;
    bool operator==(const SliderJoint&) const = default;
};
using Joint = std::variant<RevoluteJoint, WheelJoint, DistanceJoint, WeldJoint, SliderJoint>;

struct JointDescription {
    std::string name; ///< unique in the scene
    std::string bodyA;
    std::string bodyB;
    Joint joint;
    bool collide = false; ///< whether the two bodies touch each other
    bool operator==(const JointDescription&) const = default;
};

// Actions. `isUserInput`: a user's input, which is removed from a script when a user plays
// (sceneForUserInput). `isLasting`: it changes the scene permanently and not only its motion.

/// Replaces gravity by this vector, as a tilted or shaken device does.
struct GravityAction {
    static constexpr bool isUserInput = true;
    Vector gravityMetresPerSecond2;
    bool operator==(const GravityAction&) const = default;
};
/// Replaces gravity by the scene's, rotated counter-clockwise by this angle.
struct TiltAction {
    static constexpr bool isUserInput = true;
    double angleRadians = 0.0;
    bool operator==(const TiltAction&) const = default;
};
/// A push or drag. No effect if the body is absent or not dynamic.
struct ImpulseAction {
    static constexpr bool isUserInput = true;
    std::string body;
    Vector impulseNewtonSeconds;
    std::optional<Vector> pointMetres; ///< on the body, from its origin; none: the centre of mass
    bool operator==(const ImpulseAction&) const = default;
};
/// Sets the velocity of a dynamic or kinematic body.
struct VelocityAction {
    static constexpr bool isUserInput = true;
    std::string body;
    Vector velocityMetresPerSecond;
    double spinRadiansPerSecond = 0.0;
    bool operator==(const VelocityAction&) const = default;
};
/// Adds a body to the world. Repetitions are separate bodies "name 1", "name 2"..., each moved by
/// `shiftMetres` from the last. A body that exists already (in the script's next period) restarts.
struct SpawnAction {
    static constexpr bool isLasting = true;
    BodyDescription body;
    Vector shiftMetres;
    bool operator==(const SpawnAction&) const = default;
};
struct RemoveAction {
    static constexpr bool isLasting = true;
    std::string body;
    bool operator==(const RemoveAction&) const = default;
};
/// Changes the motor of a revolute or wheel joint; nullopt leaves the torque as it is.
struct MotorAction {
    std::string joint;
    double speedRadiansPerSecond = 0.0;
    std::optional<double> maxTorqueNewtonMetres;
    bool operator==(const MotorAction&) const = default;
};

constexpr int everyFixture = -1;

/// Makes a fixture of a body, or all of them, haptic sources or not.
struct CameraAction {
    static constexpr bool isLasting = true;
    std::string body;
    int fixture = everyFixture; ///< index in the body
    bool isOn = true;
    bool operator==(const CameraAction&) const = default;
};
/// Changes the material of a fixture of a body, or of all: sound, friction, restitution, density.
struct MaterialAction {
    static constexpr bool isLasting = true;
    std::string body;
    int fixture = everyFixture; ///< index in the body
    int material = 0;
    bool operator==(const MaterialAction&) const = default;
};
/// Changes the contact sound of a material for later collisions.
struct SoundAction {
    static constexpr bool isLasting = true;
    int material = 0;
    double frequencyHz = 0.0;
    double decayPerSecond = 0.0;
    bool operator==(const SoundAction&) const = default;
};
/// Changes the grains of a material's surface (see Texture) for later motion.
struct TextureAction {
    static constexpr bool isLasting = true;
    int material = 0;
    double grainMetres = 0.0;
    double roughness = 1.0;
    GrainPattern grainPattern = GrainPattern::random;
    double rolling = 0.2;
    bool operator==(const TextureAction&) const = default;

    Texture texture() const noexcept { return {grainMetres, roughness, grainPattern, rolling}; }
};
/// Rotates gravity counter-clockwise and scales it, on top of other actions, as the user holds the device.
struct HoldAction {
    static constexpr bool isUserInput = true;
    double factor = 1.0;
    double angleRadians = 0.0;
    bool operator==(const HoldAction&) const = default;
};
/// A hand grips a point of a body and pulls it. The hand moves straight to `toMetres` within `overSeconds`;
/// without `toMetres` it releases the body (see SceneGrips). No effect if the body is absent or not dynamic.
struct GripAction {
    static constexpr bool isUserInput = true;
    std::string body;
    std::optional<Vector> toMetres;
    std::optional<Vector> pointMetres; ///< on the body, from its origin; nullopt: the centre of mass. Used
                                       ///< only when the grip begins
    double overSeconds = 0.0;
    bool operator==(const GripAction&) const = default;
};
/// An editor's action: replaces the body of that name by this description, even if it was removed. Its joints
/// keep their anchors on it, and its fixtures get new numbers like those of a spawned body. Not in scripts.
struct ChangeAction {
    static constexpr bool isLasting = true;
    BodyDescription body;
    bool stays = false; ///< true: a present body keeps its place and motion; else it starts as described
    bool operator==(const ChangeAction&) const = default;
};
/// Joins two bodies; anchors are places in the world at that moment. Not in scripts.
struct JoinAction {
    static constexpr bool isLasting = true;
    JointDescription joint;
    bool operator==(const JoinAction&) const = default;
};
/// Removes a joint of the scene or of a JoinAction. Not in scripts.
struct UnjoinAction {
    static constexpr bool isLasting = true;
    std::string joint;
    bool operator==(const UnjoinAction&) const = default;
};
using Action = std::variant<GravityAction, TiltAction, ImpulseAction, VelocityAction, SpawnAction,
                            RemoveAction, MotorAction, CameraAction, MaterialAction, SoundAction, HoldAction,
                            TextureAction, GripAction, ChangeAction, JoinAction, UnjoinAction>;

/// True if the action is one of these. Any thread.
template <class... Kinds>
bool isAnyOf(const Action& action) noexcept {
    return (... || std::holds_alternative<Kinds>(action));
}

/// The body that a live input (spawn or change) adds to the world, under the next number; nullptr for others.
template <class OneAction> // Action, const or not
auto bodyAddedBy(OneAction& action) noexcept -> decltype(&std::get_if<SpawnAction>(&action)->body) {
    if (auto* spawn = std::get_if<SpawnAction>(&action)) return &spawn->body;
    if (auto* change = std::get_if<ChangeAction>(&action)) return &change->body;
    return nullptr;
}

/// An action at `timeSeconds` of the script, repeated `times` - 1 times at intervals of `everySeconds`.
struct ScriptInput {
    double timeSeconds = 0.0;
    int times = 1;
    double everySeconds = 0.0;
    Action action;
    bool operator==(const ScriptInput&) const = default;
};

/// An input by a user or host while the world ran, at world time `timeSeconds`. Bodies that it spawns start
/// without the seed's jitter.
struct LiveInput {
    double timeSeconds = 0.0;
    Action action;
    bool operator==(const LiveInput&) const = default;
};

/// A* (s/m) and m_h (kg) of Eq. 5.4; nullopt: by Eq. 5.7, from the field's width and the bodies present.
struct Normalisation {
    std::optional<double> secondsPerMetre;
    std::optional<double> handMassKg;
    bool operator==(const Normalisation&) const = default;
};

/// A variable of a scene file with the chosen value, for listings and provenance.
struct SceneVariable {
    std::string name;
    std::string value; ///< the chosen one
    std::vector<std::string> choices;
    bool operator==(const SceneVariable&) const = default;
};

/// A reproducible world: the same scene, seed and step rate give the same events.
struct Scene {
    std::string name;
    std::string description; ///< one line, for `physvib scenes`
    double fieldWidthMetres = 0.0;
    double fieldHeightMetres = 0.0;
    Vector gravityMetresPerSecond2; ///< at the start
    double driveGain = 1.0;         ///< factor on Eq. 5.7, which leaves most impacts near -40 dBFS
    Normalisation normalisation;
    std::vector<Material> materials;
    std::vector<BodyDescription> bodies; ///< at the start; allBodies() numbers their fixtures
    std::vector<JointDescription> joints;
    std::vector<ScriptInput> script;  ///< in any order; those of the same step act in this one
    double scriptPeriodSeconds = 0.0; ///< the script repeats after this time; 0: it does not
    std::vector<LiveInput> inputs;    ///< in time order; those of a step act before the script's
    std::vector<SceneVariable> variables;
    bool operator==(const Scene&) const = default;
};

} // namespace physvib
