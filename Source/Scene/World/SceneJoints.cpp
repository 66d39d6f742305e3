// SPDX-License-Identifier: MIT
// Creates Box2D joints from a scene's descriptions.
#include "Core/PortableMath.h"
#include "Scene/World/SceneBodies.h"
#include "Scene/World/SceneWorld.h"
#include <cmath>
#include <optional>
#include <type_traits>

namespace physvib {

namespace {

/// Creates the joint that `Def` defines, with what all of them have in common.
template <class Def>
b2Joint& create(b2World& world, Def& def, const JointDescription& joint) {
    def.collideConnected = joint.collide;
    return *world.CreateJoint(&def);
}

template <class Def, class Driven>
void setMotor(Def& def, const Driven& joint) {
    def.motorSpeed = static_cast<float>(joint.motorRadiansPerSecond);
    def.maxMotorTorque = static_cast<float>(joint.maxTorqueNewtonMetres);
    def.enableMotor = true; // without effect at a torque of 0, which the script may change
}

void setLimits(bool& isLimited, float& lower, float& upper, const std::optional<Interval>& limits) {
    isLimited = limits.has_value();
    lower = static_cast<float>(limits.value_or(Interval{}).lower);
    upper = static_cast<float>(limits.value_or(Interval{}).upper);
}

Vector unit(const Vector& axis) {
    const double length = portable::hypot(axis.x, axis.y);
    return {axis.x / length, axis.y / length};
}

class Maker {
public:
    Maker(b2World& world, const JointDescription& joint, b2Body& a, b2Body& b)
        : world_(world)
        , joint_(joint)
        , a_(a)
        , b_(b) {}

    b2Joint& operator()(const RevoluteJoint& joint) const {
        b2RevoluteJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorMetres));
        setLimits(def.enableLimit, def.lowerAngle, def.upperAngle, joint.limitsRadians);
        setMotor(def, joint);
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const WheelJoint& joint) const {
        b2WheelJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorMetres), box2dVector(unit(joint.axis)));
        spring(def.stiffness, def.damping, joint.suspensionHz, joint.dampingRatio);
        setLimits(def.enableLimit, def.lowerTranslation, def.upperTranslation, joint.travelMetres);
        setMotor(def, joint);
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const DistanceJoint& joint) const {
        b2DistanceJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorAMetres), box2dVector(joint.anchorBMetres));
        if (!joint.isSlack) spring(def.stiffness, def.damping, joint.springHz, joint.dampingRatio);
        // else a rod: Box2D keeps the length between these two
        if (joint.isSlack || joint.springHz > 0.0) def.minLength = 0.0F;
        if (!joint.isSlack && joint.springHz > 0.0) def.maxLength = b2_maxFloat;
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const WeldJoint& joint) const {
        b2WeldJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorMetres));
        if (joint.springHz > 0.0)
            b2AngularStiffness(def.stiffness, def.damping, static_cast<float>(joint.springHz),
                               static_cast<float>(joint.dampingRatio), &a_, &b_);
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const SliderJoint& joint) const {
        b2PrismaticJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorMetres), box2dVector(unit(joint.axis)));
        setLimits(def.enableLimit, def.lowerTranslation, def.upperTranslation, joint.travelMetres);
        def.motorSpeed = static_cast<float>(joint.motorMetresPerSecond);
        def.maxMotorForce = static_cast<float>(joint.maxForceNewtons);
        def.enableMotor = true;
        return create(world_, def, joint_);
    }

private:
    void spring(float& stiffness, float& damping, double frequencyHz, double ratio) const {
        if (frequencyHz > 0.0)
            b2LinearStiffness(stiffness, damping, static_cast<float>(frequencyHz), static_cast<float>(ratio),
                              &a_, &b_);
    }

    b2World& world_;
    const JointDescription& joint_;
    b2Body& a_;
    b2Body& b_;
};

template <class Def, class Made>
void copyAnchors(Def& def, const Made& made) {
    def.localAnchorA = made.GetLocalAnchorA();
    def.localAnchorB = made.GetLocalAnchorB();
}
template <class Def, class Made>
void copySpring(Def& def, const Made& made) {
    def.stiffness = made.GetStiffness();
    def.damping = made.GetDamping();
}
template <class Def, class Made>
void copyTravel(Def& def, const Made& made) {
    def.enableLimit = made.IsLimitEnabled();
    def.lowerTranslation = made.GetLowerLimit();
    def.upperTranslation = made.GetUpperLimit();
    def.localAxisA = made.GetLocalAxisA();
    def.motorSpeed = made.GetMotorSpeed();
    def.enableMotor = true;
}

