// SPDX-License-Identifier: MIT
// Box2D's definitions of a scene's joints.
#include "Scene/World/SceneBodies.h"
#include <cmath>

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
    def.enableMotor = true; // with a torque of 0 it does nothing, and the script may change that
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
        def.enableLimit = joint.limitsRadians.has_value();
        const Interval limits = joint.limitsRadians.value_or(Interval{});
        def.lowerAngle = static_cast<float>(limits.lower);
        def.upperAngle = static_cast<float>(limits.upper);
        setMotor(def, joint);
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const WheelJoint& joint) const {
        const double length = std::hypot(joint.axis.x, joint.axis.y);
        b2WheelJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorMetres),
                       box2dVector({joint.axis.x / length, joint.axis.y / length}));
        spring(def.stiffness, def.damping, joint.suspensionHz, joint.dampingRatio);
        def.enableLimit = joint.travelMetres.has_value();
        const Interval travel = joint.travelMetres.value_or(Interval{});
        def.lowerTranslation = static_cast<float>(travel.lower);
        def.upperTranslation = static_cast<float>(travel.upper);
        setMotor(def, joint);
        return create(world_, def, joint_);
    }
    b2Joint& operator()(const DistanceJoint& joint) const {
        b2DistanceJointDef def;
        def.Initialize(&a_, &b_, box2dVector(joint.anchorAMetres), box2dVector(joint.anchorBMetres));
        spring(def.stiffness, def.damping, joint.springHz, joint.dampingRatio);
        if (joint.springHz > 0.0) { // else a rod: Box2D keeps the length between these two
            def.minLength = 0.0F;
            def.maxLength = b2_maxFloat;
        }
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

} // namespace

b2Joint& createJoint(b2World& world, const JointDescription& joint, b2Body& bodyA, b2Body& bodyB) {
    return std::visit(Maker(world, joint, bodyA, bodyB), joint.joint);
}

} // namespace physvib
