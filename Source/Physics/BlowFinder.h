// SPDX-License-Identifier: MIT
// Where, when and how fast the surfaces of a b2World meet, and what they push each other by: Box2D tells
// little of it.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Physics/BodySweeps.h"
#include "Physics/FreshPoints.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <vector>

namespace physvib {

/// Turns what Box2D says of its contacts into what the collision catcher wants to know. M only.
class BlowFinder {
public:
    BlowFinder(ContactEvents& events, BodySweeps& sweeps)
        : events_(events)
        , sweeps_(sweeps) {
        known_.reserve(expectedContacts);
    }

    /// The slot of a fixture, FixtureTable::none if it is not known. One that has taken the address of
    /// another, on another body, is not that one.
    std::int32_t find(const b2Fixture& fixture);

    /// Which fixtures contacts have is asked anew: some may have ended unheard, or their fixtures have gone.
    void forgetContacts() noexcept;

    void begin(const b2Contact& contact); ///< in BeginContact
    void end(const b2Contact& contact);   ///< in EndContact
    /// in PreSolve, after the game's own
    void look(const b2Contact& contact, const b2Manifold& before);
    void push(const b2Contact& contact, const b2ContactImpulse& impulse); ///< in PostSolve

    /// Right after b2World::Step.
    void endStep() noexcept { fresh_.endStep(); }

private:
    static constexpr std::size_t expectedContacts = 1024;

    using Pair = TouchingPairs::Name;
    struct Known { // spares a search for both fixtures in every step
        const b2Contact* contact;
        const b2Fixture *fixtureA, *fixtureB;
        Pair pair; // its number: none until it is asked for
    };
    Known* find(const b2Contact& contact);
    const Pair& pairOf(Known& known) {
        CollisionCatcher& catcher = events_.catcher();
        if (!catcher.isKnown(known.pair)) known.pair.number = catcher.know(known.pair.a, known.pair.b);
        return known.pair;
    }
    void passOver(const b2Contact& contact);
    std::int32_t know(const b2Fixture& fixture);
    Known& know(const b2Contact& contact);
    Known& remember(const b2Contact& contact, Pair pair);
    void forget(const b2Contact& contact) noexcept;
    void describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned fresh,
                  Blow& blow) const;
    void share(const b2ContactImpulse& impulse, const b2WorldManifold& manifold, const Pair& pair,
               unsigned fresh, Blow* blow, bool isHeard);
    double fractionOf(const b2Contact& contact) const noexcept;
    double momentOf(const b2Contact& contact, double secondsAgo) const noexcept;

    ContactEvents& events_;
    BodySweeps& sweeps_;
    FreshPoints fresh_;
    std::vector<Known> known_;             // that touch
    IntegerMap knownAt_{expectedContacts}; // by contact
};

} // namespace physvib
