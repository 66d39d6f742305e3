// SPDX-License-Identifier: MIT
// Collisions of a step (CollisionRecorder, thesis 5.1.3), and impulses that contacts transmit
// (TransmittedImpulses).
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/Vectors.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Watches the existing contacts of haptic sources for impacts that neighbours transmit. Resting bodies push
/// too, equally in every step: that is a contact's load, the smallest of its impulses in the last three steps
/// (an impact, which may take two, is no load). The excess over the load is a transmitted impact; an impulse
/// below it is none. Impulses at one body are summed as vectors; the spin of Eq. 5.2 is not added, because
/// the sum is already the whole impulse. Allocates when the world grows. World thread (M).
class TransmittedImpulses {
public:
    /// Place of a contact, stored as the engine reports it, because most places are never read.
    struct Place {
        FaceTouch face;
        Vector3 world;
        bool isOfFace = false;

        FaceTouch& setFace() noexcept { // to be filled in
            isOfFace = true;
            return face;
        }
        void set(Vector3 point) noexcept {
            world = point;
            isOfFace = false;
        }
        Vector3 point() const noexcept { return isOfFace ? Vector3(face.point()) : world; }
    };
    struct Transmitted {
        Vector3 newtonSeconds;
        float strongest = 0.0F;                  ///< N s, of the part that came through `other`
        std::int32_t other = FixtureTable::none; ///< slot of the neighbour that transmitted most
        std::size_t contact = 0;                 ///< index of the contact with that neighbour, see pointOf()
    };

    TransmittedImpulses(const FixtureTable& table, TouchingPairs& pairs);

    struct Contact {
        TouchingPairs::Handle pair;
        std::uint32_t step = 0, newest = 0; // step: number of the last one in which it pushed; 0: none
        // Impulses on b, N s, of that step (at `newest`) and the three before: a ring per axis
        std::array<float, 4> x{}, y{}, z{};
        Place place{};
        bool isUnknown = false; // first seen in mid-contact: its load is its first impulse
        bool isSteady = false;  // its load is known, and the pair did not collide in the last step
        Vector3 impulse(unsigned i) const noexcept { return {x[i], y[i], z[i]}; }
        std::array<float, 4> squares() const noexcept; ///< of their magnitudes
        void set(Vector3 push) noexcept { x[newest] = push.x, y[newest] = push.y, z[newest] = push.z; }
    };

    /// Within a step: an existing contact of (a, b) has pushed b by `newtonSeconds` (world), and a by the
    /// opposite.
    Place& add(const TouchingPairs::Handle& pair, std::int32_t load, Vector3 newtonSeconds);
    /// The faster path for an entry that findSteady() has returned.
    [[gnu::always_inline]] Place& push(Contact& contact, Vector3 newtonSeconds) noexcept {
        // Summed over the step's points and solver passes, and over the segments of a chain.
        if (contact.step == step_) [[unlikely]] {
            newtonSeconds = contact.impulse(contact.newest) + newtonSeconds;
        } else {
            contact.newest = (contact.newest + 1) % 4;
            contact.step = step_;
        }
        contact.set(newtonSeconds);
        return contact.place;
    }
    /// The entry at `load` if it is this pair's and steady (see Contact); else null.
    Contact* findSteady(const TouchingPairs::Handle& pair, std::int32_t load) noexcept {
        Contact* const contact = contacts_.data() + load;
        if (contact >= contacts_.data() + contacts_.size()) return nullptr;
        return contact->pair.a == pair.a && contact->pair.b == pair.b && contact->isSteady ? contact
                                                                                           : nullptr;
    }
    /// Call when the pair's `lastIndex` has changed.
    void updateLast(std::int32_t pair) noexcept {
        if (pairs_[pair].loadIndex != TouchingPairs::none)
            updateSteady(contacts_.data()[pairs_[pair].loadIndex]);
    }

    /// After a step: sums up the transmitted impulses.
    void endReports();

    /// Haptic sources that received an impulse through existing contacts in this step. After endReports().
    const std::vector<std::int32_t>& receivers() const noexcept { return receivers_; }

    /// The impulse that a haptic source received through existing contacts in this step. After endReports().
    const Transmitted& transmittedTo(std::int32_t slot) const noexcept {
        static constexpr Transmitted nothing{};
        const auto index = static_cast<std::size_t>(slot);
        const bool isReceiver =
            index < transmitted_.size() && transmitted_[index].other != FixtureTable::none;
        return isReceiver ? transmitted_[index] : nothing;
    }
    /// transmittedTo() for a slot in receivers(), without checks.
    const Transmitted& transmittedToReceiver(std::int32_t receiver) const noexcept {
        return transmitted_[static_cast<std::size_t>(receiver)];
    }
    /// World place of the contact that transmitted most of `received`, m; 0 if nothing was transmitted.
    Vector3 pointOf(const Transmitted& received) const noexcept {
        return received.other == FixtureTable::none ? Vector3{} : contacts_[received.contact].place.point();
    }

