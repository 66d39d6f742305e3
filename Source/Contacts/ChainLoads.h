// SPDX-License-Identifier: MIT
// Finds impulses that reach haptic sources through existing contacts: impacts transmitted by neighbouring
// bodies.
#pragma once
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/TouchingPairs.h"
#include "Contacts/Vector3.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Watches the existing contacts of haptic sources. Resting bodies push too, equally in every step: that is a
/// contact's load, the smallest of its impulses in the last three steps (an impact, which may take two, is no
/// load). The excess over the load is a transmitted impact; an impulse below it is none. Impulses at one body
/// are summed as vectors; the spin of Eq. 5.2 is not added, because the sum is already the whole impulse.
/// Allocates when the world grows. World thread (M) only.
class ChainLoads {
public:
    struct Passed {
        Vector3 newtonSeconds;
        float strongest = 0.0F;                  ///< magnitude of the part that came through `other`
        std::int32_t other = FixtureTable::none; ///< slot of the neighbour that transmitted most
        Vector3 point;
    };

    ChainLoads(const FixtureTable& table, TouchingPairs& pairs);

    /// Within a step: an existing contact of (a, b) has pushed b by `newtonSeconds` (world), and a by the
    /// opposite.
    void add(const TouchingPairs::Name& pair, Vector3 newtonSeconds, Vector3 point) {
        Contact& contact = find(pair, true);
        // Summed over the step's points and solver passes, and over the segments of a chain.
        contact.now += contact.b == pair.b ? newtonSeconds : -newtonSeconds;
        contact.point = point;
        contact.isSolved = true;
    }

    /// After a step: sums up the transmitted impulses.
    void settle();

    /// Haptic sources that received an impulse through existing contacts in this step. After settle().
    const std::vector<std::int32_t>& receivers() const noexcept { return receivers_; }

    /// The impulse that a haptic source received through existing contacts in this step. After settle().
    Passed passed(std::int32_t slot) const noexcept {
        const auto index = static_cast<std::size_t>(slot);
        return index < passed_.size() ? passed_[index] : Passed{};
    }

    /// A contact begins: its load is 0.
    void begin(const TouchingPairs::Name& pair) { find(pair, false); }

    /// Ends the step: its impulses become history. Sleeping bodies keep their load.
    void endStep(const ContactGraph& graph) noexcept;

    /// The slot is freed or reassigned: drops its contacts.
    void forget(std::int32_t slot) noexcept;

private:
    struct alignas(32) Contact { // read for every push: half a cache line
        Vector3 now, point;      // now: impulse on b in this step
        std::int32_t b;
        bool isSolved;
        bool isUnknown; // first seen in mid-contact: the impulse of this step is taken as its load
    };
    struct Past { // read once per step
        TouchingPairs::Name of;
        Vector3 load{};
        std::array<Vector3, 3> pushed{}; // newest first
    };
    static Vector3 smallestOf(const std::array<Vector3, 3>& pushed) noexcept;
    Contact& find(const TouchingPairs::Name& pair, bool isUnknown) {
        const std::int32_t at = pairs_[pair.number].load;
        return at != TouchingPairs::none ? contacts_[static_cast<std::size_t>(at)] : meet(pair, isUnknown);
    }
    Contact& meet(const TouchingPairs::Name& pair, bool isUnknown);
    void pass(std::int32_t slot, std::int32_t other, Vector3 newtonSeconds, float size, Vector3 point);
    void drop(std::size_t index) noexcept;

    const FixtureTable& table_;
    TouchingPairs& pairs_; // stores the index of each pair's load
    std::vector<Contact> contacts_;
    std::vector<Past> pasts_;    // parallel to contacts_
    std::vector<Passed> passed_; // by slot
    std::vector<std::int32_t> receivers_;
};

} // namespace physvib
