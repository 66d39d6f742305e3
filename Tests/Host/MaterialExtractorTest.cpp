// SPDX-License-Identifier: GPL-3.0-or-later
// MaterialExtractor: what was put into synthetic hits comes out again; what is no hit is told.
#include "Host/MaterialExtractor.h"
#include "Study/SeededRandom.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace physvib {
namespace {

constexpr double rate = 48000.0;

struct Tone {
    double frequencyHz, decayPerSecond, amplitude = 1.0;
};

/// Eq. 5.1 from a moment between samples on; noise is white, its power so many dB under that of the first tone's start.
std::vector<float> hit(const std::vector<Tone>& tones, double noiseDecibels, std::uint64_t seed, double seconds = 0.8) {
    SeededRandom random{seed};
    const double onset = 0.05 + 0.01 * random.uniform(), noise = std::pow(10.0, noiseDecibels / 20.0) / std::numbers::sqrt2;
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / rate - onset;
        double x = noise * random.normal();
        for (const Tone& tone : tones)
            if (t >= 0.0) x += tone.amplitude * std::sin(2.0 * std::numbers::pi * tone.frequencyHz * t) * std::exp(-tone.decayPerSecond * t);
        samples[i] = static_cast<float>(0.5 * x);
    }
    return samples;
}

constexpr double clean = -300.0, noisy = -20.0;

/// A hit of the ratios of a circular membrane's first modes, the lowest being the strongest and the longest.
std::vector<Tone> threePartials(double frequencyHz, double decayPerSecond) {
    return {{frequencyHz, decayPerSecond}, {1.59 * frequencyHz, 1.7 * decayPerSecond, 0.6}, {2.14 * frequencyHz, 2.3 * decayPerSecond, 0.5}};
}

void expectFound(const std::vector<Tone>& tones, double noise, double frequencyBar, double decayBar, std::uint64_t seed = 1) {
    const auto found = extractMaterial(hit(tones, noise, seed), rate);
    ASSERT_TRUE(found) << found.error;
    const Tone& wanted = tones.front();
    const auto where = testing::Message() << wanted.frequencyHz << " Hz, " << wanted.decayPerSecond << " /s, " << tones.size() << " partials";
    EXPECT_NEAR(found.value.frequencyHz / wanted.frequencyHz, 1.0, frequencyBar) << where;
    EXPECT_NEAR(found.value.decayPerSecond / wanted.decayPerSecond, 1.0, decayBar) << where;
}

TEST(MaterialExtractor, CleanHitsWithinATwentiethOfAPercentAndHalfAPercent) {
    for (const Tone& tone : {Tone{40, 5}, {40, 150}, {80, 34.13}, {349, 106.99}, {430, 11.97}, {900, 150}}) expectFound({tone}, clean, 0.0005, 0.005);
    for (const auto& [f, tau] : {std::pair{40.0, 12.0}, {205.0, 34.0}, {430.0, 150.0}}) expectFound(threePartials(f, tau), clean, 0.0005, 0.005);
}

TEST(MaterialExtractor, NoisyHitsWithinHalfAPercentAndFivePercent) {
    for (const Tone& tone : {Tone{40, 5}, {40, 34}, {80, 34.13}, {205, 150}, {349, 106.99}, {430, 11.97}, {900, 150}})
        for (const std::uint64_t seed : {1u, 2u}) {
            expectFound({tone}, noisy, 0.005, 0.05, seed);
            expectFound(threePartials(tone.frequencyHz, tone.decayPerSecond), noisy, 0.005, 0.05, seed);
        }
}

// 40 Hz that falls by 150 /s is over within a period: no estimator that does not know the phase beats the bound.
TEST(MaterialExtractor, WhereNoiseLeavesTooLittleTheBoundIsKeptAndTold) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        const auto found = extractMaterial(hit({{40, 150}}, noisy, seed), rate);
        ASSERT_TRUE(found) << found.error;
        EXPECT_GT(found.value.frequencyErrorHz, 0.005 * 40);
        EXPECT_NEAR(found.value.frequencyHz, 40, 4 * found.value.frequencyErrorHz);
        EXPECT_NEAR(found.value.decayPerSecond, 150, 4 * found.value.decayErrorPerSecond);
        EXPECT_FALSE(found.value.isConfident());
    }
    EXPECT_TRUE(extractMaterial(hit({{430, 12}}, noisy, 1), rate).value.isConfident());
}

