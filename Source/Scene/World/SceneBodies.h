// SPDX-License-Identifier: MIT
// Creates Box2D bodies, fixtures and joints from a scene's descriptions.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/BodyStart.h"
#include <box2d/box2d.h>
#include <vector>

namespace physvib {

inline b2Vec2 box2dVector(const Vector& v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Creates a scene's body and appends its fixtures, in their order; outlines exactly as described. Bodies
/// that cross their own thickness within a step at twice v_max (Eq. 5.7) are bullets. The scene must be
/// valid. M only.
b2Body& createBody(b2World& world, const Scene& scene, const BodyDescription& body, const BodyStart& start,
                   double stepSeconds, std::vector<b2Fixture*>& fixtures);

/// Resets a body to its start and enables it. M only.
void restartBody(b2Body& created, const BodyDescription& body, const BodyStart& start);

/// Sets a dynamic body's mass from its description; others have none. M only.
void setMass(b2Body& created, const BodyDescription& body, const Scene& scene);

/// Friction and restitution. M only.
void setSurface(b2Fixture& fixture, const FixtureDescription& description, const Material& material);

/// Creates a joint between two bodies where they are now. M only.
b2Joint& createJoint(b2World& world, const JointDescription& joint, b2Body& bodyA, b2Body& bodyB);

/// Replaces `from` by `to` in one of its joints, with the same anchor points. Returns the new joint; the old
/// one is destroyed. M only.
b2Joint& moveJoint(b2World& world, b2Joint& joint, b2Body& from, b2Body& to);

} // namespace physvib
