// SPDX-License-Identifier: MIT
// One line of Box2D per question.
#include "Physics/WorldBodies.h"
#include "Physics/WorldNames.h"

namespace physvib {

BodyFacts WorldBodies::facts(std::uint64_t body) const { return factsOf(bodyOf(body)); }

BodyMotion WorldBodies::motion(std::uint64_t body) const { return motionOf(bodyOf(body)); }

BodyMotion WorldBodies::motionBefore(std::uint64_t body) const { return sweeps_.start(bodyOf(body)); }

Vector2 WorldBodies::centre(std::uint64_t body) const { return toVector(bodyOf(body).GetWorldCenter()); }

Vector2 WorldBodies::toWorld(std::uint64_t body, Vector2 ofBody) const {
    return toVector(bodyOf(body).GetWorldPoint({ofBody.x, ofBody.y}));
}

double WorldBodies::inertia(std::uint64_t body) const {
    const b2Body& of = bodyOf(body);
    return of.GetInertia() - of.GetMass() * of.GetLocalCenter().LengthSquared();
}

} // namespace physvib
