// SPDX-License-Identifier: MIT
// From collisions to impacts, at their onset (OnsetImpacts) or, as in the thesis, at their release
// (ReleaseImpacts); which collisions cause a transmitted impact (ImpactCauses).
#pragma once
#include "Contacts/CollisionRecorder.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A collision above the impact threshold.
struct HardCollision {
    std::int32_t a, b, pair; // slots, and the number of their pair
    std::int64_t timeNs;
    double newtonSeconds;
    double aftermathNewtonSeconds = 0.0; // N s that the pair added in the next step
    std::int32_t componentA = 0, componentB = 0;
    std::int32_t nextA = SlotMap::none, nextB = SlotMap::none; // the next weaker collision of the same slot
};

/// Collisions that may cause transmitted impacts, summed per component of the graph. So a query costs the
/// same however many there are: a shaken box of haptic sources has hundreds of collisions and a thousand
/// queries per step. World thread (M) only.
class ImpactCauses {
public:
    ImpactCauses();

    struct CauseSum {
        const HardCollision* strongest = nullptr;                 // nullptr: none
        double newtonSeconds = 0.0, aftermathNewtonSeconds = 0.0; // of all of them
    };
    void clear() noexcept { collisions_.clear(); }
    void add(const HardCollision& collision);
    bool isEmpty() const noexcept { return collisions_.empty(); }

    /// Reads what the pairs added in the next step, after which the graph has changed.
    void addAftermath(const CollisionRecorder& recorder);

    /// Sum and strongest of the collisions that reach a haptic source in the present graph, without its own.
    /// The first query after add() or addAftermath() visits each collision. Valid until the next.
    const CauseSum& find(std::int32_t source, ContactGraph& graph) {
        if (collisions_.empty()) return sourceSum_ = {};
        prepare(graph, source + 1);
        return findPrepared(source, graph);
    }
    /// Call before findPrepared() for sources below `slots`; only if there are collisions.
    void prepare(ContactGraph& graph, std::int32_t slots) {
        graph.prepare(slots);
        if (!areSumsCurrent_) sumByComponent(graph);
    }
    const CauseSum& findPrepared(std::int32_t source, ContactGraph& graph) {
        const std::int32_t component = graph.preparedComponent(source);
        if (component == ContactGraph::noComponent || ownCollisions_.find(source) != SlotMap::none)
            return findAtSource(source, graph);
        const std::int32_t index = sumOf_.find(component); // the usual case
        return index == SlotMap::none ? sourceSum_ = {} : sums_[static_cast<std::size_t>(index)];
    }

    /// The slot is freed or reassigned: drops its collisions.
    void forget(std::int32_t slot) noexcept;

private:
    void sumByComponent(ContactGraph& graph);
    const CauseSum& findAtSource(std::int32_t source, ContactGraph& graph);
    void addToSum(std::int32_t component, std::size_t collision);
    bool isReached(const HardCollision& collision) const noexcept;

    std::vector<HardCollision> collisions_; // sorted by strength once summed
    std::vector<CauseSum> sums_;
    bool areSumsCurrent_ = false;
    SlotMap sumOf_;                               // by component
    SlotMap ownCollisions_;                       // the strongest of a slot's own collisions
    std::vector<std::int32_t> reachedComponents_; // components at the current source
    CauseSum sourceSum_;                          // result of the last findAtSource(), or none
};

/// `onset` timing: from the solver's impulses, when a contact begins. A haptic source that takes part in a
/// collision receives its impulse in that step. One farther along the chain receives what its existing
/// contacts transmit in that step and the next. Two are needed: engines transmit a collision of their
/// time-of-impact pass one step later, and spread the impulse through a long chain over two steps, because
/// their iterations end too early (a row of five: half and half). The impulse is attributed to the strongest
/// collision that is connected by contacts. It counts once, however many collisions there are, and never
/// exceeds what all of these gave, so that a humming machine on the same floor adds nothing. Cost grows with
/// collisions and transmitted impulses, not with the size of the world. World thread (M).
class OnsetImpacts {
public:
    OnsetImpacts(CollisionRecorder& recorder, const FixtureTable& table, ContactGraph& graph);

    /// Appends the impacts that the step, now settled, has completed.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Drops pending impacts.
    void reset() noexcept;

    /// The world's origin has moved: shifts all places by this.
    void shift(Vector2 offset) noexcept;

    /// Completes what a haptic source has received so far, because it is about to be destroyed.
    void finish(std::int32_t source, const StepSpan& span, std::vector<Impact>& impacts) const;

    /// The slot is freed or reassigned. Impacts that it caused at others stay, unless `dropsCaused`.
    void forget(std::int32_t slot, bool dropsCaused) noexcept;

private:
    struct TransmittedImpact {
        std::int32_t source;
        std::int64_t timeNs;                       // of the strongest cause
        std::int32_t a, b;                         // the slots of that cause
        double causedNewtonSeconds;                // by all causes
        TransmittedImpulses::Transmitted received; // in the first step
        Vector3 point;                             // of the contact that transmitted most, world
    };
    void addDirect(const StepSpan& span, std::vector<Impact>& impacts);
    void completePending(const StepSpan& span, std::vector<Impact>& impacts);
    void completeLate(const StepSpan& span, std::vector<Impact>& impacts);
    struct Limit { // smallest impulse that is an impact, by mass and gravity
        double lighterMassKg;
        float gravityScale;
    };
    Limit limitOf(std::int32_t slot, const TransmittedImpulses::Transmitted& mainPart) const noexcept;
    bool isImpact(double newtonSeconds, const TransmittedImpulses::Transmitted& mainPart,
                  double minImpulse) const noexcept;
    template <class Later>
    void complete(const TransmittedImpact& transmitted, const TransmittedImpulses::Transmitted& now,
                  Later later, const StepSpan& span, std::vector<Impact>& impacts) const;
    void beginTransmitted();

