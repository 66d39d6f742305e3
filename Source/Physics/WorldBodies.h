// SPDX-License-Identifier: MIT
// The bodies of a b2World, as Contacts asks for them.
#pragma once
#include "Physics/BodySweeps.h"
#include "Physics/WorldNames.h"

namespace physvib {

/// Bodies are named by their addresses. M only, within a step or right after it.
class WorldBodies final : public BodyReader {
public:
    explicit WorldBodies(const BodySweeps& sweeps) noexcept
        : sweeps_(sweeps) {}

    BodyFacts facts(std::uint64_t body) const override { return factsOf(bodyOf(body)); }
    BodyMotion motion(std::uint64_t body) const override { return motionOf(bodyOf(body)); }
    BodyMotion motionBefore(std::uint64_t body) const override { return sweeps_.start(bodyOf(body)); }
    Vector2 centre(std::uint64_t body) const override { return toVector(bodyOf(body).GetWorldCenter()); }
    Vector2 toWorld(std::uint64_t body, Vector2 ofBody) const override { return toVector(bodyOf(body).GetWorldPoint({ofBody.x, ofBody.y})); }
    double inertia(std::uint64_t body) const override {
        const b2Body& of = bodyOf(body);
        return of.GetInertia() - of.GetMass() * of.GetLocalCenter().LengthSquared();
    }

private:
    const BodySweeps& sweeps_;
};

} // namespace physvib
