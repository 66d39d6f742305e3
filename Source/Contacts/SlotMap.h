// SPDX-License-Identifier: MIT
// What holds for a step, by slots of fixtures.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// As IntegerMap, for keys that are small (>= 0) and asked for very often. Allocates when it outgrows its
/// largest key. One thread at a time.
class SlotMap {
public:
    static constexpr std::int32_t none = -1;

    explicit SlotMap(std::size_t slots = 1024) { entries_.reserve(slots); }

    /// The value of `slot`, or `none`.
    std::int32_t find(std::int32_t slot) const noexcept {
        const auto index = static_cast<std::size_t>(slot);
        return index < entries_.size() && entries_[index].age == age_ ? entries_[index].value : none;
    }

    void set(std::int32_t slot, std::int32_t value) {
        const auto index = static_cast<std::size_t>(slot);
        if (entries_.size() <= index) entries_.resize(index + 1);
        entries_[index] = {value, age_};
    }

    /// Forgets all. Costs nothing: entries of another age are none.
    void clear() noexcept {
        if (++age_ != 0) return;
        for (Entry& entry : entries_) entry = {};
        age_ = 1;
    }

private:
    struct Entry {
        std::int32_t value = none;
        std::uint32_t age = 0;
    };
    std::vector<Entry> entries_;
    std::uint32_t age_ = 1;
};

} // namespace physvib
