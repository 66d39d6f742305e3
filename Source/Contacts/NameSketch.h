// SPDX-License-Identifier: MIT
// Which names may be in a set, asked without leaving the nearest cache.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Never says no of a name that is there; says yes of one that is not only as often as the set is large. A
/// name counts as often as it was added. One thread at a time.
class NameSketch {
public:
    void add(std::uint64_t name) noexcept { ++counts_[place(name)]; }

    /// Of one that was added.
    void remove(std::uint64_t name) noexcept { --counts_[place(name)]; }

    bool mayHave(std::uint64_t name) const noexcept { return counts_[place(name)] != 0; }

private:
    static constexpr int bits = 11;
    static constexpr std::size_t place(std::uint64_t name) noexcept {
        return static_cast<std::size_t>((name * 0x9E3779B97F4A7C15U) >> (64 - bits)); // as IntegerMap does
    }

    std::array<std::uint32_t, std::size_t{1} << bits> counts_{};
};

} // namespace physvib
