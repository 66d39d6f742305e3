// SPDX-License-Identifier: MIT
// `onset` timing: what cameras feel of a contact that begins, by the solver's impulses.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A camera that is struck itself feels the impulse of that contact in its step. One farther along the chain
/// feels what its old contacts hand on to it in that step and the next, laid to the strongest strike of its
/// component: Box2D hands on a strike of its time-of-impact pass one step later, and the impulse through a
/// long chain by two steps, since its iterations end before it is through (a row of five: half and half).
/// What is handed on counts once, however many strikes there are. M only.
class OnsetImpacts {
public:
    OnsetImpacts(const CollisionCatcher& catcher, const FixtureTable& table, ContactGraph& graph);

    /// Appends the impacts that a step, now settled, has completed.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);

    /// Forgets what is under way.
    void reset() noexcept { waiting_.clear(); }

    /// The slot has another owner from now on. What others felt of it stays, unless `withdraws`.
    void forget(std::int32_t slot, bool withdraws) noexcept;

private:
    struct Strike {
        std::int32_t a, b; // slots
        std::int64_t timeNs;
        double newtonSeconds;
        std::int32_t componentA, componentB;
    };
    struct HandedOn {
        std::int32_t camera;
        Strike strike;
        ChainLoads::Passed passed; // in the first step
    };
    void strike(const StepSpan& span, std::vector<Impact>& impacts);
    void complete(const StepSpan& span, std::vector<Impact>& impacts);
    void begin();
    const Strike* cause(std::int32_t camera);
    bool isReached(std::int32_t component) const noexcept;

    const CollisionCatcher& catcher_;
    const FixtureTable& table_;
    ContactGraph& graph_;
    std::vector<Strike> strikes_;           // of this step, the strongest first
    std::vector<HandedOn> waiting_, begun_; // for the next step
    std::vector<bool> isUsed_;              // by slot: what it got in this step counts already
    std::vector<std::int32_t> reached_;     // components at the camera in question
};

} // namespace physvib
