// SPDX-License-Identifier: MIT
// Finds collisions in a b2World from Box2D's contact callbacks: where, when and how fast surfaces meet, and
// the impulses between them.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Contacts/IndexMaps.h"
#include "Contacts/LastingContacts.h"
#include "Physics/WorldBodies.h"
#include <algorithm>
#include <array>
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Detects which points of Box2D's contacts are new: where surfaces that were apart have met. A point is new
/// from when Box2D finds it until the end of the step in which the solver has applied an impulse there. That
/// may be a later step, for a disabled contact (a one-way platform) or a contact found in a step of length 0.
/// A point whose id Box2D's manifold keeps is old. Contacts are identified by their addresses. World thread
/// (M).
class FreshPoints {
public:
    FreshPoints() { entries_.reserve(expectedContacts); }

    /// In PreSolve: true if all points are old, which is usual, and nothing has to be noted.
    bool areOld(const b2Contact& contact, const b2Manifold& before) const noexcept {
        return isSame(before, *contact.GetManifold()) && !mayHave(contact);
    }

    /// Otherwise: updates a contact and returns its new points, one bit each. Outside a reported step, whose
    /// end is not known, a point with an impulse is old at once.
    unsigned look(const b2Contact& contact, const b2Manifold& before, bool isStepping) {
        const b2Manifold& now = *contact.GetManifold();
        int known = find(contact);
        if (!isStepping && known >= 0 && entries_[static_cast<std::size_t>(known)].isSolved) {
            drop(static_cast<std::size_t>(known));
            known = -1;
        }
        if (known < 0 && isSame(before, now)) return 0U;
        // then all of its points are still new
        const bool isWaiting = known >= 0 && !entries_[static_cast<std::size_t>(known)].isSolved;
        for (int i = 0; i < now.pointCount; ++i) {
            const std::uint32_t id = now.points[i].id.key;
            if (!isWaiting && hasPoint(before, id)) continue;
            if (known < 0) {
                known = static_cast<int>(entries_.size());
                entries_.push_back({idOf(contact), {}, 0, false});
                indices_.set(idOf(contact), known);
                names_.add(idOf(contact));
            }
            Entry& entry = entries_[static_cast<std::size_t>(known)];
            if (!has(entry, id) && entry.count < static_cast<int>(entry.ids.size()))
                entry.ids[static_cast<std::size_t>(entry.count++)] = id;
        }
        return known < 0 ? 0U : maskOf(entries_[static_cast<std::size_t>(known)], now);
    }

    /// False is certain: the contact has no new points.
    bool mayHave(const b2Contact& contact) const noexcept {
        return !entries_.empty() && names_.mayHave(idOf(contact));
    }

    /// In PostSolve: the same; marks the points as having an impulse.
    unsigned solved(const b2Contact& contact) noexcept {
        const int known = find(contact);
        if (known < 0) return 0U;
        entries_[static_cast<std::size_t>(known)].isSolved = true;
        return maskOf(entries_[static_cast<std::size_t>(known)], *contact.GetManifold());
    }

    /// In EndContact.
    void forget(const b2Contact& contact) noexcept {
        if (const int known = find(contact); known >= 0) drop(static_cast<std::size_t>(known));
    }

    /// Call right after the step: points with an impulse become old.
    void endStep() noexcept {
        for (std::size_t i = entries_.size(); i-- > 0;)
            if (entries_[i].isSolved) drop(i);
    }

private:
    static bool hasPoint(const b2Manifold& manifold, std::uint32_t id) noexcept {
        for (int i = 0; i < manifold.pointCount; ++i)
            if (manifold.points[i].id.key == id) return true;
        return false;
    }
    /// True if both have the same points in the same order.
    static bool isSame(const b2Manifold& before, const b2Manifold& now) noexcept {
        if (before.pointCount < now.pointCount) return false;
        for (int i = 0; i < now.pointCount; ++i)
            if (before.points[i].id.key != now.points[i].id.key) return false;
        return true;
    }

    static constexpr std::size_t expectedContacts = 128; // contacts that begin in a step, or are disabled

    struct Entry {
        std::uint64_t contact;
        std::array<std::uint32_t, 2 * b2_maxManifoldPoints> ids; // of all solver passes of a step
        int count;
        bool isSolved;
    };
    int find(const b2Contact& contact) const noexcept {
        return mayHave(contact) ? indices_.find(idOf(contact)) : IntegerMap::none;
    }
    static bool has(const Entry& entry, std::uint32_t id) noexcept {
        for (int i = 0; i < entry.count; ++i) // a few: shorter than what std::find unrolls
            if (entry.ids.data()[i] == id) return true;
        return false;
    }
    static unsigned maskOf(const Entry& entry, const b2Manifold& manifold) noexcept {
        unsigned mask = 0;
        for (int i = 0; i < manifold.pointCount; ++i)
            mask |= has(entry, manifold.points[i].id.key) ? 1U << i : 0U;
        return mask;
    }
    void drop(std::size_t entry) noexcept {
        indices_.erase(entries_[entry].contact);
        names_.remove(entries_[entry].contact);
        entries_[entry] = entries_.back();
        entries_.pop_back();
        if (entry < entries_.size()) indices_.set(entries_[entry].contact, static_cast<std::int32_t>(entry));
    }

