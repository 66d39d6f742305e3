// SPDX-License-Identifier: MIT
// Implements BodyReader for a b2World.
#pragma once
#include "Contacts/IntegerMap.h"
#include "Physics/BodySweeps.h"
#include "Physics/WorldNames.h"
#include <array>
#include <cstdint>

namespace physvib {

/// Bodies are identified by their addresses. Box2D has no callback for a body whose fixtures were destroyed
/// before it, so a stored address may be invalid; it is looked up in the world's list before it is
/// dereferenced. A destroyed body is reported as static, without mass, disabled, at the origin. World thread
/// (M) only, within a step or right after it.
class WorldBodies final : public BodyReader {
public:
    WorldBodies(const b2World& world, const BodySweeps& sweeps) noexcept
        : world_(world)
        , sweeps_(sweeps) {}

    /// The world's owner may have destroyed bodies since, except the two given. The next access to another
    /// one costs one pass over the world's list.
    void invalidate(const b2Body* one = nullptr, const b2Body* other = nullptr) noexcept {
        isCertain_ = false;
        present_ = {one, other};
    }
    bool has(std::uint64_t body) const {
        if (!isCertain_) {
            for (const b2Body* const present : present_)
                if (present != nullptr && idOf(*present) == body) return true;
            look();
        }
        return bodies_.find(body) != IntegerMap::none;
    }

    BodyFacts facts(std::uint64_t body) const override {
        return has(body) ? factsOf(bodyOf(body)) : BodyFacts{body, 0.0, 1.0F, false, false};
    }
    BodyMotion motion(std::uint64_t body) const override {
        return has(body) ? motionOf(bodyOf(body)) : BodyMotion{};
    }
    BodyMotion motionBefore(std::uint64_t body) const override {
        return has(body) ? sweeps_.start(bodyOf(body)) : BodyMotion{};
    }
    Vector2 centre(std::uint64_t body) const override {
        return has(body) ? toVector(bodyOf(body).GetWorldCenter()) : Vector2{};
    }
    Vector3 toWorld(std::uint64_t body, Vector2 ofBody) const override {
        return has(body) ? Vector3(toVector(bodyOf(body).GetWorldPoint({ofBody.x, ofBody.y}))) : ofBody;
    }
    double inertia(std::uint64_t body) const override {
        if (!has(body)) return 0.0;
        const b2Body& of = bodyOf(body);
        return of.GetInertia() - of.GetMass() * of.GetLocalCenter().LengthSquared();
    }

private:
    // If the list has the same addresses in the same order, the index is still valid, even if a body was
    // replaced by another at its address.
    void look() const {
        isCertain_ = true;
        const std::uint64_t census = BodySweeps::censusOf(world_);
        if (census == census_) return;
        census_ = census;
        bodies_.clear();
        for (const b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext())
            bodies_.set(idOf(*body), 0);
    }

    const b2World& world_;
    const BodySweeps& sweeps_;
    std::array<const b2Body*, 2> present_{};
    mutable bool isCertain_ = false;
    mutable std::uint64_t census_ = 0; // hash of the list that was indexed
    mutable IntegerMap bodies_;        // bodies that exist
};

} // namespace physvib