b2RevoluteJointDef defOf(const b2RevoluteJoint& made) {
    b2RevoluteJointDef def;
    copyAnchors(def, made);
    def.referenceAngle = made.GetReferenceAngle();
    def.enableLimit = made.IsLimitEnabled();
    def.lowerAngle = made.GetLowerLimit();
    def.upperAngle = made.GetUpperLimit();
    def.motorSpeed = made.GetMotorSpeed();
    def.maxMotorTorque = made.GetMaxMotorTorque();
    def.enableMotor = true;
    return def;
}
b2WheelJointDef defOf(const b2WheelJoint& made) {
    b2WheelJointDef def;
    copyAnchors(def, made);
    copyTravel(def, made);
    def.maxMotorTorque = made.GetMaxMotorTorque();
    copySpring(def, made);
    return def;
}
b2DistanceJointDef defOf(const b2DistanceJoint& made) {
    b2DistanceJointDef def;
    copyAnchors(def, made);
    def.length = made.GetLength();
    def.minLength = made.GetMinLength();
    def.maxLength = made.GetMaxLength();
    copySpring(def, made);
    return def;
}
b2WeldJointDef defOf(const b2WeldJoint& made) {
    b2WeldJointDef def;
    copyAnchors(def, made);
    def.referenceAngle = made.GetReferenceAngle();
    copySpring(def, made);
    return def;
}
b2PrismaticJointDef defOf(const b2PrismaticJoint& made) {
    b2PrismaticJointDef def;
    copyAnchors(def, made);
    copyTravel(def, made);
    def.referenceAngle = made.GetReferenceAngle();
    def.maxMotorForce = made.GetMaxMotorForce();
    return def;
}

template <class Made>
b2Joint& moved(b2World& world, b2Joint& joint, b2Body& from, b2Body& to) {
    auto def = defOf(static_cast<const Made&>(joint));
    def.bodyA = joint.GetBodyA() == &from ? &to : joint.GetBodyA();
    def.bodyB = joint.GetBodyB() == &from ? &to : joint.GetBodyB();
    def.collideConnected = joint.GetCollideConnected();
    b2Joint* const made = world.CreateJoint(&def);
    world.DestroyJoint(&joint);
    return *made;
}

} // namespace

b2Joint& moveJoint(b2World& world, b2Joint& joint, b2Body& from, b2Body& to) {
    switch (joint.GetType()) {
    case e_revoluteJoint: return moved<b2RevoluteJoint>(world, joint, from, to);
    case e_wheelJoint: return moved<b2WheelJoint>(world, joint, from, to);
    case e_distanceJoint: return moved<b2DistanceJoint>(world, joint, from, to);
    case e_weldJoint: return moved<b2WeldJoint>(world, joint, from, to);
    default: return moved<b2PrismaticJoint>(world, joint, from, to); // there are no others in a scene
    }
}

b2Joint& createJoint(b2World& world, const JointDescription& joint, b2Body& bodyA, b2Body& bodyB) {
    return std::visit(Maker(world, joint, bodyA, bodyB), joint.joint);
}

JointPose describedPose(const JointDescription& joint) {
    return std::visit(
        [&joint](const auto& kind) -> JointPose {
            if constexpr (requires { kind.anchorMetres; }) {
                Vector end = kind.anchorMetres;
                if constexpr (std::is_same_v<decltype(kind), const SliderJoint&>) {
                    const double length = kind.travelMetres ? kind.travelMetres->upper : 0.0;
                    end = {end.x + length * unit(kind.axis).x, end.y + length * unit(kind.axis).y};
                }
                return {joint.joint, kind.anchorMetres, end};
            } else
                return {joint.joint, kind.anchorAMetres, kind.anchorBMetres};
        },
        joint.joint);
}

std::vector<JointPose> SceneWorld::jointPoses() const {
    std::vector<JointPose> poses;
    for (const auto& [name, held] : joints_) {
        b2Joint& made = *held.made;
        if (!made.IsEnabled()) continue;
        const b2Vec2 a = made.GetAnchorA();
        b2Vec2 b = made.GetAnchorB();
        if (made.GetType() == e_prismaticJoint) {
            const auto& slider = static_cast<const b2PrismaticJoint&>(made);
            const float way = slider.IsLimitEnabled() ? slider.GetUpperLimit() : 0.0F;
            b = made.GetBodyA()->GetWorldPoint(slider.GetLocalAnchorA() + way * slider.GetLocalAxisA());
        }
        poses.push_back({held.described, {a.x, a.y}, {b.x, b.y}});
    }
    return poses;
}

} // namespace physvib
