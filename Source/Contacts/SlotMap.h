// SPDX-License-Identifier: MIT
// Array map from small indices (fixture slots) to values, cleared in constant time; for per-step data.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Like IntegerMap, for keys that are small (>= 0) and looked up very often. Allocates when a key exceeds all
/// earlier ones. One thread at a time.
class SlotMap {
public:
    static constexpr std::int32_t none = -1;

    explicit SlotMap(std::size_t slots = 128) { entries_.reserve(slots); }

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

    /// Removes all values in constant time: entries of another age count as empty.
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