    CollisionRecorder& recorder_;
    const FixtureTable& table_;
    ContactGraph& graph_;
    ImpactCauses causes_, lastCauses_;       // of this step and of the last
    std::vector<TransmittedImpact> pending_; // pending until the next step
    SlotMap usedSources_;                    // sources whose impulse of this step has been used
};

/// `release` timing, as in the thesis: from the velocities before a contact and at its end. Eq. 5.2 and 5.3:
/// J = m dv + (I dw / |l|) t, from the beginning of a contact to its end, at most 50 ms later; the impact is
/// timed at the end. A source that is not dynamic gets the summed momentum change of the dynamic bodies that
/// touch it. Other causes that change these velocities meanwhile, such as gravity, are included. Therefore a
/// source that does not collide itself gets the smaller value with and without gravity, so that neither rest
/// nor fall counts, and at most what the collisions meanwhile gave (so that a humming machine on the same
/// floor adds nothing to a pebble's impact). At most one such transmitted impact is pending per source. World
/// thread (M).
class ReleaseImpacts {
public:
    static constexpr std::int64_t latestNs = 50'000'000; // thesis 5.1.3: released 10 to 50 ms later

    ReleaseImpacts(const CollisionRecorder& recorder, const FixtureTable& table, ContactGraph& graph,
                   const BodyReader& bodies);

    /// Appends the impacts of contacts that ended or expired in a settled step.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Drops pending impacts.
    void reset() noexcept {
        pending_.clear();
        lastCauses_.clear();
    }

    /// The world's origin has moved: shifts all places by this.
    void shift(Vector2 offset) noexcept {
        for (PendingImpact& pending : pending_) pending.point += offset;
    }

    /// Ends a contact outside a step.
    void endOutsideStep(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts);

    /// Completes what a haptic source has received so far, because it is about to be destroyed.
    void finish(std::int32_t source, const StepSpan& span, std::vector<Impact>& impacts) const;

    /// The slot is freed or reassigned. A destroyed source gets no impacts; a source whose partner is
    /// destroyed keeps what it received so far, unless `dropsCaused`.
    void forget(std::int32_t slot, bool dropsCaused) noexcept;

    /// Impacts dropped so far because the buffer was full.
    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct PendingImpact {
        std::int32_t source, other; // slots; other: none once it is destroyed
        std::int32_t a, b;          // the contact
        std::int32_t order;         // of its beginning within the step; in earlier steps: -1
        bool isDirect, hasEnded;
        std::int64_t beginNs;
        Vector3 point;
        Vector2 arm; // from the centre of mass to the point, -l of Eq. 5.3
        BodyMotion start;
        double lighterMassKg;
        float gravityScale;
        Vector2 gainedMomentum{};         // N s, from the bodies that touch an immovable source
        double causedNewtonSeconds = 0.0; // of a transmitted impact: the sum of all connected collisions so
                                          // far
    };
    void beginPending(const StepSpan& span);
    void beginDirect(const Collision& collision, const StepSpan& span);
    void beginTransmitted(std::int32_t source, const StepSpan& span);
    void findCauses(const StepSpan& span);
    bool isStronger(std::int32_t collision, std::int32_t rival) const noexcept;
    void push(const PendingImpact& pending);
    void addMomentumChanges();
    void addCausedImpulses();
    Vector2 momentumChange(std::int32_t source);
    Vector2 momentumChangeOf(std::int32_t slot);
    void release(bool beganThisStep, const StepSpan& span, std::vector<Impact>& impacts);
    template <class Filter>
    void release(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts, Filter filter);
    void expire(const StepSpan& span, std::vector<Impact>& impacts);
    void finish(const PendingImpact& pending, const BodyMotion& end, std::int64_t timeNs,
                const StepSpan& span, std::vector<Impact>& impacts) const;
    Vector2 impulse(const PendingImpact& pending, const BodyMotion& end) const;

    const CollisionRecorder& recorder_;
    const FixtureTable& table_;
    ContactGraph& graph_;
    const BodyReader& bodies_;
    std::vector<PendingImpact> pending_;
    static constexpr std::int32_t transmitted = 0, direct = 1;
    SlotMap pendingKindOf_;            // whether a source has a transmitted or a direct impact pending
    SlotMap struckA_, struckB_;        // slots of pending impacts, whose contacts' ends matter
    std::vector<double> impulses_;     // of this step's collisions
    SlotMap strongestOf_;              // strongest collision by component
    ImpactCauses causes_, lastCauses_; // of this step and of the last
    std::vector<std::int32_t> reachedComponents_; // components at the current source
    IntegerMap lastSumOf_;                        // by body: the last sum in which it was counted
    std::int32_t momentumSums_ = 0;
    std::uint64_t drops_ = 0;
};

} // namespace physvib
