// SPDX-License-Identifier: MIT
// Creates Box2D bodies, fixtures and joints from a scene's descriptions and moves joints; places of joints.
#include "Scene/World/SceneBodies.h"
#include "Contacts/ImpactSettings.h"
#include "Core/PortableMath.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/SceneWorld.h"
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>

namespace physvib {

namespace {

/// Builds the b2Shape of a fixture, at its place in the body.
class ShapeBuilder {
public:
    explicit ShapeBuilder(const FixtureDescription& fixture)
        : transform_(box2dVector(fixture.offsetMetres), b2Rot(static_cast<float>(fixture.angleRadians))) {
        std::visit([this](const auto& shape) { make(shape); }, fixture.shape);
    }
    const b2Shape& shape() const { return *shape_; }

private:
    void make(const CircleShape& c) {
        circle_.m_p = transform_.p;
        circle_.m_radius = static_cast<float>(c.radiusMetres);
        shape_ = &circle_;
    }

    // Contacts of polygons begin at a skin of b2_polygonRadius around them. Shrinking the outline by that
    // radius makes them begin at the described outline; very thin shapes keep most of their thickness.
    void make(const BoxShape& b) {
        const auto halfSide = [](double side) {
            const double skin = std::min(static_cast<double>(b2_polygonRadius), side / 4.0);
            return static_cast<float>(side / 2.0 - skin);
        };
        polygon_.SetAsBox(halfSide(b.widthMetres), halfSide(b.heightMetres), transform_.p,
                          transform_.q.GetAngle());
        shape_ = &polygon_;
    }
    void make(const PolygonShape& p) {
        const double skin = std::min(static_cast<double>(b2_polygonRadius), thicknessMetres(p) / 8.0);
        const auto points = transformed(inset(p.verticesMetres, skin));
        polygon_.Set(points.data(), static_cast<int32>(points.size()));
        shape_ = &polygon_;
    }

    void make(const ChainShape& c) {
        const auto points = transformed(c.verticesMetres);
        const auto count = static_cast<int32>(points.size());
        if (c.isLoop)
            chain_.CreateLoop(points.data(), count);
        else // ghost vertices continue the line straight beyond its ends
            chain_.CreateChain(points.data(), count, 2.0F * points[0] - points[1],
                               2.0F * points.back() - points[points.size() - 2]);
        shape_ = &chain_;
    }

    std::vector<b2Vec2> transformed(const std::vector<Vector>& vertices) const {
        std::vector<b2Vec2> points;
        for (const Vector& vertex : vertices) points.push_back(b2Mul(transform_, box2dVector(vertex)));
        return points;
    }

    b2Transform transform_;
    b2CircleShape circle_;
    b2PolygonShape polygon_;
    b2ChainShape chain_;
    const b2Shape* shape_ = nullptr;
};

double minThicknessMetres(const BodyDescription& body) {
    double minMetres = std::numeric_limits<double>::infinity();
    for (const FixtureDescription& fixture : body.fixtures)
        minMetres = std::min(minMetres, thicknessMetres(fixture.shape));
    return minMetres;
}

} // namespace

b2Body& createBody(b2World& world, const Scene& scene, const BodyDescription& body, const BodyStart& start,
                   double stepSeconds, std::vector<b2Fixture*>& fixtures) {
    constexpr std::array types{b2_staticBody, b2_kinematicBody, b2_dynamicBody};
    b2BodyDef def;
    def.type = types[static_cast<std::size_t>(body.type)];
    def.position = box2dVector(start.positionMetres);
    def.angle = static_cast<float>(start.angleRadians);
    if (body.type != BodyType::staticBody) def.linearVelocity = box2dVector(start.velocityMetresPerSecond);
    def.angularVelocity = static_cast<float>(body.spinRadiansPerSecond);
    def.linearDamping = static_cast<float>(body.linearDampingPerSecond);
    def.angularDamping = static_cast<float>(body.angularDampingPerSecond);
    const double maxSpeed = 2.0 * largestSpeed(scene.fieldWidthMetres);
    def.bullet = minThicknessMetres(body) < maxSpeed * stepSeconds;
    b2Body& worldBody = *world.CreateBody(&def);
    for (const FixtureDescription& fixture : body.fixtures) {
        fixtures.push_back(worldBody.CreateFixture(&ShapeBuilder(fixture).shape(), 0.0F));
        // A line has no skin, but Box2D's copy of a chain resets the radius.
        if (std::holds_alternative<ChainShape>(fixture.shape)) fixtures.back()->GetShape()->m_radius = 0.0F;
        setSurface(*fixtures.back(), fixture, scene.materials[static_cast<std::size_t>(fixture.material)]);
    }
    setMass(worldBody, body, scene);
    return worldBody;
}

void restartBody(b2Body& worldBody, const BodyDescription& body, const BodyStart& start) {
    worldBody.SetEnabled(false); // ends its contacts
    worldBody.SetTransform(box2dVector(start.positionMetres), static_cast<float>(start.angleRadians));
    worldBody.SetLinearVelocity(box2dVector(start.velocityMetresPerSecond));
    worldBody.SetAngularVelocity(static_cast<float>(body.spinRadiansPerSecond));
    worldBody.SetEnabled(true);
    worldBody.SetAwake(true);
}

void setMass(b2Body& worldBody, const BodyDescription& body, const Scene& scene) {
    if (body.type != BodyType::dynamicBody) return;
    const BodyMoments moments = bodyMoments(body, scene);
    const Vector& c = moments.centreMetres;
    const double aboutOrigin = moments.inertiaKgSquareMetres + moments.massKg * (c.x * c.x + c.y * c.y);
    const b2MassData data{static_cast<float>(moments.massKg), box2dVector(c),
                          static_cast<float>(aboutOrigin)};
    worldBody.SetMassData(&data);
}

void setSurface(b2Fixture& fixture, const FixtureDescription& description, const Material& material) {
    fixture.SetFriction(static_cast<float>(material.friction));
    fixture.SetRestitution(static_cast<float>(description.restitution.value_or(material.restitution)));
}

namespace {

void setMotor(auto& def, const auto& joint) {
    def.motorSpeed = static_cast<float>(joint.motorRadiansPerSecond);
    def.maxMotorTorque = static_cast<float>(joint.maxTorqueNewtonMetres);
    def.enableMotor = true; // without effect at a torque of 0, which the script may change
}

void setLimits(bool& isLimited, float& lower, float& upper, const std::optional<Interval>& limits) {
    isLimited = limits.has_value();
    lower = static_cast<float>(limits.value_or(Interval{}).lower);
    upper = static_cast<float>(limits.value_or(Interval{}).upper);
}

Vector normalised(const Vector& axis) {
    const double length = portable::hypot(axis.x, axis.y);
    return {axis.x / length, axis.y / length};
}

struct JointBuilder {
    b2World& world;
    const JointDescription& description;
    b2Body &a, &b;

