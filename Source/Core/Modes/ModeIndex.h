// SPDX-License-Identifier: MIT
// Hash table from a mode's increments to its slot, with linear probing, so that a strike need not search all
// modes.
#pragma once
#include "Core/Storage.h"
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Hash of a mode's increments; its top bits are well mixed (Fibonacci hashing, Knuth vol. 3, 6.4).
inline std::uint64_t modeHash(std::uint64_t phaseIncrement, std::int64_t decayIncrement,
                              bool isGated) noexcept {
    const std::uint64_t mixed =
        (phaseIncrement ^ std::rotl(static_cast<std::uint64_t>(decayIncrement), 29)) + (isGated ? 1 : 0);
    return (mixed ^ mixed >> 31) * 0x9e3779b97f4a7c15;
}

/// At most `Slots` slots. The caller keeps the keys: it supplies the hash, and compares the key of a slot.
template <int Slots>
class ModeIndex {
public:
    /// Empties the table and makes room for `slots` slots; there is no room before the first call. False: no
    /// memory. Message thread (M), not while rendering.
    bool resize(int slots) noexcept {
        bits_ = bitsFor(slots);
        size_ = std::size_t{1} << bits_;
        if (!entries_.resize(size_)) return false;
        clear();
        return true;
    }
    void clear() noexcept { std::fill_n(entries_.data(), size_, Entry{}); }

    /// The slot for which `isMeant(slot)` is true, -1 if there is none.
    template <class Predicate>
    int find(std::uint64_t hash, Predicate isMeant) const noexcept {
        for (std::size_t at = home(hash); entries_[at].slot >= 0; at = after(at))
            if (entries_[at].hash == tag(hash) && isMeant(entries_[at].slot)) return entries_[at].slot;
        return -1;
    }

    void insert(std::uint64_t hash, int slot) noexcept {
        std::size_t at = home(hash);
        while (entries_[at].slot >= 0) at = after(at);
        entries_[at] = {tag(hash), slot};
    }

    /// Removes a slot that was inserted with this hash. Later entries move up, so that linear probing still
    /// finds them.
    void erase(std::uint64_t hash, int slot) noexcept {
        std::size_t gap = home(hash);
        while (entries_[gap].slot != slot) gap = after(gap);
        for (std::size_t at = after(gap); entries_[at].slot >= 0; at = after(at)) {
            const std::size_t wanted = entries_[at].hash >> (32 - bits_);
            if (((at - wanted) & mask()) < ((at - gap) & mask())) continue; // its home lies behind the gap
            entries_[gap] = entries_[at];
            gap = at;
        }
        entries_[gap] = {};
    }

private:
    static constexpr int bitsFor(int slots) noexcept {
        return static_cast<int>(std::bit_width(static_cast<unsigned>(2 * slots)));
    }
    struct Entry {
        std::uint32_t hash = 0;
        std::int32_t slot = -1;
    };
    static std::uint32_t tag(std::uint64_t hash) noexcept { return static_cast<std::uint32_t>(hash >> 32); }
    std::size_t mask() const noexcept { return size_ - 1; }
    std::size_t home(std::uint64_t hash) const noexcept { return tag(hash) >> (32 - bits_); }
    std::size_t after(std::size_t at) const noexcept { return (at + 1) & mask(); }
    Storage<Entry, std::size_t{1} << bitsFor(Slots), true> entries_;
    std::size_t size_ = 0;
    int bits_ = 1;
};

} // namespace physvib
