// SPDX-License-Identifier: MIT
// Tables of all fields of a scene and its parts: name in files, member, range. Readers, writers, checks visit
// them.
#pragma once
#include "Core/Limits.h"
#include "Io/Json/FieldTable.h"
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include <array>
#include <limits>
#include <string_view>

namespace physvib {

/// Range of a number (or of each component or item), and of the number of items of a list.
struct Bounds {
    double min = std::numeric_limits<double>::lowest();
    double max = std::numeric_limits<double>::max();
    std::size_t minItems = 0;
    std::size_t maxItems = 0;
};

/// Range of the number of items of a list.
constexpr Bounds items(std::size_t min, std::size_t max) { return {{}, {}, min, max}; }
constexpr Bounds upTo(double max) { return {0.0, max}; }
constexpr Bounds absMax(double max) { return {-max, max}; }

/// visitFields(v, FieldsOf<T>{}) calls v once per field of T:
///   field(name, member, Bounds, Need)   text, boolean, number, Vector or struct, or an optional or list of
///                                       these; required unless Need::optional is given
///   pair(name, member, member, Bounds)  two numbers as [a, b]; required
///   choice(name, member, names)         an enumeration; optional
///   material(name, member)              an index into Scene::materials, in files a name; required
///   variant(name, member, names)        the name of the alternative, whose fields are in the same object
inline constexpr Bounds anyText{};
inline constexpr Bounds positionBounds = absMax(sceneLimits::maxPositionMetres);
inline constexpr Bounds angleBounds = absMax(sceneLimits::maxAngleRadians);
inline constexpr Bounds speedBounds = absMax(sceneLimits::maxSpeedMetresPerSecond);
inline constexpr Bounds spinBounds = absMax(sceneLimits::maxSpinRadiansPerSecond);
inline constexpr Bounds sizeBounds{sceneLimits::minSizeMetres, sceneLimits::maxSizeMetres};
inline constexpr Bounds accelerationBounds = absMax(sceneLimits::maxAccelerationMetresPerSecond2);
inline constexpr Bounds torqueBounds = upTo(sceneLimits::maxTorqueNewtonMetres);
inline constexpr Bounds fixtureBounds = upTo(static_cast<double>(sceneLimits::maxFixturesPerBody - 1));

inline constexpr std::array<std::string_view, 2> grainPatternNames{"random", "regular"};

/// Texture fields of T: a material, or an action that changes one.
template <class T, class V>
void visitTexture(V& v) {
    v.field("grain_m", &T::grainMetres, upTo(Texture::coarsestMetres), Need::optional);
    v.field("roughness", &T::roughness, upTo(Texture::maxRoughness), Need::optional);
    v.choice("grain_pattern", &T::grainPattern, grainPatternNames);
    v.field("rolling", &T::rolling, upTo(1.0), Need::optional);
}

void visitFields(auto& v, FieldsOf<Material>) {
    v.field("name", &Material::name, anyText);
    v.field("density_kg_per_m2", &Material::densityKgPerSquareMetre,
            Bounds{sceneLimits::minDensityKgPerSquareMetre, sceneLimits::maxDensityKgPerSquareMetre});
    v.field("friction", &Material::friction, upTo(sceneLimits::maxFriction));
    v.field("restitution", &Material::restitution, upTo(1.0));
    v.field("frequency_hz", &Material::frequencyHz, upTo(limits::maxFrequencyHz), Need::optional);
    v.field("decay_per_s", &Material::decayPerSecond, upTo(limits::maxDecayPerSecond), Need::optional);
    visitTexture<Material>(v);
    v.field("colour", &Material::colour, upTo(8.0), Need::optional);
}

void visitFields(auto& v, FieldsOf<CircleShape>) {
    v.field("radius_m", &CircleShape::radiusMetres, sizeBounds);
}
void visitFields(auto& v, FieldsOf<BoxShape>) {
    v.pair("size_m", &BoxShape::widthMetres, &BoxShape::heightMetres, sizeBounds);
}
void visitFields(auto& v, FieldsOf<PolygonShape>) {
    constexpr double reach = sceneLimits::maxSizeMetres;
    v.field("vertices_m", &PolygonShape::verticesMetres,
            Bounds{-reach, reach, 3, sceneLimits::maxPolygonVertices});
}
void visitFields(auto& v, FieldsOf<ChainShape>) {
    constexpr double reach = sceneLimits::maxPositionMetres;
    v.field("vertices_m", &ChainShape::verticesMetres,
            Bounds{-reach, reach, 2, sceneLimits::maxChainVertices});
    v.field("loop", &ChainShape::isLoop, {}, Need::optional);
}

inline constexpr std::array<std::string_view, 4> shapeNames{"circle", "box", "polygon", "chain"};
inline constexpr std::array<std::string_view, 3> voiceNames{"own", "other", "both"};
inline constexpr std::array<std::string_view, 3> bodyTypeNames{"static", "kinematic", "dynamic"};

void visitFields(auto& v, FieldsOf<FixtureDescription>) {
    v.variant("shape", &FixtureDescription::shape, shapeNames);
    v.field("offset_m", &FixtureDescription::offsetMetres, positionBounds, Need::optional);
    v.field("angle_rad", &FixtureDescription::angleRadians, angleBounds, Need::optional);
    v.material("material", &FixtureDescription::material);
    v.field("camera", &FixtureDescription::isCamera, {}, Need::optional);
    v.choice("voice", &FixtureDescription::voice, voiceNames);
    v.field("restitution", &FixtureDescription::restitution, upTo(1.0), Need::optional);
    v.field("part", &FixtureDescription::part, anyText, Need::optional);
}

void visitFields(auto& v, FieldsOf<BodyDescription>) {
    using B = BodyDescription;
    v.field("name", &B::name, anyText);
    v.choice("type", &B::type, bodyTypeNames);
    v.field("position_m", &B::positionMetres, positionBounds);
    v.field("angle_rad", &B::angleRadians, angleBounds, Need::optional);
    v.field("velocity_m_per_s", &B::velocityMetresPerSecond, speedBounds, Need::optional);
    v.field("spin_rad_per_s", &B::spinRadiansPerSecond, spinBounds, Need::optional);
    v.field("linear_damping_per_s", &B::linearDampingPerSecond, upTo(sceneLimits::maxDampingPerSecond),
            Need::optional);
    v.field("angular_damping_per_s", &B::angularDampingPerSecond, upTo(sceneLimits::maxDampingPerSecond),
            Need::optional);
    v.field("mass_kg", &B::massKg, Bounds{sceneLimits::minMassKg, sceneLimits::maxMassKg}, Need::optional);
    v.field("fixtures", &B::fixtures, items(1, sceneLimits::maxFixturesPerBody));
}

void visitFields(auto& v, FieldsOf<RevoluteJoint>) {
    v.field("anchor_m", &RevoluteJoint::anchorMetres, positionBounds);
    v.field("limits_rad", &RevoluteJoint::limitsRadians, angleBounds, Need::optional);
    v.field("motor_rad_per_s", &RevoluteJoint::motorRadiansPerSecond, spinBounds, Need::optional);
    v.field("max_torque_nm", &RevoluteJoint::maxTorqueNewtonMetres, torqueBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<WheelJoint>) {
    v.field("anchor_m", &WheelJoint::anchorMetres, positionBounds);
    v.field("axis", &WheelJoint::axis, absMax(1.0), Need::optional);
    v.field("suspension_hz", &WheelJoint::suspensionHz, upTo(sceneLimits::maxSpringHz), Need::optional);
    v.field("damping_ratio", &WheelJoint::dampingRatio, upTo(sceneLimits::maxDampingRatio), Need::optional);
    v.field("travel_m", &WheelJoint::travelMetres, positionBounds, Need::optional);
    v.field("motor_rad_per_s", &WheelJoint::motorRadiansPerSecond, spinBounds, Need::optional);
    v.field("max_torque_nm", &WheelJoint::maxTorqueNewtonMetres, torqueBounds, Need::optional);
    v.field("rest_m", &WheelJoint::restMetres, positionBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<DistanceJoint>) {
    v.field("anchor_a_m", &DistanceJoint::anchorAMetres, positionBounds);
    v.field("anchor_b_m", &DistanceJoint::anchorBMetres, positionBounds);
    v.field("spring_hz", &DistanceJoint::springHz, upTo(sceneLimits::maxSpringHz), Need::optional);
    v.field("damping_ratio", &DistanceJoint::dampingRatio, upTo(sceneLimits::maxDampingRatio),
            Need::optional);
    v.field("slack", &DistanceJoint::isSlack, {}, Need::optional);
    v.field("rest_m", &DistanceJoint::restMetres, positionBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<WeldJoint>) {
    v.field("anchor_m", &WeldJoint::anchorMetres, positionBounds);
    v.field("spring_hz", &WeldJoint::springHz, upTo(sceneLimits::maxSpringHz), Need::optional);
    v.field("damping_ratio", &WeldJoint::dampingRatio, upTo(sceneLimits::maxDampingRatio), Need::optional);
    v.field("rest_rad", &WeldJoint::restRadians, angleBounds, Need::optional);
}

void visitFields(auto& v, FieldsOf<SliderJoint>) {
    v.field("anchor_m", &SliderJoint::anchorMetres, positionBounds);
    v.field("axis", &SliderJoint::axis, absMax(1.0), Need::optional);
    v.field("travel_m", &SliderJoint::travelMetres, positionBounds, Need::optional);
    v.field("motor_m_per_s", &SliderJoint::motorMetresPerSecond, speedBounds, Need::optional);
    v.field("max_force_n", &SliderJoint::maxForceNewtons, upTo(sceneLimits::maxForceNewtons), Need::optional);
}

inline constexpr std::array<std::string_view, 5> jointNames{"revolute", "wheel", "distance", "weld",
                                                            "slider"};

void visitFields(auto& v, FieldsOf<JointDescription>) {
    v.field("name", &JointDescription::name, anyText);
    v.field("body_a", &JointDescription::bodyA, anyText);
    v.field("body_b", &JointDescription::bodyB, anyText);
    v.variant("type", &JointDescription::joint, jointNames);
    v.field("collide", &JointDescription::collide, {}, Need::optional);
}

void visitFields(auto& v, FieldsOf<GravityAction>) {
    v.field("gravity_m_per_s2", &GravityAction::gravityMetresPerSecond2, accelerationBounds);
}
void visitFields(auto& v, FieldsOf<TiltAction>) {
    v.field("angle_rad", &TiltAction::angleRadians, angleBounds);
}
void visitFields(auto& v, FieldsOf<ImpulseAction>) {
    v.field("body", &ImpulseAction::body, anyText);
    v.field("impulse_ns", &ImpulseAction::impulseNewtonSeconds, absMax(sceneLimits::maxImpulseNewtonSeconds));
    v.field("point_m", &ImpulseAction::pointMetres, positionBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<VelocityAction>) {
    v.field("body", &VelocityAction::body, anyText);
    v.field("velocity_m_per_s", &VelocityAction::velocityMetresPerSecond, speedBounds);
    v.field("spin_rad_per_s", &VelocityAction::spinRadiansPerSecond, spinBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<SpawnAction>) {
    v.field("body", &SpawnAction::body, {});
    v.field("shift_m", &SpawnAction::shiftMetres, positionBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<RemoveAction>) { v.field("body", &RemoveAction::body, anyText); }
void visitFields(auto& v, FieldsOf<MotorAction>) {
    v.field("joint", &MotorAction::joint, anyText);
    v.field("motor_rad_per_s", &MotorAction::speedRadiansPerSecond, spinBounds);
    v.field("max_torque_nm", &MotorAction::maxTorqueNewtonMetres, torqueBounds, Need::optional);
}
void visitFields(auto& v, FieldsOf<CameraAction>) {
    v.field("body", &CameraAction::body, anyText);
    v.field("fixture", &CameraAction::fixture, fixtureBounds, Need::optional);
    v.field("on", &CameraAction::isOn, {});
}
void visitFields(auto& v, FieldsOf<MaterialAction>) {
    v.field("body", &MaterialAction::body, anyText);
    v.field("fixture", &MaterialAction::fixture, fixtureBounds, Need::optional);
    v.material("material", &MaterialAction::material);
}

void visitFields(auto& v, FieldsOf<SoundAction>) {
    v.material("material", &SoundAction::material);
    v.field("frequency_hz", &SoundAction::frequencyHz,
            Bounds{sceneLimits::minSoundHz, limits::maxFrequencyHz});
    v.field("decay_per_s", &SoundAction::decayPerSecond,
            Bounds{sceneLimits::minSoundDecayPerSecond, limits::maxDecayPerSecond});
}

void visitFields(auto& v, FieldsOf<HoldAction>) {
    v.field("factor", &HoldAction::factor, upTo(sceneLimits::maxGravityFactor));
    v.field("angle_rad", &HoldAction::angleRadians, angleBounds);
}

void visitFields(auto& v, FieldsOf<TextureAction>) {
    v.material("material", &TextureAction::material);
    visitTexture<TextureAction>(v);
}

void visitFields(auto& v, FieldsOf<GripAction>) {
    v.field("body", &GripAction::body, anyText);
    v.field("to_m", &GripAction::toMetres, positionBounds, Need::optional);
    v.field("point_m", &GripAction::pointMetres, positionBounds, Need::optional);
    v.field("over_s", &GripAction::overSeconds, upTo(sceneLimits::maxScriptSeconds), Need::optional);
}

void visitFields(auto& v, FieldsOf<ChangeAction>) {
    v.field("body", &ChangeAction::body, {});
    v.field("stays", &ChangeAction::stays, {}, Need::optional);
}
void visitFields(auto& v, FieldsOf<JoinAction>) { v.field("joint", &JoinAction::joint, {}); }
void visitFields(auto& v, FieldsOf<UnjoinAction>) { v.field("joint", &UnjoinAction::joint, anyText); }

inline constexpr std::array<std::string_view, 16> actionNames{
    "gravity",  "tilt",  "impulse", "velocity", "spawn", "remove", "motor", "camera",
    "material", "sound", "hold",    "texture",  "grip",  "change", "join",  "unjoin"};

void visitFields(auto& v, FieldsOf<ScriptInput>) {
    v.field("time_s", &ScriptInput::timeSeconds, upTo(sceneLimits::maxScriptSeconds));
    v.field("times", &ScriptInput::times, Bounds{1.0, static_cast<double>(sceneLimits::maxActions)},
            Need::optional);
    v.field("every_s", &ScriptInput::everySeconds, upTo(sceneLimits::maxScriptSeconds), Need::optional);
    v.variant("input", &ScriptInput::action, actionNames);
}

void visitFields(auto& v, FieldsOf<LiveInput>) {
    v.field("time_s", &LiveInput::timeSeconds, upTo(sceneLimits::maxLiveSeconds));
    v.variant("input", &LiveInput::action, actionNames);
}

void visitFields(auto& v, FieldsOf<Normalisation>) {
    v.field("a_star_s_per_m", &Normalisation::secondsPerMetre,
            Bounds{sceneLimits::minNormalisation, sceneLimits::maxNormalisation}, Need::optional);
    v.field("hand_mass_kg", &Normalisation::handMassKg, upTo(sceneLimits::maxMassKg), Need::optional);
}

void visitFields(auto& v, FieldsOf<Scene>) {
    v.field("name", &Scene::name, anyText);
    v.field("description", &Scene::description, anyText, Need::optional);
    v.pair("field_m", &Scene::fieldWidthMetres, &Scene::fieldHeightMetres,
           Bounds{sceneLimits::minSizeMetres, sceneLimits::maxPositionMetres});
    v.field("gravity_m_per_s2", &Scene::gravityMetresPerSecond2, accelerationBounds, Need::optional);
    v.field("drive_gain", &Scene::driveGain, upTo(sceneLimits::maxDriveGain), Need::optional);
    v.field("normalisation", &Scene::normalisation, {}, Need::optional);
    v.field("materials", &Scene::materials, items(0, sceneLimits::maxMaterials));
    v.field("bodies", &Scene::bodies, items(0, sceneLimits::maxBodies));
    v.field("joints", &Scene::joints, items(0, sceneLimits::maxJoints), Need::optional);
    v.field("script", &Scene::script, items(0, sceneLimits::maxInputs), Need::optional);
    v.field("script_period_s", &Scene::scriptPeriodSeconds,
            Bounds{sceneLimits::minScriptPeriodSeconds, sceneLimits::maxScriptSeconds}, Need::optional);
    v.field("inputs", &Scene::inputs, items(0, sceneLimits::maxLiveInputs), Need::optional);
}

} // namespace physvib