    std::vector<Entry> entries_;
    IntegerMap indices_; // small, to stay in the first-level cache
    NameSketch names_;   // tells of most contacts that they have no new point
};

/// Converts Box2D's contact callbacks to the reports that CollisionCatcher needs. World thread (M).
class CollisionFinder {
public:
    CollisionFinder(ContactEvents& events, BodySweeps& sweeps)
        : events_(events)
        , sweeps_(sweeps) {
        addPlaces(expectedContacts);
    }

    /// The slot of a fixture, FixtureTable::none if it is not registered. A fixture that reuses the address
    /// of a destroyed one, on another body, counts as not registered.
    std::int32_t find(const b2Fixture& fixture);

    /// Drops the cached fixtures of all contacts: contacts may have ended, or fixtures been destroyed,
    /// without a callback.
    void forgetContacts() noexcept;

    /// In BeginContact. `isFollowed`: what comes next is the same contact's PreSolve, and nothing between.
    void begin(const b2Contact& contact, bool isFollowed);
    void end(const b2Contact& contact); ///< in EndContact
    /// To be called after the game's own listener.
    void onPreSolve(const b2Contact& contact, const b2Manifold& before) {
        if (!fresh_.areOld(contact, before)) [[unlikely]]
            look(contact, before);
    }
    void onPostSolve(const b2Contact& contact, const b2ContactImpulse& impulse);

    /// Right after b2World::Step.
    void endStep() noexcept { fresh_.endStep(); }

private:
    static constexpr std::size_t expectedContacts = 128;

    using Pair = TouchingPairs::Name;
    struct alignas(64) Known {              // cache, which saves a search for both fixtures in every step
        const b2Contact* contact = nullptr; // null: of none
        const b2Fixture *fixtureA = nullptr, *fixtureB = nullptr;
        Pair pair{};             // its number: none until it is needed
        std::int32_t load = 0;   // of the pair, where it last was
        std::uint64_t key = 0;   // of the pair
        std::uint64_t part = 0;  // hash of which parts of the two surfaces (segments of a chain) touch
        std::uint32_t after = 0; // index of the one that was solved after this one, in the last step
        bool isOf(const b2Contact& of) const noexcept {
            return contact == &of && fixtureA == of.GetFixtureA() && fixtureB == of.GetFixtureB();
        }
    };
    Known* find(const b2Contact& contact) { // nullptr: one of the fixtures is not registered
        const std::int32_t at = knownAt_.find(idOf(contact));
        if (at == IntegerMap::none || !known_[static_cast<std::size_t>(at)].isOf(contact)) [[unlikely]]
            return search(contact);
        return &known_[static_cast<std::size_t>(at)];
    }
    [[gnu::noinline]] void look(const b2Contact& contact, const b2Manifold& before);
    void meet(const b2Contact& contact, unsigned fresh, Known* begun);
    [[gnu::noinline]] Known* search(const b2Contact& contact);
    [[gnu::always_inline]] const Pair& pairOf(Known& known) {
        CollisionCatcher& catcher = events_.catcher();
        if (!catcher.isKnown(known.pair)) [[unlikely]]
            know(known.pair);
        return known.pair;
    }
    [[gnu::noinline]] void know(Pair& pair) { pair.number = events_.catcher().know(pair.a, pair.b); }
    void passOver(const b2Contact& contact, double approachMetresPerSecond);
    std::int32_t know(const b2Fixture& fixture);
    Known& know(const b2Contact& contact);
    Known& remember(const b2Contact& contact, Pair pair);
    void forget(const b2Contact& contact) noexcept;
    void addPlaces(std::size_t all);
    void describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned fresh,
                  Collision& collision) const;
    [[gnu::noinline]] void solveOutOfTurn(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::noinline]] void solveNew(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::noinline]] void solveUnknown(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::always_inline]] void solveKnown(const b2Contact& contact, const b2ContactImpulse& impulse,
                                           Known& known);
    [[gnu::noinline]] void solveDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                      const Known& known, ChainLoads::Contact& usual);
    [[gnu::noinline]] void solve(const b2Contact& contact, const b2ContactImpulse& impulse, Known& known);
    [[gnu::noinline]] void tell(const b2Contact& contact, const b2ContactImpulse& impulse,
                                unsigned collisions, const Known& known);
    [[gnu::noinline]] void tellUsual(const b2Contact& contact, const b2ContactImpulse& impulse,
                                     const Known& known, const FaceTouch& touch);
    void tellDiscs(const b2Contact& contact, const b2ContactImpulse& impulse, const Known& known);
    void tellFace(const b2Contact& contact, const b2ContactImpulse& impulse, int i, const Known& known,
                  const FaceTouch& touch);
    double fractionOf(const b2Contact& contact) const noexcept;
    double momentOf(const b2Contact& contact, double secondsAgo) const noexcept;

    ContactEvents& events_;
    BodySweeps& sweeps_;
    FreshPoints fresh_;
    std::vector<Known> known_; // contacts that touch, and free places
    std::vector<std::int32_t> free_;
    Known* begun_ = nullptr;               // the one that just began, until its PreSolve
    IntegerMap knownAt_{expectedContacts}; // by contact
    std::uint32_t last_ = 0, next_ = 0;    // indices of the one that was solved last, and of its successor
};

} // namespace physvib
