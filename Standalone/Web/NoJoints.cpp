// SPDX-License-Identifier: MIT
// Replaces the code of Box2D joint types that no scene uses by stubs, to keep the module small.
#include <box2d/box2d.h>
#include <cstdlib>

#define NO_JOINT(Joint)                                                                                      \
    Joint::Joint(const Joint##Def* def)                                                                      \
        : b2Joint(def) {                                                                                     \
        std::abort();                                                                                        \
    }                                                                                                        \
    b2Vec2 Joint::GetAnchorA() const { std::abort(); }                                                       \
    b2Vec2 Joint::GetAnchorB() const { std::abort(); }                                                       \
    b2Vec2 Joint::GetReactionForce(float) const { std::abort(); }                                            \
    float Joint::GetReactionTorque(float) const { std::abort(); }                                            \
    void Joint::Dump() {}                                                                                    \
    void Joint::InitVelocityConstraints(const b2SolverData&) {}                                              \
    void Joint::SolveVelocityConstraints(const b2SolverData&) {}                                             \
    bool Joint::SolvePositionConstraints(const b2SolverData&) { std::abort(); }

NO_JOINT(b2FrictionJoint)
NO_JOINT(b2GearJoint)
NO_JOINT(b2MotorJoint)
NO_JOINT(b2PulleyJoint)
void b2PulleyJoint::ShiftOrigin(const b2Vec2&) {}
b2Vec2 b2PulleyJoint::GetGroundAnchorA() const { std::abort(); }
b2Vec2 b2PulleyJoint::GetGroundAnchorB() const { std::abort(); }
