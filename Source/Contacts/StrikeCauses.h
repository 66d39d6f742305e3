// SPDX-License-Identifier: MIT
// The strikes of one step, and which of them reach a camera through a path of contacts.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/IntegerMap.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A blow that is hard enough to be a strike.
struct HardBlow {
    std::int32_t a, b; // slots
    std::int64_t timeNs;
    double newtonSeconds;
    double aftermath; // N s that the pair went on to push in the next step
    std::int32_t componentA, componentB;
};

/// Sums are kept per component of the graph, so that a question costs the same however many strikes there are: in a
/// shaken box of cameras hundreds of strikes meet a thousand questions. M only.
class StrikeCauses {
public:
    StrikeCauses();

    void clear() noexcept;
    void add(const HardBlow& strike) { strikes_.push_back(strike); }
    bool isEmpty() const noexcept { return strikes_.empty(); }

    /// All are added: where they are in the graph as it is now. May be called again when it has changed.
    void locate(ContactGraph& graph);

    /// Looks up what the pairs have gone on to push. Before locate().
    void follow(const CollisionCatcher& catcher);

    /// What reaches a camera, its own strikes left out.
    struct Found {
        const HardBlow* strongest = nullptr; // nullptr: nothing does
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
    void sum(std::int32_t component, std::size_t strike);
    bool isReached(const HardBlow& strike) const noexcept;

    std::vector<HardBlow> strikes_; // the strongest first, once located
    std::vector<Sum> sums_;
    IntegerMap sumOf_{64};              // by component + 1
    IntegerMap struck_{256};            // by slot + 1: has strikes of its own
    std::vector<std::int32_t> reached_; // components at the camera in question
};

} // namespace physvib
