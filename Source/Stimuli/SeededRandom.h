// SPDX-License-Identifier: MIT
// Seeded random numbers that are the same on every machine, unlike the standard library's distributions.
#pragma once
#include "Core/PortableMath.h"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// One stream of numbers; streams with different names are independent. Any thread, one at a time.
class SeededRandom {
public:
    /// Different seeds and names give unrelated streams (FNV-1a over the name).
    explicit SeededRandom(std::uint64_t seed, std::string_view name = {}) noexcept
        : state_{seed * 0x9E3779B97F4A7C15u + 0xCBF29CE484222325u} {
        if (name.empty()) state_ = next(); // else seed + 1 would give the same stream, one step ahead
        for (const char c : name) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
        next();
    }

    /// 64 random bits (SplitMix64: Steele, Lea, Flood 2014).
    std::uint64_t next() noexcept {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    /// From 0 to below 1.
    double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1p-53; }

    /// A whole number from 0 to below `count` > 0, all equally likely.
    std::size_t below(std::size_t count) noexcept {
        // without this rejection the lowest numbers would be more likely
        const std::uint64_t range = count, rejectedBelow = (0 - range) % range;
        std::uint64_t number = next();
        while (number < rejectedBelow) number = next();
        return static_cast<std::size_t>(number % range);
    }

    /// Standard normal (Box and Muller 1958).
    double normal() noexcept {
        const double radius = std::sqrt(-2.0 * portable::log(1.0 - uniform()));
        return radius * portable::cos(2.0 * std::numbers::pi * uniform());
    }

    bool chance(double probability) noexcept { return uniform() < probability; }

    /// Puts the items in a random order (Fisher and Yates).
    template <class T>
    void shuffle(std::vector<T>& items) noexcept {
        for (std::size_t remaining = items.size(); remaining > 1; --remaining)
            std::swap(items[remaining - 1], items[below(remaining)]);
    }

private:
    std::uint64_t state_;
};

} // namespace physvib
