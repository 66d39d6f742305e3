// SPDX-License-Identifier: MIT
// Counting hash filter: tests quickly, in the first-level cache, whether a number may be in a set.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Never returns false for a number that was added; returns true for others with a probability that grows
/// with the set. Counts how often a number was added. One thread at a time.
class NameSketch {
public:
    void add(std::uint64_t name) noexcept { ++counts_[place(name)]; }

    /// Removes a number that was added.
    void remove(std::uint64_t name) noexcept { --counts_[place(name)]; }

    bool mayHave(std::uint64_t name) const noexcept { return counts_[place(name)] != 0; }

private:
    static constexpr int bits = 11;
    static constexpr std::size_t place(std::uint64_t name) noexcept {
        return static_cast<std::size_t>((name * 0x9E3779B97F4A7C15U) >> (64 - bits)); // hash as in IntegerMap
    }

    std::array<std::uint32_t, std::size_t{1} << bits> counts_{};
};

} // namespace physvib
