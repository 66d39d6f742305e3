// SPDX-License-Identifier: MIT
// The impulses that reach cameras through contacts that were there before: hits handed on by others.
#pragma once
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/TouchingPairs.h"
#include "Contacts/Vector2.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Watches the old contacts of cameras. Bodies that rest push too, the same in every step: that is a
/// contact's load, the smallest of its impulses in the last three steps (so that a hit, which may take two,
/// is no load). What a contact pushes beyond its load has been handed on by it; less than its load is a
/// relief, not a strike. The contacts' sum is the whole impulse, whatever it does to the spin, so nothing is
/// added for that, as Eq. 5.2 would. Allocates when the world grows. M only.
class ChainLoads {
public:
    struct Passed {
        Vector2 newtonSeconds;
        float strongest = 0.0F;                  ///< size of the part that came through `other`
        std::int32_t other = FixtureTable::none; ///< slot of the neighbour that handed on most
        Vector2 point;
    };

    ChainLoads(const FixtureTable& table, TouchingPairs& pairs);

    /// In a step: an old contact of (a, b) has pushed b by `newtonSeconds` (world), and a by its opposite.
    void add(const TouchingPairs::Name& pair, Vector2 newtonSeconds, Vector2 point) {
        Contact& contact = find(pair, true);
        // The points and passes of the step, the parts of a chain.
        contact.now += contact.b == pair.b ? newtonSeconds : -newtonSeconds;
        contact.point = point;
        contact.isSolved = true;
    }

    /// After a step: adds up what was handed on.
    void settle();

    /// The cameras that got something through old contacts in this step. After settle().
    const std::vector<std::int32_t>& receivers() const noexcept { return receivers_; }

    /// What a camera got through old contacts in this step. After settle().
    Passed passed(std::int32_t slot) const noexcept {
        const auto index = static_cast<std::size_t>(slot);
        return index < passed_.size() ? passed_[index] : Passed{};
    }

    /// A contact begins: it has no load yet.
    void begin(const TouchingPairs::Name& pair) { find(pair, false); }

    /// At last: this step becomes the past. Bodies that sleep keep their load.
    void endStep(const ContactGraph& graph) noexcept;

    /// The slot has another owner from now on.
    void forget(std::int32_t slot) noexcept;

private:
    struct alignas(32) Contact { // what a push asks for: half a cache line
        Vector2 now, point;      // now: on b
        Vector2 load;
        std::int32_t b;
        bool isSolved;
        bool isUnknown; // met in mid-contact: what it pushes in this step is its load
    };
    struct Past { // what is asked for once a step
        TouchingPairs::Name of;
        std::array<Vector2, 3> pushed{}; // the newest first
    };
    static Vector2 smallestOf(const std::array<Vector2, 3>& pushed) noexcept;
    Contact& find(const TouchingPairs::Name& pair, bool isUnknown) {
        const std::int32_t at = pairs_[pair.number].load;
        return at != TouchingPairs::none ? contacts_[static_cast<std::size_t>(at)] : meet(pair, isUnknown);
    }
    Contact& meet(const TouchingPairs::Name& pair, bool isUnknown);
    void pass(std::int32_t slot, std::int32_t other, Vector2 newtonSeconds, float size, Vector2 point);
    void drop(std::size_t index) noexcept;

    const FixtureTable& table_;
    TouchingPairs& pairs_; // say where the loads of each are
    std::vector<Contact> contacts_;
    std::vector<Past> pasts_;    // of the same contacts
    std::vector<Passed> passed_; // by slot
    std::vector<std::int32_t> receivers_;
};

} // namespace physvib
