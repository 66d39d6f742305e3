// SPDX-License-Identifier: MIT
// Polynomials against the C library, over whole turns and octaves.
#include "Core/Trigonometry.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

template <class Real>
double worstPhasorError() {
    std::mt19937_64 random{1};
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const std::uint64_t phase = random();
        const double angle = 2.0 * std::numbers::pi * (static_cast<double>(phase) / 18446744073709551616.0);
        const auto p = unitPhasor<Real>(phase);
        worst = std::max(
            {worst, std::abs(double(p.re) - std::cos(angle)), std::abs(double(p.im) - std::sin(angle))});
    }
    return worst;
}

template <class Real>
double worstDecayError() {
    std::mt19937_64 random{2};
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto octaves = static_cast<std::int64_t>(random() >> 1) - (std::int64_t{1} << 62); // +-64
        const double expected = std::exp2(-static_cast<double>(octaves) / octaveUnit);
        worst = std::max(worst, std::abs(double(decayFactor<Real>(octaves)) / expected - 1.0));
    }
    return worst;
}

TEST(Trigonometry, PhasorIsAccurate) {
    EXPECT_LT(worstPhasorError<double>(), 1e-11);
    EXPECT_LT(worstPhasorError<float>(), 1.2e-7);
}

TEST(Trigonometry, PhasorIsExactAtQuarterTurns) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        const auto p = unitPhasor<double>(static_cast<std::uint64_t>(quarter) << 62);
        EXPECT_EQ(p.re, quarter == 0 ? 1.0 : quarter == 2 ? -1.0 : 0.0);
        EXPECT_EQ(p.im, quarter == 1 ? 1.0 : quarter == 3 ? -1.0 : 0.0);
    }
}

TEST(Trigonometry, DecayIsAccurate) {
    EXPECT_LT(worstDecayError<double>(), 2e-11);
    EXPECT_LT(worstDecayError<float>(), 2e-7);
}

TEST(Trigonometry, DecayIsExactAtWholeOctaves) {
    for (const std::int64_t n : {-55, -1, 0, 1, 23, 120})
        EXPECT_EQ(decayFactor<float>(n * (std::int64_t{1} << octaveFractionBits)),
                  std::exp2(static_cast<float>(-n)));
}

} // namespace
} // namespace physvib
