// SPDX-License-Identifier: MIT
// Maps from numbers to indices (IntegerMap, SlotMap) and a filter of numbers, for use in contact callbacks.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// The key of an unordered pair of different indices (>= 0). Never 0, because the larger index is above 0.
/// Any thread.
constexpr std::uint64_t pairKey(std::int32_t a, std::int32_t b) noexcept {
    const auto low = static_cast<std::uint64_t>(std::min(a, b));
    return low << 32U | static_cast<std::uint64_t>(std::max(a, b));
}

/// Open addressing with linear probing, at most half full. Unlike std::unordered_map it allocates only to
/// grow, and a lookup reads one or two cache lines. It cannot be iterated over. One thread at a time.
class IntegerMap {
public:
    static constexpr std::int32_t none = -1;

    /// `capacity` keys fit without an allocation.
    explicit IntegerMap(std::size_t capacity = 32) { allocate(std::bit_ceil(2 * capacity + 2)); }

    /// The value of `key` (not 0), or `none`.
    std::int32_t find(std::uint64_t key) const noexcept {
        const Entry& entry = entries_[locate(key)];
        return isTaken(entry) ? entry.value : none;
    }

    /// Sets the value of `key` (not 0).
    void set(std::uint64_t key, std::int32_t value) {
        if (2 * (size_ + 1) > entries_.size()) grow();
        Entry& entry = entries_[locate(key)];
        if (!isTaken(entry)) ++size_;
        entry = {key, value, age_};
    }

    /// Removes `key`, if present. Later keys of the same run move up, so that probing finds them.
    void erase(std::uint64_t key) noexcept {
        std::size_t hole = locate(key);
        if (!isTaken(entries_[hole])) return;
        for (std::size_t next = nextIndex(hole); isTaken(entries_[next]); next = nextIndex(next)) {
            const std::size_t probeLength = (next - homeIndex(entries_[next].key)) & mask();
            if (probeLength < ((next - hole) & mask())) continue;
            entries_[hole] = entries_[next];
            hole = next;
        }
        entries_[hole] = {};
        --size_;
    }

    /// Removes all keys, and keeps the memory. Constant time: entries of another age count as free.
    void clear() noexcept {
        size_ = 0;
        if (++age_ != 0) return;
        std::fill(entries_.begin(), entries_.end(), Entry{});
        age_ = 1;
    }

    std::size_t size() const noexcept { return size_; }

private:
    struct Entry {
        std::uint64_t key = 0;
        std::int32_t value = none;
        std::uint32_t age = 0;
    };
    bool isTaken(const Entry& entry) const noexcept { return entry.age == age_; }

    std::size_t mask() const noexcept { return entries_.size() - 1; }
    std::size_t nextIndex(std::size_t index) const noexcept { return (index + 1) & mask(); }
    std::size_t homeIndex(std::uint64_t key) const noexcept {
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_); // Fibonacci hashing,
                                                                                // Knuth 6.4
    }
    std::size_t locate(std::uint64_t key) const noexcept {
        std::size_t index = homeIndex(key);
        while (isTaken(entries_[index]) && entries_[index].key != key) index = nextIndex(index);
        return index;
    }
    void allocate(std::size_t count) {
        entries_.assign(count, {});
        shift_ = 64 - std::countr_zero(count);
        size_ = 0;
    }
    void grow() {
        std::vector<Entry> old;
        old.swap(entries_);
        allocate(2 * old.size());
        for (const Entry& entry : old)
            if (isTaken(entry)) set(entry.key, entry.value);
    }

    std::vector<Entry> entries_;
    std::size_t size_ = 0;
    std::uint32_t age_ = 1;
    int shift_ = 0;
};

/// Like IntegerMap, and cleared in constant time, for keys that are small (>= 0) and looked up very often.
/// Allocates when a key exceeds all earlier ones. One thread at a time.
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

    /// Slots below `slots` may be marked.
    void ensureSlots(std::int32_t slots) {
        entries_.resize(std::max(entries_.size(), static_cast<std::size_t>(slots)));
    }
    /// Sets 0, where it only matters whether there is a value.
    void mark(std::int32_t slot) noexcept { entries_[static_cast<std::size_t>(slot)] = {0, age_}; }
    bool isMarked(std::int32_t slot) const noexcept {
        return entries_[static_cast<std::size_t>(slot)].age == age_;
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

/// A counting hash filter in the first-level cache. Never returns false for a number that was added; returns
/// true for others with a probability that grows with the set. Counts how often a number was added. One
/// thread at a time.
class CountingFilter {
public:
    void add(std::uint64_t number) noexcept { ++counts_[indexOf(number)]; }

    /// Removes a number that was added.
    void remove(std::uint64_t number) noexcept { --counts_[indexOf(number)]; }

    bool mayContain(std::uint64_t number) const noexcept { return counts_[indexOf(number)] != 0; }

private:
    static constexpr int bits = 11;
    static constexpr std::size_t indexOf(std::uint64_t number) noexcept {
        return static_cast<std::size_t>((number * 0x9E3779B97F4A7C15U) >> (64 - bits)); // hash as in
                                                                                        // IntegerMap
    }

    std::array<std::uint16_t, std::size_t{1} << bits> counts_{}; // enough for a hundred million numbers
};

} // namespace physvib