    /// A contact begins: its load is 0.
    void begin(const TouchingPairs::Handle& pair) {
        if (pairs_[pair.number].loadIndex == TouchingPairs::none) addContact(pair, false);
    }

    /// Ends the step: its impulses become history. Sleeping bodies keep their load.
    void endStep();

    /// The slot is freed or reassigned: drops its contacts.
    void forget(std::int32_t slot) noexcept;

private:
    Contact& addContact(const TouchingPairs::Handle& pair, bool isUnknown);
    void updateSteady(Contact& contact) const noexcept {
        contact.isSteady = !contact.isUnknown && pairs_[contact.pair.number].lastIndex == TouchingPairs::none;
    }
    [[gnu::always_inline]] void addReceived(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds,
                                            float magnitude, std::size_t contact);
    void drop(std::size_t index) noexcept;

    const FixtureTable& table_;
    TouchingPairs& pairs_; // stores the index of each pair's load
    std::vector<Contact> contacts_;
    std::vector<Transmitted> transmitted_; // by slot
    std::vector<std::int32_t> receivers_, endedLoads_;
    std::uint32_t step_ = 1; // the step's number, never 0
};

/// Updates the contact graph and records the collisions of each step (`Collision`). A collision needs parts
/// of two surfaces that were apart and that approach each other faster than a resting body does; its impulse
/// is what these parts push. All other impulses are loads: bodies that rest, lean, roll over a seam, or are
/// created at rest. A pair of fixtures has at most one collision per step, however many contacts and points
/// it has. Fixtures are given by their slots in the table. World thread (M).
class CollisionRecorder {
public:
    /// Maximum collisions of one step: those of haptic sources, and others, which may be transmitted to them.
    /// A world with more is noise to the touch.
    static constexpr std::size_t maxDirectCollisions = 1024;
    static constexpr std::size_t maxDistantCollisions = 4096;
    /// Memory is reserved for this many before the first step; lists that have grown keep theirs.
    static constexpr std::size_t expectedCollisions = 24;

    CollisionRecorder(const FixtureTable& table, ContactGraph& graph);

    /// Call right before the engine's step.
    void beginStep(const StepSpan& span) noexcept;

    /// Call right after the engine's step, when all contacts have been reported.
    void endReports();

    /// Call when the step's records have been used.
    void endStep();

    /// The slot is freed or reassigned: drops its records.
    void forget(std::int32_t slot) noexcept;

    bool isStepping() const noexcept { return isStepping_; }

    /// True if a collision, or a push at a haptic source, was reported in this step.
    bool hasReports() const noexcept { return hasReports_; }

    /// A contact of two solid fixtures begins; a pair may have several (the segments of a chain).
    std::int32_t begin(std::int32_t a, std::int32_t b);

    /// A contact ends. Fill in the returned record with time and motions. nullptr: no room, and the contact
    /// is treated as if it had not ended.
    ContactEnd* end(std::int32_t a, std::int32_t b) { return end({a, b, pairs_.find(a, b)}); }
    ContactEnd* end(const TouchingPairs::Handle& pair); ///< the pair's number may be none

    /// A contact has ended outside a step.
    void endOutsideStep(std::int32_t a, std::int32_t b) { graph_.erase(a, b); }

    /// Counts a new contact point of two fixtures that the engine distinguishes from the pair's other points.
    void countContact(std::int32_t a, std::int32_t b) noexcept {
        ++tally_.contacts;
        tally_.withoutSource += touchesSource(a, b) ? 0 : 1;
    }
    /// Counts a contact of a haptic source that was too slow for a collision. It would have been one with a
    /// threshold of `metresPerSecond`.
    void countBelowThreshold(std::int32_t a, std::int32_t b, double metresPerSecond) noexcept;

    /// Counts since the owner last cleared them.
    ContactCounts& tally() noexcept { return tally_; }
    const ContactCounts& tally() const noexcept { return tally_; }

    /// The number of a pair of known fixtures, for the next methods. It may be kept: see TouchingPairs.
    std::int32_t pairNumber(std::int32_t a, std::int32_t b) { return pairs_.findOrAdd(a, b); }
    bool isKnown(const TouchingPairs::Handle& pair) const noexcept { return pairs_.matches(pair); }
    TouchingPairs::Pair& operator[](const TouchingPairs::Handle& pair) noexcept {
        return pairs_[pair.number];
    }

    /// True if parts that approach each other at this speed, before the solver, collide; `gravityScale`: the
    /// larger one of the two bodies.
    bool isCollision(float gravityScale, double approachMetresPerSecond) const noexcept {
        return approachMetresPerSecond >= span_.minApproachMetresPerSecond(gravityScale);
    }

