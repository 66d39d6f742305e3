// SPDX-License-Identifier: MIT
// Conversions between Box2D's objects and Contacts: objects to numbers (their addresses), vectors, body
// properties.
#pragma once
#include "Contacts/BodyReader.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

template <class T>
std::uint64_t idOf(const T& thing) noexcept {
    return reinterpret_cast<std::uintptr_t>(&thing);
}
inline const b2Body& bodyOf(std::uint64_t name) noexcept {
    return *reinterpret_cast<const b2Body*>(static_cast<std::uintptr_t>(name));
}

inline Vector2 toVector(b2Vec2 v) noexcept { return {v.x, v.y}; }

inline BodyMotion motionOf(const b2Body& body) noexcept {
    return {toVector(body.GetLinearVelocity()), body.GetAngularVelocity()};
}

inline BodyFacts factsOf(const b2Body& body) noexcept {
    return {idOf(body), body.GetMass(), body.GetGravityScale(), body.GetType() == b2_dynamicBody,
            body.IsEnabled()};
}

/// Centre of mass of the fixture alone, in its body's frame.
inline Vector2 centreOf(const b2Fixture& fixture) {
    b2MassData mass;
    fixture.GetMassData(&mass);
    return toVector(mass.center);
}

} // namespace physvib
