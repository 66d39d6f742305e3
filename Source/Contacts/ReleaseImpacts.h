// SPDX-License-Identifier: MIT
// `release` timing, as the thesis has it: impulses from the velocities before a contact and at its end.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/IntegerMap.h"
#include "Contacts/SlotMap.h"
#include "Contacts/StrikeCauses.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Eq. 5.2 and 5.3: J = m dv + (I dw / |l|) t, from the beginning of a contact to its end, at the latest 50
/// ms later, which is the time of the impact, too. A camera that is not dynamic gets the summed momentum
/// change of the dynamic bodies that touch it. Whatever else changes these velocities meanwhile is in it as
/// well, gravity for one; where a camera is not struck itself, the smaller value with and without gravity
/// counts, so that it feels neither rest nor fall, and no more than what struck meanwhile gave (a machine
/// that hums on the same floor is no part of a pebble's blow). At most one such handed-on impact is under way
/// per camera. M only.
class ReleaseImpacts {
public:
    static constexpr std::int64_t latestNs = 50'000'000; // thesis 5.1.3: released 10 to 50 ms later

    ReleaseImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph,
                   const BodyReader& bodies);

    /// Appends the impacts of contacts that ended, or got old, in a step that is settled.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Forgets what is under way.
    void reset() noexcept {
        strikes_.clear();
        before_.clear();
    }

    /// All places have moved by this much: the world's origin is another.
    void shift(Vector2 by) noexcept {
        for (Strike& strike : strikes_) strike.point += by;
    }

    /// A contact ends while the engine does not step.
    void cut(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts);

    /// What a camera has felt so far, since it is about to vanish.
    void finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const;

    /// The slot has another owner from now on. A camera that is gone feels nothing; one whose partner is gone
    /// feels what it felt so far, unless `withdraws`.
    void forget(std::int32_t slot, bool withdraws) noexcept;

    /// Strikes that found no room so far.
    std::uint64_t drops() const noexcept { return drops_; }

private:
    struct Strike {
        std::int32_t camera, other; // slots; other: none once it is gone
        std::int32_t a, b;          // the contact
        std::int32_t order;         // of its beginning within the step; earlier: -1
        bool isDirect, isOver;
        std::int64_t beginNs;
        Vector2 point, arm; // arm: from the centre of mass to the point, -l of Eq. 5.3
        BodyMotion start;
        double lighterMassKg;
        float gravityScale;
        Vector2 gained{};                 // N s, by what touches an immovable camera
        double causedNewtonSeconds = 0.0; // of what is handed on: given so far by all from which a path led
                                          // here
    };
    void open(const StepSpan& span);
    void openDirect(const Blow& blow, const StepSpan& span);
    void openHandedOn(const StepSpan& span);
    void openHandedOn(std::int32_t camera, const StepSpan& span);
    void findCauses(const StepSpan& span);
    bool isStronger(std::int32_t blow, std::int32_t than) const noexcept;
    void push(const Strike& strike);
    void follow();
    void followCauses();
    Vector2 gain(std::int32_t camera);
    Vector2 gainOf(std::int32_t slot);
    void release(bool ofThisStep, const StepSpan& span, std::vector<Impact>& impacts);
    template <class Choice>
    void release(const ContactEnd& end, const StepSpan& span, std::vector<Impact>& impacts, Choice choice);
    void expire(const StepSpan& span, std::vector<Impact>& impacts);
    void finish(const Strike& strike, const BodyMotion& end, std::int64_t timeNs, const StepSpan& span,
                std::vector<Impact>& impacts) const;
    Vector2 impulse(const Strike& strike, const BodyMotion& end) const;

    const CollisionCatcher& catcher_;
    const FixtureTable& table_;
    ContactGraph& graph_;
    const BodyReader& bodies_;
    std::vector<Strike> strikes_;
    static constexpr std::int32_t handedOn = 0, direct = 1;
    SlotMap underWay_;                  // which of the two a camera has
    SlotMap isStruckA_, isStruckB_;     // whose contact ends may end strikes
    std::vector<double> impulses_;      // of the blows of this step
    SlotMap strongestOf_;               // of these, by component
    StrikeCauses causes_, before_;      // of this step and the last one
    std::vector<std::int32_t> reached_; // components at the camera in question
    IntegerMap counted_;                // by body: the sum it was last counted in
    std::int32_t sums_ = 0;
    std::uint64_t drops_ = 0;
};

} // namespace physvib
