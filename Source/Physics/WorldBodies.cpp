// SPDX-License-Identifier: MIT
// One line of Box2D per question.
#include "Physics/WorldBodies.h"
#include "Physics/WorldNames.h"

namespace physvib {

BodyMotion WorldBodies::motion(const KnownFixture& fixture) const { return motionOf(bodyOf(fixture)); }

BodyMotion WorldBodies::motionBefore(const KnownFixture& fixture) const { return sweeps_.start(fixture.facts.bodyIndex); }

Vector2 WorldBodies::centreOfBody(const KnownFixture& fixture) const { return toVector(bodyOf(fixture).GetWorldCenter()); }

Vector2 WorldBodies::centreOfFixture(const KnownFixture& fixture) const {
    b2MassData mass;
    fixtureOf(fixture).GetMassData(&mass);
    return toVector(bodyOf(fixture).GetWorldPoint(mass.center));
}

double WorldBodies::inertia(const KnownFixture& fixture) const {
    const b2Body& body = bodyOf(fixture);
    return body.GetInertia() - body.GetMass() * body.GetLocalCenter().LengthSquared();
}

} // namespace physvib
