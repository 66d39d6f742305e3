// SPDX-License-Identifier: MIT
// Numbers for pairs of touching fixtures, under which per-pair data are stored, so that each access needs no
// search.
#pragma once
#include "Contacts/ContactGraph.h"
#include "Contacts/IntegerMap.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// A pair of slots has a number while it touches or while one of its fields is set. Check a number kept for
/// longer with `is`. Allocates only to grow. World thread (M) only.
class TouchingPairs {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// Two slots in the order of their contact, and their number.
    struct Name {
        std::int32_t a = none, b = none, number = none;
    };

    struct Pair {
        std::int32_t a = none, b = none; ///< slots in any order; none: the number is free
        std::int32_t collision = none;   ///< index of its collision in this step
        std::int32_t last = none;        ///< index of its collision in the last step
        std::int32_t load = none;        ///< index of its resting load
    };

    explicit TouchingPairs(std::size_t pairs = 128)
        : numbers_(pairs) {
        pairs_.reserve(pairs);
        free_.reserve(pairs);
        loose_.reserve(pairs);
    }

    /// The number of a pair, a new one if necessary.
    std::int32_t know(std::int32_t a, std::int32_t b) {
        if (const std::int32_t known = numbers_.find(pairKey(a, b)); known != none) return known;
        if (free_.empty()) {
            free_.push_back(static_cast<std::int32_t>(pairs_.size()));
            pairs_.emplace_back();
        }
        const std::int32_t number = free_.back();
        free_.pop_back();
        numbers_.set(pairKey(a, b), number);
        (*this)[number] = {.a = a, .b = b};
        loose_.push_back(number);
        return number;
    }

    bool is(const Name& name) const noexcept {
        if (name.number == none) return false;
        const Pair& pair = (*this)[name.number];
        return (pair.a == name.a && pair.b == name.b) || (pair.a == name.b && pair.b == name.a);
    }

    Pair& operator[](std::int32_t number) noexcept { return pairs_[static_cast<std::size_t>(number)]; }
    const Pair& operator[](std::int32_t number) const noexcept {
        return pairs_[static_cast<std::size_t>(number)];
    }

    /// Contacts of a pair, or of all pairs of a slot, have ended: the number is freed once no field is set.
    void loosen(std::int32_t a, std::int32_t b) {
        if (const std::int32_t known = numbers_.find(pairKey(a, b)); known != none) loose_.push_back(known);
    }
    void loosen(std::int32_t slot) {
        for (const Pair& pair : pairs_)
            if (pair.a == slot || pair.b == slot) loosen(pair.a, pair.b);
    }

    /// Call at the end of a step: frees numbers.
    void endStep(const ContactGraph& graph) {
        std::erase_if(loose_, [&](std::int32_t number) {
            Pair& pair = (*this)[number];
            if (pair.a == none || graph.isTouching(pair.a, pair.b)) return true;
            if (pair.collision != none || pair.last != none || pair.load != none) return false;
            numbers_.erase(pairKey(pair.a, pair.b));
            pair = {};
            free_.push_back(number);
            return true;
        });
    }

private:
    std::vector<Pair> pairs_;
    IntegerMap numbers_; // by the pair
    std::vector<std::int32_t> free_;
    std::vector<std::int32_t> loose_; // candidates to be freed
};

} // namespace physvib
