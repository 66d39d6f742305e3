// SPDX-License-Identifier: MIT
// Sine, cosine and powers of two from integer phases, with the same bits on every machine, in float or
// double. C libraries differ in the last place; polynomials in a fixed order do not.
#pragma once
#include <bit>
#include <cstdint>
#include <numbers>
#include <type_traits>

namespace physvib {

/// A complex number without the NaN rules of std::complex, which cost a library call per product.
template <class Real>
struct Complex {
    Real re{};
    Real im{};
    friend constexpr Complex operator*(Complex a, Complex b) noexcept {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend constexpr Complex operator*(Complex a, Real s) noexcept { return {a.re * s, a.im * s}; }
    Complex& operator+=(Complex b) noexcept { return *this = {re + b.re, im + b.im}; }
    Complex& operator-=(Complex b) noexcept { return *this = {re - b.re, im - b.im}; }
};

/// exp(2 pi i phase / 2^64). Error: 1e-11 in double, 1e-7 in float (Taylor series on an eighth of a turn).
template <class Real>
constexpr Complex<Real> unitPhasor(std::uint64_t phase) noexcept {
    const std::uint64_t quadrant = (phase + (std::uint64_t{1} << 61)) >> 62;
    // at most an eighth of a turn either way
    const auto remainder = static_cast<std::int64_t>(phase - (quadrant << 62));
    const Real x = static_cast<Real>(static_cast<double>(2.0 * std::numbers::pi / 18446744073709551616.0)) *
                   static_cast<Real>(remainder);
    const Real q = x * x;
    constexpr auto over = [](int n) { return static_cast<Real>(1.0 / n); };
    const Real sine =
        x * (1 - q * over(6) *
                     (1 - q * over(20) * (1 - q * over(42) * (1 - q * over(72) * (1 - q * over(110))))));
    const Real cosine =
        1 - q * over(2) *
                (1 - q * over(12) *
                         (1 - q * over(30) * (1 - q * over(56) * (1 - q * over(90) * (1 - q * over(132))))));
    // Phases are practically random: a branch on the quadrant would be mispredicted three times of four.
    using Bits = std::conditional_t<std::is_same_v<Real, double>, std::uint64_t, std::uint32_t>;
    constexpr int sign = 8 * static_cast<int>(sizeof(Bits)) - 1;
    const auto isOdd = static_cast<Bits>(0) - static_cast<Bits>(quadrant & 1);
    const auto c = std::bit_cast<Bits>(cosine),
               swapped = static_cast<Bits>((c ^ std::bit_cast<Bits>(sine)) & isOdd);
    // 1: that component is negative
    const auto re = static_cast<Bits>((quadrant + 1) >> 1 & 1), im = static_cast<Bits>(quadrant >> 1 & 1);
    return {std::bit_cast<Real>(static_cast<Bits>((c ^ swapped) ^ re << sign)),
            std::bit_cast<Real>(static_cast<Bits>((std::bit_cast<Bits>(sine) ^ swapped) ^ im << sign))};
}

/// Decays are counted in octaves (halvings) as signed fixed point with 56 fractional bits: +-128 octaves.
constexpr int octaveFractionBits = 56;
constexpr double octaveUnit = 72057594037927936.0; // 2^56

/// 2^-octaves. Relative error: 1e-11 in double, 1e-7 in float. At most 126 octaves either way.
template <class Real>
constexpr Real decayFactor(std::int64_t octaves) noexcept {
    const std::int64_t halvings =
        (octaves + (std::int64_t{1} << (octaveFractionBits - 1))) >> octaveFractionBits;
    const std::int64_t remainder = octaves - halvings * (std::int64_t{1} << octaveFractionBits);
    const Real x = static_cast<Real>(-std::numbers::ln2 / octaveUnit) * static_cast<Real>(remainder);
    constexpr auto over = [](int n) { return static_cast<Real>(1.0 / n); };
    const Real power =
        1 +
        x * (1 + x * over(2) *
                     (1 + x * over(3) *
                              (1 + x * over(4) *
                                       (1 + x * over(5) *
                                                (1 + x * over(6) *
                                                         (1 + x * over(7) *
                                                                  (1 + x * over(8) * (1 + x * over(9)))))))));
    if constexpr (std::is_same_v<Real, double>)
        return power * std::bit_cast<double>(static_cast<std::uint64_t>(1023 - halvings) << 52);
    else
        return power * std::bit_cast<float>(static_cast<std::uint32_t>(127 - halvings) << 23);
}

} // namespace physvib
