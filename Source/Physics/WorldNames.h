// SPDX-License-Identifier: MIT
// What Contacts calls the things of a b2World: their addresses; and Box2D's vectors in its type.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/FixtureTable.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

template <class T>
std::uint64_t nameOf(const T& thing) noexcept {
    return reinterpret_cast<std::uintptr_t>(&thing);
}
inline const b2Body& bodyOf(const KnownFixture& known) noexcept {
    return *reinterpret_cast<const b2Body*>(static_cast<std::uintptr_t>(known.facts.body));
}
inline const b2Fixture& fixtureOf(const KnownFixture& known) noexcept {
    return *reinterpret_cast<const b2Fixture*>(static_cast<std::uintptr_t>(known.facts.fixture));
}

inline Vector2 toVector(b2Vec2 v) noexcept { return {v.x, v.y}; }

inline BodyMotion motionOf(const b2Body& body) noexcept {
    return {toVector(body.GetLinearVelocity()), body.GetAngularVelocity()};
}

/// `bodyIndex`: the body's place in the world's list, if that is known.
inline FixtureFacts factsOf(const b2Fixture& fixture, std::int32_t bodyIndex = 0) noexcept {
    const b2Body& body = *fixture.GetBody();
    return {nameOf(fixture), nameOf(body), bodyIndex, body.GetMass(), body.GetType() == b2_dynamicBody};
}

} // namespace physvib
