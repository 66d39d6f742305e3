// SPDX-License-Identifier: MIT
// The bodies of a b2World, as Contacts asks for them.
#pragma once
#include "Contacts/BodyReader.h"
#include "Physics/BodySweeps.h"

namespace physvib {

/// M only, within a step or right after it.
class WorldBodies final : public BodyReader {
public:
    explicit WorldBodies(const BodySweeps& sweeps) noexcept
        : sweeps_(sweeps) {}

    BodyMotion motion(const KnownFixture& fixture) const override;
    BodyMotion motionBefore(const KnownFixture& fixture) const override;
    Vector2 centreOfBody(const KnownFixture& fixture) const override;
    Vector2 centreOfFixture(const KnownFixture& fixture) const override;
    double inertia(const KnownFixture& fixture) const override;

private:
    const BodySweeps& sweeps_;
};

} // namespace physvib
