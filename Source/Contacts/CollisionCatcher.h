// SPDX-License-Identifier: MIT
// Collisions of a step (CollisionCatcher, thesis 5.1.3), and impulses that contacts transmit (ChainLoads).
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
class ChainLoads {
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
    struct Passed {
        Vector3 newtonSeconds;
        float strongest = 0.0F;                  ///< magnitude of the part that came through `other`
        std::int32_t other = FixtureTable::none; ///< slot of the neighbour that transmitted most
        std::size_t contact = 0;                 ///< with that neighbour, see pointOf()
    };

    ChainLoads(const FixtureTable& table, TouchingPairs& pairs);

    struct Contact {
        TouchingPairs::Name of;
        std::uint32_t step = 0, newest = 0; // step: the number of the last one that pushed; 0: none has
        // Impulses on of.b in that step (at `newest`) and the three before, in turn, by axes
        std::array<float, 4> x{}, y{}, z{};
        Place place{};
        bool isUnknown = false; // first seen in mid-contact: its load is its first impulse
        bool isUsual = false;
        Vector3 push(unsigned turn) const noexcept { return {x[turn], y[turn], z[turn]}; }
        std::array<float, 4> squares() const noexcept; ///< of their magnitudes
        void set(Vector3 push) noexcept { x[newest] = push.x, y[newest] = push.y, z[newest] = push.z; }
    };

    /// Within a step: an existing contact of (a, b) has pushed b by `newtonSeconds` (world), and a by the
    /// opposite.
    Place& add(const TouchingPairs::Name& pair, std::int32_t load, Vector3 newtonSeconds);
    /// The same of a usual contact.
    [[gnu::always_inline]] Place& push(Contact& contact, Vector3 newtonSeconds) noexcept {
        // Summed over the step's points and solver passes, and over the segments of a chain.
        if (contact.step == step_) [[unlikely]] {
            newtonSeconds = contact.push(contact.newest) + newtonSeconds;
        } else {
            contact.newest = (contact.newest + 1) % 4;
            contact.step = step_;
        }
        contact.set(newtonSeconds);
        return contact.place;
    }
    /// The contact at that place; null: another's, or it collided in the last step, or is new.
    Contact* usual(const TouchingPairs::Name& pair, std::int32_t load) noexcept {
        Contact* const contact = contacts_.data() + load;
        if (contact >= contacts_.data() + contacts_.size()) return nullptr;
        return contact->of.a == pair.a && contact->of.b == pair.b && contact->isUsual ? contact : nullptr;
    }
    /// Call when the pair's `last` has changed.
    void noteLast(std::int32_t pair) noexcept {
        if (pairs_[pair].load != TouchingPairs::none) noteUsual(contacts_.data()[pairs_[pair].load]);
    }

    /// After a step: sums up the transmitted impulses.
    void settle();

    /// Haptic sources that received an impulse through existing contacts in this step. After settle().
    const std::vector<std::int32_t>& receivers() const noexcept { return receivers_; }

    /// The impulse that a haptic source received through existing contacts in this step. After settle().
    const Passed& passed(std::int32_t slot) const noexcept {
        static constexpr Passed nothing{};
        const auto index = static_cast<std::size_t>(slot);
        const bool isReceiver = index < passed_.size() && passed_[index].other != FixtureTable::none;
        return isReceiver ? passed_[index] : nothing;
    }
    /// The same of a slot in receivers().
    const Passed& received(std::int32_t receiver) const noexcept {
        return passed_[static_cast<std::size_t>(receiver)];
    }
    /// Where most of it was transmitted, in the same step; 0 if nothing was.
    Vector3 pointOf(const Passed& passed) const noexcept {
        return passed.other == FixtureTable::none ? Vector3{} : contacts_[passed.contact].place.point();
    }

    /// A contact begins: its load is 0.
    void begin(const TouchingPairs::Name& pair) {
        if (pairs_[pair.number].load == TouchingPairs::none) meet(pair, false);
    }

    /// Ends the step: its impulses become history. Sleeping bodies keep their load.
    void endStep();