    b2Joint& operator()(const RevoluteJoint& joint) const {
        b2RevoluteJointDef def;
        def.Initialize(&a, &b, box2dVector(joint.anchorMetres));
        setLimits(def.enableLimit, def.lowerAngle, def.upperAngle, joint.limitsRadians);
        setMotor(def, joint);
        return create(def);
    }
    b2Joint& operator()(const WheelJoint& joint) const {
        b2WheelJointDef def;
        def.Initialize(&a, &b, box2dVector(joint.anchorMetres), box2dVector(normalised(joint.axis)));
        setSpring(def.stiffness, def.damping, joint.suspensionHz, joint.dampingRatio);
        setLimits(def.enableLimit, def.lowerTranslation, def.upperTranslation, joint.travelMetres);
        // Box2D's spring rests where the anchors meet, and its limits count from there
        const auto rest = static_cast<float>(joint.restMetres);
        def.localAnchorA += rest * def.localAxisA;
        def.lowerTranslation -= rest;
        def.upperTranslation -= rest;
        setMotor(def, joint);
        return create(def);
    }
    b2Joint& operator()(const DistanceJoint& joint) const {
        b2DistanceJointDef def;
        def.Initialize(&a, &b, box2dVector(joint.anchorAMetres), box2dVector(joint.anchorBMetres));
        def.minLength = def.maxLength = def.length += static_cast<float>(joint.restMetres);
        if (!joint.isSlack) setSpring(def.stiffness, def.damping, joint.springHz, joint.dampingRatio);
        // a rope may be shorter, a spring also longer; a rod keeps its length
        if (joint.isSlack || joint.springHz > 0.0) def.minLength = 0.0F;
        if (!joint.isSlack && joint.springHz > 0.0) def.maxLength = b2_maxFloat;
        return create(def);
    }
    b2Joint& operator()(const WeldJoint& joint) const {
        b2WeldJointDef def;
        def.Initialize(&a, &b, box2dVector(joint.anchorMetres));
        def.referenceAngle += static_cast<float>(joint.restRadians);
        if (joint.springHz > 0.0)
            b2AngularStiffness(def.stiffness, def.damping, static_cast<float>(joint.springHz),
                               static_cast<float>(joint.dampingRatio), &a, &b);
        return create(def);
    }
    b2Joint& operator()(const SliderJoint& joint) const {
        b2PrismaticJointDef def;
        def.Initialize(&a, &b, box2dVector(joint.anchorMetres), box2dVector(normalised(joint.axis)));
        setLimits(def.enableLimit, def.lowerTranslation, def.upperTranslation, joint.travelMetres);
        def.motorSpeed = static_cast<float>(joint.motorMetresPerSecond);
        def.maxMotorForce = static_cast<float>(joint.maxForceNewtons);
        def.enableMotor = true;
        return create(def);
    }

