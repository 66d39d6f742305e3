// SPDX-License-Identifier: MIT
// Creates Box2D bodies, fixtures and joints from a scene's descriptions; start states with or without jitter.
// For the message thread.
#pragma once
#include "Scene/Scene.h"
#include <box2d/box2d.h>
#include <random>
#include <vector>

namespace physvib {

/// Start state of a body: as described, or with the small jitter that a seed adds.
struct BodyStart {
    Vector positionMetres;
    double angleRadians = 0.0;
    Vector velocityMetresPerSecond;
};

inline BodyStart describedStart(const BodyDescription& body) noexcept {
    return {body.positionMetres, body.angleRadians, body.velocityMetresPerSecond};
}

/// The start with place, angle and velocity changed at random by up to 1 mm, 1 mrad and 1 mm/s: a fall from 1
/// m shifts by at most 0.33 ms, while the bodies of a full box diverge after some impacts.
inline BodyStart jitteredStart(const BodyDescription& body, std::mt19937& random) noexcept {
    constexpr double reach = 1.0e-3;
    const auto draw = [&random] { return (static_cast<double>(random()) * 0x1p-31 - 1.0) * reach; };
    BodyStart start = describedStart(body);
    start.positionMetres.x += draw();
    start.positionMetres.y += draw();
    start.angleRadians += draw();
    start.velocityMetresPerSecond.x += draw();
    start.velocityMetresPerSecond.y += draw();
    return start;
}

inline b2Vec2 box2dVector(const Vector& v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Creates a body of a valid scene, with outlines exactly as described, and appends its fixtures. Bodies that
/// move by more than their thickness per step at twice v_max (Eq. 5.7) are bullets.
b2Body& createBody(b2World& world, const Scene& scene, const BodyDescription& body, const BodyStart& start,
                   double stepSeconds, std::vector<b2Fixture*>& fixtures);

/// Resets a body to its start and enables it.
void restartBody(b2Body& worldBody, const BodyDescription& body, const BodyStart& start);

/// Sets a dynamic body's mass from its description; others have none.
void setMass(b2Body& worldBody, const BodyDescription& body, const Scene& scene);

/// Sets friction and restitution of a fixture.
void setSurface(b2Fixture& fixture, const FixtureDescription& description, const Material& material);

/// Creates a joint between two bodies where they are now.
b2Joint& createJoint(b2World& world, const JointDescription& joint, b2Body& bodyA, b2Body& bodyB);

/// Replaces `from` by `to` in one of its joints, with the same anchor points. Returns the new joint; the old
/// one is destroyed.
b2Joint& moveJoint(b2World& world, b2Joint& joint, b2Body& from, b2Body& to);

} // namespace physvib
