// SPDX-License-Identifier: MIT
// Finds collisions in a b2World from Box2D's contact callbacks: where, when and how fast surfaces meet, and
// the impulses between them.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Physics/BodySweeps.h"
#include "Physics/FreshPoints.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <vector>

namespace physvib {

/// Converts Box2D's contact callbacks to the reports that CollisionCatcher needs. World thread (M) only.
class CollisionFinder {
public:
    CollisionFinder(ContactEvents& events, BodySweeps& sweeps)
        : events_(events)
        , sweeps_(sweeps) {
        known_.reserve(expectedContacts);
    }

    /// The slot of a fixture, FixtureTable::none if it is not registered. A fixture that reuses the address
    /// of a destroyed one, on another body, counts as not registered.
    std::int32_t find(const b2Fixture& fixture);

    /// Drops the cached fixtures of all contacts: contacts may have ended, or fixtures been destroyed,
    /// without a callback.
    void forgetContacts() noexcept;

    void begin(const b2Contact& contact); ///< in BeginContact
    void end(const b2Contact& contact);   ///< in EndContact
    /// After the game's own listener
    void onPreSolve(const b2Contact& contact, const b2Manifold& before);
    void onPostSolve(const b2Contact& contact, const b2ContactImpulse& impulse);

    /// Right after b2World::Step.
    void endStep() noexcept { fresh_.endStep(); }

private:
    static constexpr std::size_t expectedContacts = 128;

    using Pair = TouchingPairs::Name;
    struct Known { // cache, which saves a search for both fixtures in every step
        const b2Contact* contact;
        const b2Fixture *fixtureA, *fixtureB;
        Pair pair; // its number: none until it is needed
    };
    Known* find(const b2Contact& contact);
    const Pair& pairOf(Known& known) {
        CollisionCatcher& catcher = events_.catcher();
        if (!catcher.isKnown(known.pair)) known.pair.number = catcher.know(known.pair.a, known.pair.b);
        return known.pair;
    }
    void passOver(const b2Contact& contact, double approachMetresPerSecond);
    std::int32_t know(const b2Fixture& fixture);
    Known& know(const b2Contact& contact);
    Known& remember(const b2Contact& contact, Pair pair);
    void forget(const b2Contact& contact) noexcept;
    void describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned fresh,
                  Collision& collision) const;
    void share(const b2ContactImpulse& impulse, const b2WorldManifold& manifold, const Pair& pair,
               unsigned fresh, Collision* collision, bool isRelevant);
    double fractionOf(const b2Contact& contact) const noexcept;
    double momentOf(const b2Contact& contact, double secondsAgo) const noexcept;

    ContactEvents& events_;
    BodySweeps& sweeps_;
    FreshPoints fresh_;
    std::vector<Known> known_;             // contacts that touch
    IntegerMap knownAt_{expectedContacts}; // by contact
};

} // namespace physvib