    /// The slot is freed or reassigned: drops its contacts.
    void forget(std::int32_t slot) noexcept;

private:
    Contact& meet(const TouchingPairs::Name& pair, bool isUnknown);
    void noteUsual(Contact& contact) const noexcept {
        contact.isUsual = !contact.isUnknown && pairs_[contact.of.number].last == TouchingPairs::none;
    }
    [[gnu::always_inline]] void pass(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds, float size,
                                     std::size_t contact);
    void drop(std::size_t index) noexcept;

    const FixtureTable& table_;
    TouchingPairs& pairs_; // stores the index of each pair's load
    std::vector<Contact> contacts_;
    std::vector<Passed> passed_; // by slot
    std::vector<std::int32_t> receivers_, ended_;
    std::uint32_t step_ = 1; // the step's number, never 0
};

/// Updates the contact graph and records the collisions of each step (`Collision`). A collision needs parts
/// of two surfaces that were apart and that approach each other faster than a resting body does; its impulse
/// is what these parts push. All other impulses are loads: bodies that rest, lean, roll over a seam, or are
/// created at rest. A pair of fixtures has at most one collision per step, however many contacts and points
/// it has. Fixtures are given by their slots in the table. World thread (M).
class CollisionCatcher {
public:
    /// Most collisions of one step: those of haptic sources, and others, which may be transmitted to them. A
    /// world with more is noise to the touch.
    static constexpr std::size_t maxDirectCollisions = 1024;
    static constexpr std::size_t maxDistantCollisions = 4096;
    /// Memory is reserved for this many before the first step; lists that have grown keep theirs.
    static constexpr std::size_t expectedCollisions = 24;

    CollisionCatcher(const FixtureTable& table, ContactGraph& graph);

    /// Call right before the engine's step.
    void beginStep(const StepSpan& span) noexcept;

    /// Call right after it: all contacts have been reported.
    void settle();

    /// Call when the step's records have been used.
    void endStep();

    /// The slot is freed or reassigned: drops its records.
    void forget(std::int32_t slot) noexcept;

    bool isStepping() const noexcept { return isStepping_; }

    /// True if a collision, or a push at a haptic source, was reported in this step.
    bool hasHeard() const noexcept { return hasHeard_; }

    /// A contact of two solid fixtures begins; a pair may have several (the segments of a chain).
    std::int32_t begin(std::int32_t a, std::int32_t b);

    /// One of them ends. Fill in the returned record with time and motions. nullptr: no room, and the contact
    /// is treated as if it had not ended.
    ContactEnd* end(std::int32_t a, std::int32_t b) { return end({a, b, pairs_.find(a, b)}); }
    ContactEnd* end(const TouchingPairs::Name& pair); ///< its number: known, or none

    /// One of them has ended outside a step.
    void cut(std::int32_t a, std::int32_t b) { graph_.erase(a, b); }

    /// Counts a new contact point of two fixtures that the engine distinguishes from the pair's other points.
    void meet(std::int32_t a, std::int32_t b) noexcept {
        ++tally_.contacts;
        tally_.withoutSource += touchesSource(a, b) ? 0 : 1;
    }
    /// Counts a contact of a haptic source that was too slow for a collision. It would have been one with a
    /// threshold of `metresPerSecond`.
    void passOver(std::int32_t a, std::int32_t b, double metresPerSecond) noexcept;

    /// Counts since the owner last cleared them.
    ContactCounts& tally() noexcept { return tally_; }
    const ContactCounts& tally() const noexcept { return tally_; }

    /// The number of a pair of known fixtures, for the next methods. It may be kept: see TouchingPairs.
    std::int32_t know(std::int32_t a, std::int32_t b) { return pairs_.know(a, b); }
    bool isKnown(const TouchingPairs::Name& pair) const noexcept { return pairs_.is(pair); }
    TouchingPairs::Pair& operator[](const TouchingPairs::Name& pair) noexcept { return pairs_[pair.number]; }

    /// True if parts that approach each other at this speed, before the solver, collide; `gravityScale`: the
    /// larger one of the two bodies.
    bool isCollision(float gravityScale, double approachMetresPerSecond) const noexcept {
        return approachMetresPerSecond >= span_.leastApproach(gravityScale);
    }

