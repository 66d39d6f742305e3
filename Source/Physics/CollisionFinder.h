// SPDX-License-Identifier: MIT
// Finds collisions in a b2World from Box2D's contact callbacks (CollisionFinder): where, when and how fast
// surfaces meet, and the impulses between them. NewContactPoints finds which contact points are new.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Contacts/IndexMaps.h"
#include "Contacts/LastingContacts.h"
#include "Physics/WorldBodies.h"
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
class NewContactPoints {
public:
    NewContactPoints() { entries_.reserve(expectedContacts); }

    /// In PreSolve: true if all points are old, as is usual. Then update() need not be called.
    bool areOld(const b2Contact& contact, const b2Manifold& oldManifold) const noexcept {
        return isSame(oldManifold, *contact.GetManifold()) && !mayContain(contact);
    }

    /// In PreSolve: updates a contact and returns its new points, one bit each. Outside a reported step,
    /// whose end is not known, a point with an impulse is old at once.
    unsigned update(const b2Contact& contact, const b2Manifold& oldManifold, bool isStepping) {
        const b2Manifold& manifold = *contact.GetManifold();
        int index = find(contact);
        if (!isStepping && index >= 0 && entries_[static_cast<std::size_t>(index)].isSolved) {
            drop(static_cast<std::size_t>(index));
            index = -1;
        }
        if (index < 0 && isSame(oldManifold, manifold)) return 0U;
        // then all of its points are still new
        const bool isWaiting = index >= 0 && !entries_[static_cast<std::size_t>(index)].isSolved;
        for (int i = 0; i < manifold.pointCount; ++i) {
            const std::uint32_t id = manifold.points[i].id.key;
            if (!isWaiting && hasPoint(oldManifold, id)) continue;
            if (index < 0) {
                index = static_cast<int>(entries_.size());
                entries_.push_back({idOf(contact), {}, 0, false});
                indices_.set(idOf(contact), index);
                mayHaveNew_.add(idOf(contact));
            }
            Entry& entry = entries_[static_cast<std::size_t>(index)];
            if (!has(entry, id) && entry.count < static_cast<int>(entry.ids.size()))
                entry.ids[static_cast<std::size_t>(entry.count++)] = id;
        }
        return index < 0 ? 0U : maskOf(entries_[static_cast<std::size_t>(index)], manifold);
    }

    /// False: the contact has no new points. True: it may have some.
    bool mayContain(const b2Contact& contact) const noexcept {
        return !entries_.empty() && mayHaveNew_.mayContain(idOf(contact));
    }

    /// In PostSolve: marks the contact's new points as having an impulse, and returns them, one bit each.
    unsigned markSolved(const b2Contact& contact) noexcept {
        const int index = find(contact);
        if (index < 0) return 0U;
        entries_[static_cast<std::size_t>(index)].isSolved = true;
        return maskOf(entries_[static_cast<std::size_t>(index)], *contact.GetManifold());
    }

    /// In EndContact: drops the contact's new points.
    void forget(const b2Contact& contact) noexcept {
        if (const int index = find(contact); index >= 0) drop(static_cast<std::size_t>(index));
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
    static bool isSame(const b2Manifold& oldManifold, const b2Manifold& manifold) noexcept {
        if (oldManifold.pointCount < manifold.pointCount) return false;
        for (int i = 0; i < manifold.pointCount; ++i)
            if (oldManifold.points[i].id.key != manifold.points[i].id.key) return false;
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
        return mayContain(contact) ? indices_.find(idOf(contact)) : IntegerMap::none;
    }
    static bool has(const Entry& entry, std::uint32_t id) noexcept {
        for (int i = 0; i < entry.count; ++i) // few: a plain loop is shorter than std::find
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
        mayHaveNew_.remove(entries_[entry].contact);
        entries_[entry] = entries_.back();
        entries_.pop_back();
        if (entry < entries_.size()) indices_.set(entries_[entry].contact, static_cast<std::int32_t>(entry));
    }

    std::vector<Entry> entries_;
    IntegerMap indices_;        // small, to stay in the first-level cache
    CountingFilter mayHaveNew_; // excludes most contacts without new points
};

/// Converts Box2D's contact callbacks to the reports that CollisionRecorder needs. World thread (M).
class CollisionFinder {
public:
    CollisionFinder(ContactEvents& events, BodySweeps& sweeps)
        : events_(events)
        , sweeps_(sweeps) {
        growCache(expectedContacts);
    }

    /// The slot of a fixture, FixtureTable::none if it is not registered. A fixture that reuses the address
    /// of a destroyed one, on another body, counts as not registered.
    std::int32_t findSlot(const b2Fixture& fixture);

    /// Drops the cached fixtures of all contacts: contacts may have ended, or fixtures been destroyed,
    /// without a callback.
    void clearCache() noexcept;