    /// `findCollision` returns a pair's collision in this step, if there is one. `addCollision` creates it,
    /// with fixtures, mass and order set; the caller fills in the rest. When full, the weakest by mass and
    /// approach is dropped and counted; nullptr if that is the new one.
    Collision* addCollision(const TouchingPairs::Handle& pair, double approachMetresPerSecond);
    Collision* findCollision(const TouchingPairs::Handle& pair) noexcept {
        const std::int32_t index = pairs_[pair.number].collisionIndex;
        return index == TouchingPairs::none ? nullptr : &collisions_[static_cast<std::size_t>(index)];
    }

    /// False: the world has no haptic source, so nothing has to be reported. A source that is added later
    /// takes part from the next step on.
    bool hasSources() const noexcept { return table_.hasSources(); }

    /// True if at least one of the two is a haptic source.
    bool touchesSource(std::int32_t a, std::int32_t b) const noexcept {
        return ((table_.traits(a) | table_.traits(b)) & FixtureTable::source) != 0;
    }

    /// True if pushes of the pair matter: one of them is a haptic source, or it collided in the last step.
    bool isRelevant(const TouchingPairs::Handle& pair) const noexcept {
        return touchesSource(pair.a, pair.b) || pairs_[pair.number].lastIndex != TouchingPairs::none;
    }

    /// isRelevant() by the engine's numbers of two fixtures. False is certain, and avoids the search for the
    /// pair of most contacts in a world with few haptic sources.
    bool mayBeRelevant(std::uint64_t a, std::uint64_t b) const noexcept {
        return table_.mayBeSource(a) || table_.mayBeSource(b) ||
               (struckFilter_.mayContain(a) && struckFilter_.mayContain(b));
    }

    /// Adds the impulse, N s in the world, by which parts that do not collide have pushed b, and a by the
    /// opposite.
    void push(const TouchingPairs::Handle& pair, Vector3 newtonSeconds, Vector3 point) {
        const bool hasSource = touchesSource(pair.a, pair.b);
        if (TransmittedImpulses::Place* const place =
                push(pair, pairs_[pair.number], hasSource, newtonSeconds))
            place->set(point);
    }
    /// push() for a caller that has the stored pair and knows whether it touches a source. Returns the
    /// place, which the caller sets, or null.
    TransmittedImpulses::Place* push(const TouchingPairs::Handle& pair, const TouchingPairs::Pair& stored,
                                     bool hasSource, Vector3 newtonSeconds) {
        hasReports_ = true;
        if (stored.lastIndex != TouchingPairs::none) [[unlikely]]
            aftermaths_[static_cast<std::size_t>(stored.lastIndex)].newtonSeconds +=
                pair.a < pair.b ? newtonSeconds : -newtonSeconds;
        return hasSource ? &impulses_.add(pair, stored.loadIndex, newtonSeconds) : nullptr;
    }
    /// The faster path for an entry that impulses().findSteady() has returned.
    TransmittedImpulses::Place& push(TransmittedImpulses::Contact& steady, Vector3 newtonSeconds) {
        hasReports_ = true;
        return impulses_.push(steady, newtonSeconds);
    }

    const std::vector<Collision>& collisions() const noexcept { return collisions_; }
    /// Impulse in N s that a pair which collided in the last step has added in this one: engines spread an
    /// impact over two steps.
    double aftermathNewtonSeconds(std::int32_t pair) const noexcept;
    /// Contacts that ended in this step or since the last one.
    const std::vector<ContactEnd>& ends() const noexcept { return ends_; }
    /// True if the fixture collided in the last step.
    bool collidedInLastStep(std::int32_t slot) const noexcept;
    const TransmittedImpulses& impulses() const noexcept { return impulses_; }
    TransmittedImpulses& impulses() noexcept { return impulses_; }

    /// Collisions dropped so far because the arrays were full.
    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Aftermath { // impulse in this step of a pair that collided in the last one
        std::int32_t pair;
        Vector3 newtonSeconds;
    };
    Collision* findWeakest(bool isDirect) noexcept;

    const FixtureTable& table_;
    ContactGraph& graph_;
    TouchingPairs& pairs_; // the graph's
    TransmittedImpulses impulses_{table_, pairs_};
    StepSpan span_;
    std::vector<Collision> collisions_; // of this step
    std::vector<ContactEnd> ends_;
    std::vector<Aftermath> aftermaths_;
    std::vector<std::uint64_t> struckIds_; // engine's numbers of the fixtures that collided in the last step
    CountingFilter struckFilter_;
    std::size_t directCollisions_ = 0;
    std::int32_t order_ = 0;
    bool isStepping_ = false, hasReports_ = false;
    std::uint64_t drops_ = 0;
    ContactCounts tally_;
};

} // namespace physvib
