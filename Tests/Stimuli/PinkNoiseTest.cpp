// SPDX-License-Identifier: MIT
// Equal power in every octave, within full scale, the same again.
#include "Stimuli/PinkNoise.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace physvib {
namespace {

TEST(PinkNoise, HasTheSamePowerInEveryOctave) {
    constexpr int size = 2048, segments = 120;
    PinkNoise noise{3};
    std::vector<double> power(6, 0.0); // octaves 8-16, 16-32, ... 256-512 of 2048 bins
    for (int s = 0; s < segments; ++s) {
        std::vector<double> samples(size);
        for (int n = 0; n < size; ++n)
            samples[std::size_t(n)] =
                noise.next() * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * n / size));
        for (std::size_t octave = 0; octave < power.size(); ++octave)
            for (int k = 0; k < 8; ++k) { // eight bins stand for the octave
                const double bin = 8.0 * std::exp2(static_cast<double>(octave)) * std::exp2((k + 0.5) / 8.0),
                             w = 2.0 * std::numbers::pi * bin / size;
                double re = 0.0, im = 0.0, c = 1.0, si = 0.0;
                const double cw = std::cos(w), sw = std::sin(w);
                for (const double x : samples) {
                    re += x * c;
                    im += x * si;
                    const double next = c * cw - si * sw;
                    si = si * cw + c * sw;
                    c = next;
                }
                power[octave] += (re * re + im * im) * bin; // bins of an octave, as their density falls
            }
    }
    for (const double p : power) EXPECT_NEAR(10.0 * std::log10(p / power[2]), 0.0, 1.5);
}

TEST(PinkNoise, StaysWithinFullScaleAndRepeats) {
    PinkNoise a{7}, b{7}, c{8};
    double sum = 0.0, squares = 0.0;
    bool differs = false;
    for (int n = 0; n < 1'000'000; ++n) {
        const float x = a.next();
        ASSERT_EQ(x, b.next());
        differs |= x != c.next();
        ASSERT_LE(std::abs(x), 1.0f);
        sum += x;
        squares += static_cast<double>(x) * x;
    }
    EXPECT_TRUE(differs);
    EXPECT_NEAR(sum / 1e6, 0.0, 0.05);
    EXPECT_NEAR(std::sqrt(squares / 1e6), 0.14, 0.03);
}

} // namespace
} // namespace physvib
