// SPDX-License-Identifier: MIT
// What is taken away of samples that are to be felt, and what is left as it is.
#include "Measure/HitExcerpt.h"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace physvib {
namespace {

constexpr double rate = 8000.0;

template <class Course>
std::vector<float> samplesOf(double seconds, Course course) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] = static_cast<float>(course(static_cast<double>(n) / rate));
    return samples;
}
double sine(double hz, double t) { return std::sin(2.0 * std::numbers::pi * hz * t); }

double peakBetween(const std::vector<float>& samples, double from, double to) {
    double most = 0.0;
    for (auto n = static_cast<std::size_t>(from * rate); n < static_cast<std::size_t>(to * rate); ++n)
        most = std::max(most, std::abs(double{samples[n]}));
    return most;
}

TEST(SlowPart, AConstantBecomesSilence) {
    auto samples = samplesOf(10.0, [](double) { return 1.0; });
    const auto taken = takeSlowPart(samples, rate);
    EXPECT_EQ(taken.mean, 1.0);
    EXPECT_EQ(taken.rest, 0.0);
    EXPECT_EQ(peakBetween(samples, 0.0, 10.0), 0.0);
    EXPECT_EQ(taken.text(), "what lies below 5 Hz is not played: a mean of 1.00, of full scale");
}

TEST(SlowPart, ATonesOffsetGoesAndTheToneStays) {
    auto samples = samplesOf(2.0, [](double t) { return 0.5 * sine(205.0, t) - 0.25; });
    EXPECT_NEAR(takeSlowPart(samples, rate).mean, 0.25, 1e-3);
    for (std::size_t n = 0; n < samples.size(); ++n)
        ASSERT_NEAR(samples[n], 0.5 * sine(205.0, static_cast<double>(n) / rate), 1e-3);
}

TEST(SlowPart, WhatIsFeltStaysToTheBit) {
    for (const double hz : {20.0, 50.0, 65.0, 205.0, 1000.0})
        for (const double decay : {0.0, 12.0, 30.0, 107.0}) {
            const auto before = samplesOf(hz < 50.0 && decay > 0.0 ? 4.0 : 1.0,
                                          [&](double t) { return sine(hz, t) * std::exp(-decay * t); });
            auto samples = before;
            EXPECT_FALSE(takeSlowPart(samples, rate).isAny()) << hz << ' ' << decay;
            EXPECT_EQ(samples, before) << hz << ' ' << decay;
        }
    const auto knock = samplesOf(0.19, [](double) { return 1.0; });
    auto samples = knock;
    EXPECT_FALSE(takeSlowPart(samples, rate).isAny()) << "shorter than a period of 5 Hz";
    EXPECT_EQ(samples, knock);
}

TEST(SlowPart, WhatChangesSlowlyGoesAsFarAsItsFrequencySays) {
    for (const auto& [hz, left] :
         {std::pair{0.5, 0.01}, {1.0, 0.033}, {2.0, 0.126}, {3.0, 0.265}, {4.0, 0.43}, {5.0, 0.6}}) {
        auto samples = samplesOf(10.0, [hz = hz](double t) { return sine(hz, t); });
        EXPECT_GT(takeSlowPart(samples, rate).rest, 0.39) << hz;
        EXPECT_NEAR(peakBetween(samples, 1.0, 9.0), left, 0.01) << hz;
    }
    // its mean is zero
    auto steps = samplesOf(10.0, [](double t) { return (t < 5.0 ? 1.0 : -1.0) + 0.1 * sine(205.0, t); });
    EXPECT_GT(takeSlowPart(steps, rate).rest, 0.99);
    EXPECT_NEAR(peakBetween(steps, 0.2, 4.8), 0.1, 0.01);
    // a sixth of it is its mean
    auto burst = samplesOf(60.0, [](double t) { return t > 20.0 && t < 30.0 ? 1.0 : 0.0; });
    const auto taken = takeSlowPart(burst, rate);
    EXPECT_NEAR(taken.mean, 1.0 / 6.0, 1e-3);
    EXPECT_EQ(taken.text().substr(0, 83),
              "what lies below 5 Hz is not played: a mean of 0.17, and up to 0.83 beside it, of fu");
    EXPECT_LT(peakBetween(burst, 20.2, 29.8), 0.001);
}

TEST(SlowPart, IsAShareOfWhatIsPlayedAsFullScale) {
    for (const double fullScale : {1e-6, 0.02, 1e30}) {
        auto samples = samplesOf(1.0, [=](double t) { return fullScale * (0.5 + 0.5 * sine(205.0, t)); });
        EXPECT_NEAR(takeSlowPart(samples, rate, fullScale).mean, 0.5, 1e-3) << fullScale;
        EXPECT_NEAR(peakBetween(samples, 0.0, 1.0) / fullScale, 0.5, 1e-3) << fullScale;
    }
    std::vector<float> silence(8000, 0.0f);
    EXPECT_FALSE(takeSlowPart(silence, rate, 0.0).isAny());
}

TEST(SlowPart, NothingHidesBehindWhatIsNoNumber) {
    for (const float hider : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::max()}) {
        auto samples = samplesOf(10.0, [](double t) { return t < 5.0 ? 1.0 : -1.0; });
        samples[0] = hider;
        EXPECT_TRUE(takeSlowPart(samples, rate).isAny());
        EXPECT_LT(peakBetween(samples, 1.0, 4.8), 0.02) << hider;
    }
}

} // namespace
} // namespace physvib
