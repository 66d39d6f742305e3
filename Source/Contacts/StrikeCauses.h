// SPDX-License-Identifier: MIT
// The strikes of one step, and which of them reach a camera through a path of contacts.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/SlotMap.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A blow that is hard enough to be a strike.
struct HardBlow {
    std::int32_t a, b, pair; // slots, and their number
    std::int64_t timeNs;
    double newtonSeconds;
    double aftermath; // N s that the pair went on to push in the next step
    std::int32_t componentA, componentB;
    std::int32_t nextA, nextB; // the next weaker blow of the same slot
};

/// Sums are kept per component of the graph, so that a question costs the same however many strikes there
/// are: in a shaken box of cameras hundreds of strikes meet a thousand questions. M only.
class StrikeCauses {
public:
    StrikeCauses();

    void clear() noexcept;
    void add(const HardBlow& strike);
    bool isEmpty() const noexcept { return strikes_.empty(); }

    /// Looks up what the pairs have gone on to push, in a step after which the graph is another.
    void follow(const CollisionCatcher& catcher);

    /// What reaches a camera in the graph as it is now, its own strikes left out. The first question since
    /// the last add() or follow() costs a look at each strike.
    struct Found {
        const HardBlow* strongest = nullptr;         // nullptr: nothing does
        double newtonSeconds = 0.0, aftermath = 0.0; // of all of them
    };
    Found find(std::int32_t camera, ContactGraph& graph);

    /// The slot has another owner from now on: its strikes are nobody's.
    void forget(std::int32_t slot) noexcept;

private:
    struct Sum {
        std::size_t strongest;
        double newtonSeconds, aftermath;
    };
    void locate(ContactGraph& graph);
    void sum(std::int32_t component, std::size_t strike);
    bool isReached(const HardBlow& strike) const noexcept;

    std::vector<HardBlow> strikes_; // the strongest first, once located
    std::vector<Sum> sums_;
    bool isLocated_ = false;
    SlotMap sumOf_;                     // by component
    SlotMap struck_;                    // the strongest of a slot's own strikes
    std::vector<std::int32_t> reached_; // components at the camera in question
};

} // namespace physvib
