// SPDX-License-Identifier: MIT
// `onset` timing: impacts of haptic sources from the solver's impulses, when a contact begins.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/StrikeCauses.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A haptic source that takes part in a collision receives its impulse in that step. One farther along the
/// chain receives what its existing contacts transmit in that step and the next. Two are needed: engines
/// transmit a collision of their time-of-impact pass one step later, and spread the impulse through a long
/// chain over two steps, because their iterations end too early (a row of five: half and half). The impulse
/// is attributed to the strongest collision that is connected by contacts. It counts once, however many
/// collisions there are, and never exceeds what all of these gave, so that a humming machine on the same
/// floor adds nothing. Cost grows with collisions and transmitted impulses, not with the size of the world.
/// World thread (M) only.
class OnsetImpacts {
public:
    OnsetImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph);

    /// Appends the impacts that the step, now settled, has completed.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Drops pending impacts.
    void reset() noexcept;

    /// The world's origin has moved: shifts all places by this.
    void shift(Vector2 by) noexcept;

    /// Completes what a haptic source has received so far, because it is about to be destroyed.
    void finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const;

    /// The slot is freed or reassigned. Impacts that it caused at others stay, unless `withdraws`.
    void forget(std::int32_t slot, bool withdraws) noexcept;

private:
    struct HandedOn {
        std::int32_t camera;
        std::int64_t timeNs;        // of the strongest cause
        std::int32_t a, b;          // the slots of that cause
        double causedNewtonSeconds; // by all causes
        ChainLoads::Passed passed;  // in the first step
    };
    void strike(const StepSpan& span, std::vector<Impact>& impacts);
    void complete(const StepSpan& span, std::vector<Impact>& impacts);
    void completeLate(const StepSpan& span, std::vector<Impact>& impacts);
    template <class Later>
    void complete(const HandedOn& handedOn, const ChainLoads::Passed& now, Later later, const StepSpan& span,
                  std::vector<Impact>& impacts) const;
    void begin();
    static HandedOn handOn(std::int32_t camera, const StrikeCauses::Found& found,
                           const ChainLoads::Passed& passed) noexcept;

    const CollisionCatcher& catcher_;
    const FixtureTable& table_;
    ContactGraph& graph_;
    StrikeCauses strikes_, before_; // of this step and of the last
    std::vector<HandedOn> waiting_; // pending until the next step
    SlotMap isUsed_;                // sources whose impulse of this step has been used
};

} // namespace physvib