TEST(MaterialExtractor, TheBandSaysWhichPartialIsTaken) {
    const auto samples = hit({{150, 30}, {700, 40, 0.8}}, noisy, 1);
    EXPECT_NEAR(extractMaterial(samples, rate, {90, 300}).value.frequencyHz, 150, 0.75);
    EXPECT_NEAR(extractMaterial(samples, rate, {300, 1000}).value.frequencyHz, 700, 3.5);
    EXPECT_NE(extractMaterial(samples, rate, {300, 500}).error.find("expected a decaying sound from 300 to 500 Hz, found none"), std::string::npos);
}

TEST(MaterialExtractor, AHumIsNoMaterial) {
    auto samples = hit({{430, 60}}, noisy, 1);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] += static_cast<float>(0.05 * std::sin(2.0 * std::numbers::pi * 50.0 * static_cast<double>(i) / rate));
    const auto found = extractMaterial(samples, rate);
    ASSERT_TRUE(found) << found.error;
    EXPECT_NEAR(found.value.frequencyHz, 430, 2.15);
    EXPECT_NEAR(found.value.decayPerSecond, 60, 3);
}

TEST(MaterialExtractor, TheNextHitDoesNotCount) {
    auto samples = hit({{205, 60}}, noisy, 1);
    const auto next = hit({{205, 60, 0.7}}, clean, 2, 0.5);
    for (std::size_t i = 0; i < next.size(); ++i) samples[i + 10000] += next[i];
    const auto found = extractMaterial(samples, rate);
    ASSERT_TRUE(found) << found.error;
    EXPECT_LT(found.value.lengthSeconds, 0.3);
    EXPECT_NEAR(found.value.decayPerSecond, 60, 3);
}

TEST(MaterialExtractor, TwoPeaksAreTheThesisRule) {
    for (const Tone& tone : {Tone{80, 34.13}, {349, 106.99}, {430, 11.97}}) {
        const auto found = extractMaterial(hit({tone}, clean, 1), rate, {}, MaterialRule::twoPeaks);
        ASSERT_TRUE(found) << found.error;
        EXPECT_NEAR(found.value.decayPerSecond / tone.decayPerSecond, 1.0, 0.01);
        EXPECT_NEAR(found.value.frequencyHz / tone.frequencyHz, 1.0, 0.003) << "a decaying sine's spectrum peaks a little lower";
        EXPECT_FALSE(found.value.isConfident()) << "two samples tell no error";
    }
}

TEST(MaterialExtractor, WhatIsNoHitIsTold) {
    const auto expectFault = [](std::vector<float> samples, const std::string& words) {
        for (const auto rule : {MaterialRule::fit, MaterialRule::twoPeaks}) EXPECT_NE(extractMaterial(samples, rate, {}, rule).error.find(words), std::string::npos) << words;
    };
    expectFault({}, "expected at least 0.01 s, found 0 samples");
    expectFault({0.5f}, "expected at least 0.01 s, found 1 sample");
    expectFault(std::vector<float>(48000), "found silence");
    expectFault(std::vector<float>(48000, 0.25f), "found silence");
    auto samples = hit({{205, 30}}, noisy, 1);
    samples[4000] = std::numeric_limits<float>::quiet_NaN();
    expectFault(samples, "expected finite samples, found NaN at 0.0833 s");
    samples[4000] = std::numeric_limits<float>::infinity();
    expectFault(samples, "found infinity");
    samples = hit({{205, 30}}, noisy, 1);
    for (float& x : samples) x = std::clamp(x, -0.3f, 0.3f);
    expectFault(samples, "equal samples at its peak at 0.05");
    EXPECT_NE(extractMaterial(hit({}, noisy, 1), rate).error.find("found none"), std::string::npos) << "noise alone";
    EXPECT_NE(extractMaterial(samples, 1000).error.find("below half the rate"), std::string::npos);
}

TEST(MaterialExtractor, RoundedPeaksAreNotClipped) {
    auto samples = hit({{40, 5}}, clean, 1);
    for (float& x : samples) x = std::round(x * 2048.0f) / 2048.0f; // 12 bits: a peak is flat for several samples
    const auto found = extractMaterial(samples, rate);
    ASSERT_TRUE(found) << found.error;
    EXPECT_NEAR(found.value.frequencyHz, 40, 0.02);
}

} // namespace
} // namespace physvib
