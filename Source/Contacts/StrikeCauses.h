// SPDX-License-Identifier: MIT
// The collisions of one step, and which of them reach a haptic source through a path of contacts.
#pragma once
#include "Contacts/CollisionCatcher.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/SlotMap.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A collision above the impact threshold.
struct HardCollision {
    std::int32_t a, b, pair; // slots, and the number of their pair
    std::int64_t timeNs;
    double newtonSeconds;
    double aftermath; // N s that the pair added in the next step
    std::int32_t componentA, componentB;
    std::int32_t nextA, nextB; // the next weaker collision of the same slot
};

/// Sums are kept per component of the graph, so that a query costs the same however many collisions there
/// are: a shaken box of haptic sources has hundreds of collisions and a thousand queries per step. World
/// thread (M) only.
class StrikeCauses {
public:
    void clear() noexcept;
    void add(const HardCollision& strike);
    bool isEmpty() const noexcept { return strikes_.empty(); }

    /// Reads what the pairs added in the next step, after which the graph has changed.
    void follow(const CollisionCatcher& catcher);

    /// Sum and strongest of the collisions that reach a haptic source in the present graph, without its own.
    /// The first query after add() or follow() visits each collision.
    struct Found {
        const HardCollision* strongest = nullptr;    // nullptr: none
        double newtonSeconds = 0.0, aftermath = 0.0; // of all of them
    };
    Found find(std::int32_t camera, ContactGraph& graph);

    /// The slot is freed or reassigned: drops its collisions.
    void forget(std::int32_t slot) noexcept;

private:
    struct Sum {
        std::size_t strongest;
        double newtonSeconds, aftermath;
    };
    void locate(ContactGraph& graph);
    void sum(std::int32_t component, std::size_t strike);
    bool isReached(const HardCollision& strike) const noexcept;

    std::vector<HardCollision> strikes_; // sorted by strength once located
    std::vector<Sum> sums_;
    bool isLocated_ = false;
    SlotMap sumOf_;                     // by component
    SlotMap struck_;                    // the strongest of a slot's own collisions
    std::vector<std::int32_t> reached_; // components at the current source
};

} // namespace physvib
