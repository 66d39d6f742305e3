// SPDX-License-Identifier: MIT
// The error that a fit states of itself, for noise of three colours and equal power: never below what white
// noise would make.
#include "Measure/HitBound.h"
#include "Measure/HitFit.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

constexpr double rate = 8000.0, noisePower = 0.02; // standard deviation per sample

/// Noise of that power; `colour` -1: blue, differences; 0: white; 1: red, of 300 Hz and below.
std::vector<double> noiseOf(int colour, std::size_t count, std::uint64_t seed) {
    SeededRandom random{seed};
    std::vector<double> noise(count);
    double last = 0.0, power = 0.0;
    for (double& x : noise) {
        const double now = random.normal();
        x = colour == 0 ? now : colour < 0 ? now - last : 0.9 * last + now;
        last = colour > 0 ? x : now;
        power += x * x;
    }
    for (double& x : noise) x *= noisePower / std::sqrt(power / static_cast<double>(count));
    return noise;
}

TEST(StatedErrors, AreNeverBelowThoseOfWhiteNoise) {
    for (const double frequencyHz : {150.0})
        for (const double decay : {15.0, 40.0}) {
            const auto bound = test::boundOf({{frequencyHz, decay}}, noisePower, rate, 0.5);
            for (const int colour : {-1, 0, 1})
                for (std::uint64_t seed = 1; seed <= 1; ++seed) {
                    std::vector<double> samples = noiseOf(colour, 4000, seed);
                    for (std::size_t i = 0; i < samples.size(); ++i) {
                        const double t = static_cast<double>(i) / rate;
                        samples[i] +=
                            std::exp(-decay * t) * std::sin(2.0 * std::numbers::pi * frequencyHz * t);
                    }
                    const HitFit fit{std::move(samples), 0, rate};
                    const auto partials = fit.partials();
                    ASSERT_FALSE(partials.empty());
                    const double omega = 2.0 * std::numbers::pi * frequencyHz;
                    const auto nearest = std::ranges::min_element(
                        partials, {}, [=](const Partial& p) { return std::abs(p.omega - omega); });
                    const auto error =
                        fit.errorOf(static_cast<std::size_t>(nearest - partials.begin())).omega / omega;
                    EXPECT_GT(error, 0.6 * bound.frequency) << "colour " << colour << ", seed " << seed;
                    if (colour == 0) EXPECT_LT(error, 2.0 * bound.frequency) << "white, seed " << seed;
                }
        }
}

} // namespace
} // namespace physvib
