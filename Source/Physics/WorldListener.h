// SPDX-License-Identifier: MIT
// Box2D's contact callbacks, handed to the collision catcher in its own words.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/FixtureTable.h"
#include "Physics/BodySweeps.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

/// Listens to one b2World, and hands every call on to the listener that was there before. Says when and where a
/// contact that begins was made, which Box2D does not. M only.
class WorldListener final : public b2ContactListener {
public:
    WorldListener(const FixtureTable& table, CollisionCatcher& catcher, BodySweeps& sweeps, b2ContactListener& chained) noexcept
        : table_(table)
        , catcher_(catcher)
        , sweeps_(sweeps)
        , chained_(chained) {}

    /// A contact of the time before: it is part of the graph, if it touches.
    void meet(const b2Contact& contact);

    b2ContactListener& chained() const noexcept { return chained_; }

    void BeginContact(b2Contact* contact) override;
    void EndContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* oldManifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

private:
    void describe(const b2Contact& contact, ContactRecord& record) const noexcept;
    double fractionOf(std::int32_t a, std::int32_t b) const noexcept;
    void push(const b2Contact& contact, const b2ContactImpulse& impulse, std::int32_t a, std::int32_t b);

    const FixtureTable& table_;
    CollisionCatcher& catcher_;
    BodySweeps& sweeps_;
    b2ContactListener& chained_;
};

} // namespace physvib
