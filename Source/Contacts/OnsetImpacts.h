// SPDX-License-Identifier: MIT
// `onset` timing: what cameras feel of a blow, by the solver's impulses.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/StrikeCauses.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A camera that is struck itself feels the impulse of that blow in its step. One farther along the chain
/// feels what its old contacts hand on to it in that step and the next: engines hand on a strike of their
/// time-of-impact pass one step later, and the impulse through a long chain by two steps, since their
/// iterations end before it is through (a row of five: half and half). It is laid to the strongest strike
/// that a path of contacts leads from, counts once, however many strikes there are, and is never more than
/// all of these gave: a path carries a blow, not the humming of a machine on the same floor. Costs what
/// strikes and what is handed on, whatever the size of the world. M only.
class OnsetImpacts {
public:
    OnsetImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph);

    /// Appends the impacts that a step, now settled, has completed.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Forgets what is under way.
    void reset() noexcept;

    /// All places have moved by this much: the world's origin is another.
    void shift(Vector2 by) noexcept;

    /// What a camera has been handed on so far, since it is about to vanish.
    void finish(std::int32_t camera, const StepSpan& span, std::vector<Impact>& impacts) const;

    /// The slot has another owner from now on. What others felt of it stays, unless `withdraws`.
    void forget(std::int32_t slot, bool withdraws) noexcept;

private:
    struct HandedOn {
        std::int32_t camera;
        std::int64_t timeNs;        // of the strongest cause
        std::int32_t a, b;          // its slots
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
    StrikeCauses strikes_, before_; // of this step and the last one
    std::vector<HandedOn> waiting_; // for the next step
    SlotMap isUsed_;                // what a camera got in this step counts already
};

} // namespace physvib
