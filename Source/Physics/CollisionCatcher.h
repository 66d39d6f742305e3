// SPDX-License-Identifier: MIT
// The thesis' collision catcher (5.1.3): copies what Box2D tells during a step into fixed arrays.
#pragma once
#include "Physics/BodySweeps.h"
#include "Physics/ChainLoads.h"
#include "Physics/ContactGraph.h"
#include "Physics/FixtureTable.h"
#include "Physics/Impact.h"
#include "Physics/IntegerMap.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Listens to one b2World, and hands every call on to the listener that was there before. Keeps the contact
/// graph up to date, and notes for each step which solid contacts began, with the solver's impulses of that
/// same step; PostSolve also reports resting contacts, in every step, which therefore are no strikes but
/// loads. M only.
class CollisionCatcher final : public b2ContactListener {
public:
    /// Contacts that may begin in one step: those of cameras, and others, which may be handed on to cameras.
    /// A world that has more of them is a noise, not a touch.
    static constexpr std::size_t maxDirectRecords = 1024;
    static constexpr std::size_t maxDistantRecords = 4096;

    CollisionCatcher(const FixtureTable& table, ContactGraph& graph, b2ContactListener& chained);

    /// A contact of the time before the catcher: it is part of the graph, if it touches.
    void meet(const b2Contact& contact);

    /// Right before b2World::Step, with the time it is given; the table is up to date.
    void beginStep(const b2World& world, double stepSeconds);

    /// Right after it: what was noted is complete.
    void settle() noexcept;

    /// When all that was noted has been used.
    void endStep();

    /// The slot has another owner from now on: drops what was noted of it.
    void forget(std::int32_t slot) noexcept;

    const std::vector<ContactRecord>& records() const noexcept { return records_; }
    /// Contacts that ended in the step or since the one before it.
    const std::vector<ContactEnd>& ends() const noexcept { return ends_; }
    const ChainLoads& loads() const noexcept { return loads_; }
    const BodySweeps& sweeps() const noexcept { return sweeps_; }
    b2ContactListener& chained() const noexcept { return chained_; }

    /// Contacts that found no room so far.
    std::uint64_t drops() const noexcept { return drops_; }

    void BeginContact(b2Contact* contact) override;
    void EndContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* oldManifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

private:
    struct Ends {
        std::int32_t a, b;
        bool areKnown() const noexcept { return a != FixtureTable::none && b != FixtureTable::none; }
    };
    Ends slotsOf(const b2Contact& contact) const noexcept;
    bool isFelt(Ends ends) const noexcept;
    void note(const b2Contact& contact, Ends ends);
    ContactRecord describe(const b2Contact& contact, Ends ends) const noexcept;
    double fractionOf(Ends ends) const noexcept;
    void load(const b2Contact& contact, const b2ContactImpulse& impulse, Ends ends) noexcept;

    const FixtureTable& table_;
    ContactGraph& graph_;
    b2ContactListener& chained_;
    BodySweeps sweeps_;
    ChainLoads loads_;
    std::vector<ContactRecord> records_; // of the present step
    std::vector<ContactEnd> ends_;
    IntegerMap recordOf_{256}; // by the address of the contact; small, to stay in the nearest cache
    std::size_t directRecords_ = 0;
    std::int32_t order_ = 0;
    double stepSeconds_ = 0.0;
    bool isStepping_ = false;
    std::uint64_t drops_ = 0;
};

} // namespace physvib