    /// In BeginContact. `isPreSolveNext`: the next callback is this contact's PreSolve.
    void begin(const b2Contact& contact, bool isPreSolveNext);
    void end(const b2Contact& contact); ///< in EndContact
    /// In PreSolve, after the game's own listener, which may disable the contact.
    void onPreSolve(const b2Contact& contact, const b2Manifold& oldManifold) {
        if (!newPoints_.areOld(contact, oldManifold)) [[unlikely]]
            updateNewPoints(contact, oldManifold);
    }
    void onPostSolve(const b2Contact& contact, const b2ContactImpulse& impulse);

    void endStep() noexcept { newPoints_.endStep(); } ///< right after b2World::Step

private:
    static constexpr std::size_t expectedContacts = 128;

    using Pair = TouchingPairs::Handle;
    struct alignas(64) CachedContact {      // cached, to save a search for both fixtures in every step
        const b2Contact* contact = nullptr; // null: the place is free
        const b2Fixture *fixtureA = nullptr, *fixtureB = nullptr;
        Pair pair{};                 // its number is none until it is needed
        std::int32_t loadIndex = 0;  // of the pair's load, when last used
        std::uint64_t key = 0;       // of the pair
        std::uint64_t part = 0;      // hash of which parts of the two surfaces (segments of a chain) touch
        std::uint32_t nextIndex = 0; // index of the contact solved after this one in the last step
        bool matches(const b2Contact& other) const noexcept {
            return contact == &other && fixtureA == other.GetFixtureA() && fixtureB == other.GetFixtureB();
        }
    };
    CachedContact* findEntry(const b2Contact& contact) { // nullptr: one of the fixtures is not registered
        const std::int32_t index = cacheIndexOf_.find(idOf(contact));
        if (index == IntegerMap::none || !cachedContacts_[static_cast<std::size_t>(index)].matches(contact))
            [[unlikely]]
            return cacheRegistered(contact);
        return &cachedContacts_[static_cast<std::size_t>(index)];
    }
    [[gnu::noinline]] void updateNewPoints(const b2Contact& contact, const b2Manifold& oldManifold);
    void checkApproach(const b2Contact& contact, unsigned newMask, CachedContact* newEntry);
    [[gnu::noinline]] CachedContact* cacheRegistered(const b2Contact& contact);
    [[gnu::always_inline]] const Pair& numberedPair(CachedContact& entry) {
        CollisionRecorder& recorder = events_.recorder();
        if (!recorder.isKnown(entry.pair)) [[unlikely]]
            setNumber(entry.pair);
        return entry.pair;
    }
    [[gnu::noinline]] void setNumber(Pair& pair) {
        pair.number = events_.recorder().pairNumber(pair.a, pair.b);
    }
    void countBelowThreshold(const b2Contact& contact, double approachMetresPerSecond);
    std::int32_t registeredSlot(const b2Fixture& fixture);
    CachedContact& registeredEntry(const b2Contact& contact);
    CachedContact& cacheEntry(const b2Contact& contact, Pair pair);
    void dropEntry(const b2Contact& contact) noexcept;
    void growCache(std::size_t capacity);
    void describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned newMask,
                  Collision& collision) const;
    [[gnu::noinline]] void recordOutOfOrder(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::noinline]] void recordNew(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::noinline]] void recordUncached(const b2Contact& contact, const b2ContactImpulse& impulse);
    [[gnu::always_inline]] void recordCached(const b2Contact& contact, const b2ContactImpulse& impulse,
                                             CachedContact& entry);
    [[gnu::noinline]] void recordDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                       const CachedContact& entry, TransmittedImpulses::Contact& steady);
    [[gnu::noinline]] void record(const b2Contact& contact, const b2ContactImpulse& impulse,
                                  CachedContact& entry);
    [[gnu::noinline]] void reportPoints(const b2Contact& contact, const b2ContactImpulse& impulse,
                                        unsigned collisionMask, const CachedContact& entry);
    [[gnu::noinline]] void reportSteadyPoints(const b2Contact& contact, const b2ContactImpulse& impulse,
                                              const CachedContact& entry, const FaceTouch& touch);
    void reportDiscs(const b2Contact& contact, const b2ContactImpulse& impulse, const CachedContact& entry);
    void reportFace(const b2Contact& contact, const b2ContactImpulse& impulse, int i,
                    const CachedContact& entry, const FaceTouch& touch);
    double fractionOf(const b2Contact& contact) const noexcept;
    double touchFractionOf(const b2Contact& contact, double secondsAgo) const noexcept;

    ContactEvents& events_;
    BodySweeps& sweeps_;
    NewContactPoints newPoints_;
    std::vector<CachedContact> cachedContacts_; // contacts that touch, and free places
    std::vector<std::int32_t> freeIndices_;
    CachedContact* justBegun_ = nullptr;                // the contact that just began, until its PreSolve
    IntegerMap cacheIndexOf_{expectedContacts};         // by contact
    std::uint32_t solvedIndex_ = 0, expectedIndex_ = 0; // contacts solved last, and expected next
};

} // namespace physvib
