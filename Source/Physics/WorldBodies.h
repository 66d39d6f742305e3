// SPDX-License-Identifier: MIT
// The bodies of a b2World, as Contacts asks for them.
#pragma once
#include "Contacts/BodyReader.h"
#include "Physics/BodySweeps.h"

namespace physvib {

/// Bodies are named by their addresses. M only, within a step or right after it.
class WorldBodies final : public BodyReader {
public:
    explicit WorldBodies(const BodySweeps& sweeps) noexcept
        : sweeps_(sweeps) {}

    BodyFacts facts(std::uint64_t body) const override;
    BodyMotion motion(std::uint64_t body) const override;
    BodyMotion motionBefore(std::uint64_t body) const override;
    Vector2 centre(std::uint64_t body) const override;
    Vector2 toWorld(std::uint64_t body, Vector2 ofBody) const override;
    double inertia(std::uint64_t body) const override;

private:
    const BodySweeps& sweeps_;
};

} // namespace physvib