    b2Joint& create(auto& def) const {
        def.collideConnected = description.collide;
        return *world.CreateJoint(&def);
    }
    void setSpring(float& stiffness, float& damping, double frequencyHz, double ratio) const {
        if (frequencyHz > 0.0)
            b2LinearStiffness(stiffness, damping, static_cast<float>(frequencyHz), static_cast<float>(ratio),
                              &a, &b);
    }
};

/// A definition with the joint's present values, but without its bodies.
template <class Def, class JointType>
Def copyDefinition(const JointType& joint) {
    Def def;
    def.localAnchorA = joint.GetLocalAnchorA();
    def.localAnchorB = joint.GetLocalAnchorB();
    def.collideConnected = joint.GetCollideConnected();
    if constexpr (requires { def.referenceAngle; }) def.referenceAngle = joint.GetReferenceAngle();
    if constexpr (requires { def.localAxisA; }) def.localAxisA = joint.GetLocalAxisA();
    if constexpr (requires { def.stiffness; }) {
        def.stiffness = joint.GetStiffness();
        def.damping = joint.GetDamping();
    }
    if constexpr (requires { def.lowerTranslation; }) {
        def.lowerTranslation = joint.GetLowerLimit();
        def.upperTranslation = joint.GetUpperLimit();
    }
    if constexpr (requires { def.lowerAngle; }) {
        def.lowerAngle = joint.GetLowerLimit();
        def.upperAngle = joint.GetUpperLimit();
    }
    if constexpr (requires { def.enableMotor; }) {
        def.enableLimit = joint.IsLimitEnabled();
        def.motorSpeed = joint.GetMotorSpeed();
        def.enableMotor = true;
    }
    if constexpr (requires { def.maxMotorTorque; }) def.maxMotorTorque = joint.GetMaxMotorTorque();
    if constexpr (requires { def.maxMotorForce; }) def.maxMotorForce = joint.GetMaxMotorForce();
    if constexpr (requires { def.minLength; }) {
        def.length = joint.GetLength();
        def.minLength = joint.GetMinLength();
        def.maxLength = joint.GetMaxLength();
    }
    return def;
}

template <class JointType, class Def>
b2Joint& recreateJoint(b2World& world, b2Joint& joint, b2Body& from, b2Body& to) {
    Def def = copyDefinition<Def>(static_cast<const JointType&>(joint));
    def.bodyA = joint.GetBodyA() == &from ? &to : joint.GetBodyA();
    def.bodyB = joint.GetBodyB() == &from ? &to : joint.GetBodyB();
    b2Joint* const newJoint = world.CreateJoint(&def);
    world.DestroyJoint(&joint);
    return *newJoint;
}

} // namespace

b2Joint& moveJoint(b2World& world, b2Joint& joint, b2Body& from, b2Body& to) {
    switch (joint.GetType()) {
    case e_revoluteJoint: return recreateJoint<b2RevoluteJoint, b2RevoluteJointDef>(world, joint, from, to);
    case e_wheelJoint: return recreateJoint<b2WheelJoint, b2WheelJointDef>(world, joint, from, to);
    case e_distanceJoint: return recreateJoint<b2DistanceJoint, b2DistanceJointDef>(world, joint, from, to);
    case e_weldJoint: return recreateJoint<b2WeldJoint, b2WeldJointDef>(world, joint, from, to);
    default: // the only other type of joint in a scene
        return recreateJoint<b2PrismaticJoint, b2PrismaticJointDef>(world, joint, from, to);
    }
}

b2Joint& createJoint(b2World& world, const JointDescription& joint, b2Body& bodyA, b2Body& bodyB) {
    return std::visit(JointBuilder{world, joint, bodyA, bodyB}, joint.joint);
}

JointPose jointPose(const JointDescription& joint) {
    return std::visit(
        [&joint](const auto& kind) -> JointPose {
            if constexpr (requires { kind.anchorMetres; }) {
                Vector end = kind.anchorMetres;
                if constexpr (std::is_same_v<decltype(kind), const SliderJoint&>) {
                    const double length = kind.travelMetres ? kind.travelMetres->upper : 0.0;
                    end = {end.x + length * normalised(kind.axis).x,
                           end.y + length * normalised(kind.axis).y};
                }
                return {joint.joint, kind.anchorMetres, end};
            } else
                return {joint.joint, kind.anchorAMetres, kind.anchorBMetres};
        },
        joint.joint);
}

std::vector<JointPose> SceneWorld::jointPoses() const {
    std::vector<JointPose> poses;
    for (const auto& [name, worldJoint] : joints_) {
        b2Joint& joint = *worldJoint.joint;
        if (!joint.IsEnabled()) continue;
        const b2Vec2 a = joint.GetAnchorA();
        b2Vec2 b = joint.GetAnchorB();
        if (joint.GetType() == e_prismaticJoint) {
            const auto& slider = static_cast<const b2PrismaticJoint&>(joint);
            const float travel = slider.IsLimitEnabled() ? slider.GetUpperLimit() : 0.0F;
            b = joint.GetBodyA()->GetWorldPoint(slider.GetLocalAnchorA() + travel * slider.GetLocalAxisA());
        }
        poses.push_back({worldJoint.description, {a.x, a.y}, {b.x, b.y}});
    }
    return poses;
}

} // namespace physvib