    /// `collision` returns a pair's collision in this step, if there is one. `strike` creates it, with
    /// fixtures, mass and order set; the caller fills in the rest. When full, the weakest by mass and
    /// approach is dropped and counted; nullptr if that is the new one.
    Collision* strike(const TouchingPairs::Name& pair, double approachMetresPerSecond);
    Collision* collision(const TouchingPairs::Name& pair) noexcept {
        const std::int32_t known = pairs_[pair.number].collision;
        return known == TouchingPairs::none ? nullptr : &collisions_[static_cast<std::size_t>(known)];
    }

    /// False: the world has no haptic source, so nothing has to be reported. A source that is added later
    /// takes part from the next step on.
    bool hasSources() const noexcept { return table_.hasCameras(); }

    /// True if at least one of the two is a haptic source.
    bool touchesSource(std::int32_t a, std::int32_t b) const noexcept {
        return ((table_.traits(a) | table_.traits(b)) & FixtureTable::source) != 0;
    }

    /// True if pushes of the pair matter: one of them is a haptic source, or it collided in the last step.
    bool isRelevant(const TouchingPairs::Name& pair) const noexcept {
        return touchesSource(pair.a, pair.b) || pairs_[pair.number].last != TouchingPairs::none;
    }

    /// The same from the engine's numbers of two fixtures. False is certain, and avoids the search for the
    /// pair of most contacts in a world with few haptic sources.
    bool mayBeRelevant(std::uint64_t a, std::uint64_t b) const noexcept {
        return table_.mayBeCamera(a) || table_.mayBeCamera(b) ||
               (struckNames_.mayHave(a) && struckNames_.mayHave(b));
    }

    /// Adds the impulse, N s in the world, by which parts that do not collide have pushed b, and a by the
    /// opposite.
    void push(const TouchingPairs::Name& pair, Vector3 newtonSeconds, Vector3 point) {
        const bool isOfSource = touchesSource(pair.a, pair.b);
        if (ChainLoads::Place* const place = push(pair, pairs_[pair.number], isOfSource, newtonSeconds))
            place->set(point);
    }
    /// The same where what is stored of the pair, and whether it touches a source, are known. Returns the
    /// place, to be set, or null.
    ChainLoads::Place* push(const TouchingPairs::Name& pair, const TouchingPairs::Pair& stored,
                            bool isOfSource, Vector3 newtonSeconds) {
        hasHeard_ = true;
        if (stored.last != TouchingPairs::none) [[unlikely]]
            last_[static_cast<std::size_t>(stored.last)].newtonSeconds += newtonSeconds;
        return isOfSource ? &loads_.add(pair, stored.load, newtonSeconds) : nullptr;
    }
    /// The same of a usual contact.
    ChainLoads::Place& push(ChainLoads::Contact& usual, Vector3 newtonSeconds) {
        hasHeard_ = true;
        return loads_.push(usual, newtonSeconds);
    }

    const std::vector<Collision>& collisions() const noexcept { return collisions_; }
    /// Impulse in N s that a pair which collided in the last step has added in this one: engines spread an
    /// impact over two steps.
    double aftermath(std::int32_t pair) const noexcept;
    /// Contacts that ended in this step or since the last one.
    const std::vector<ContactEnd>& ends() const noexcept { return ends_; }
    /// True if the fixture collided in the last step.
    bool wasStruck(std::int32_t slot) const noexcept;
    const ChainLoads& loads() const noexcept { return loads_; }
    ChainLoads& loads() noexcept { return loads_; }

    /// Collisions dropped so far because the arrays were full.
    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Aftermath { // impulse in this step of a pair that collided in the last one
        std::int32_t pair;
        Vector3 newtonSeconds;
    };
    Collision* weakest(bool isDirect) noexcept;

    const FixtureTable& table_;
    ContactGraph& graph_;
    TouchingPairs& pairs_; // the graph's
    ChainLoads loads_{table_, pairs_};
    StepSpan span_;
    std::vector<Collision> collisions_; // of this step
    std::vector<ContactEnd> ends_;
    std::vector<Aftermath> last_;
    std::vector<std::uint64_t> struck_; // engine's numbers of the fixtures that collided in the last step
    NameSketch struckNames_;
    std::size_t directCollisions_ = 0;
    std::int32_t order_ = 0;
    bool isStepping_ = false, hasHeard_ = false;
    std::uint64_t drops_ = 0;
    ContactCounts tally_;
};

} // namespace physvib
