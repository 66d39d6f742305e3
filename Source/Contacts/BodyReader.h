// SPDX-License-Identifier: MIT
// What the stages ask of the physics engine, whichever it is.
#pragma once
#include "Contacts/Vector2.h"

namespace physvib {

struct KnownFixture;

/// Velocity of a body.
struct BodyMotion {
    Vector2 metresPerSecond;
    float radiansPerSecond = 0.0F; ///< counter-clockwise
};

/// Asked for few bodies, and only when something has happened to them, so nothing is copied for those at rest. Each
/// method: M, within a step or right after it, for a fixture that is in the world.
class BodyReader {
public:
    virtual ~BodyReader() = default;

    /// As it is now.
    virtual BodyMotion motion(const KnownFixture& fixture) const = 0;

    /// As it was when the step began.
    virtual BodyMotion motionBefore(const KnownFixture& fixture) const = 0;

    /// Centre of mass of the fixture's body, m, world.
    virtual Vector2 centreOfBody(const KnownFixture& fixture) const = 0;

    /// Centre of mass of the fixture alone, m, world.
    virtual Vector2 centreOfFixture(const KnownFixture& fixture) const = 0;

    /// Moment of inertia of the fixture's body about its centre of mass, kg m^2.
    virtual double inertia(const KnownFixture& fixture) const = 0;
};

} // namespace physvib
