// SPDX-License-Identifier: MIT
// Strikes as lines: how near, how few, and what is merged.
#include "Formats/StrikeClip.h"
#include "ClipTesting.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;

constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();

double farthestFrom(const std::vector<ClipPoint>& curve, double amplitude, double decayPerSecond,
                    double seconds) {
    double most = 0.0;
    for (int n = 0; n < 20000; ++n) {
        const double t = seconds * n / 20000;
        most = std::max(most, std::abs(valueAt(curve, t) - amplitude * std::exp(-decayPerSecond * t)));
    }
    return most;
}

TEST(DecayCurve, ChordsKeepWithinTheirErrorAndEndAtNothing) {
    for (const double error : {0.05, 0.004, 0.001, 1e-4})
        for (const double decay : {0.5, 30.0, 800.0}) {
            const auto curve = decayCurve(0.7, decay, forever, error, rateHz);
            const double slack = 0.7 * decay / rateHz; // a point lies on a tick
            EXPECT_LE(farthestFrom(curve, 0.7, decay, 12.0 / decay),
                      0.7 * error + std::min(slack, 0.7 * 0.2 * error))
                << error << ' ' << decay;
            EXPECT_EQ(curve.back().value, 0.0);
        }
}

TEST(DecayCurve, TakesADozenPointsForTheUsualError) {
    EXPECT_LE(decayCurve(1.0, 30.0, forever, 0.004, rateHz).size(), 14u);
    EXPECT_LE(decayCurve(1.0, 30.0, forever, 0.001, rateHz).size(), 27u);
}

TEST(DecayCurve, LiesOnTheExponentialWhereItIsCutOff) {
    for (const std::int64_t end : {1, 100, 4800, 8000}) {
        const auto curve = decayCurve(1.0, 30.0, end, 0.004, rateHz);
        const double seconds = static_cast<double>(end) / rateHz;
        EXPECT_DOUBLE_EQ(curve.back().seconds, seconds);
        EXPECT_NEAR(curve.back().value, std::exp(-30.0 * seconds), 1e-12);
        EXPECT_LE(farthestFrom(curve, 1.0, 30.0, seconds), 0.0041);
    }
}

TEST(StrikeClip, SoundsAsTheClosedFormDoes) {
    const auto events = hits(60);
    double last = 1.0;
    for (const double error : {0.004, 0.001, 1e-5}) {
        const SampledSound sound = clipSound(clipOf(events, error), rateHz);
        const double found = farthest(sound.channels, closedForm(events, sound.channels.front().size()));
        EXPECT_LE(found, 0.44 * error + 1e-6) << error; // two modes of at most 0.22 ring at once
        EXPECT_LT(found, last);
        last = found;
    }
}

TEST(StrikeClip, HasOneWaveOfAModeAtATime) {
    const Clip clip = clipOf(hits(60), 0.004);
    ASSERT_EQ(clip.channels.size(), 4u);
    EXPECT_EQ(clipFault(clip), "");
    for (const ClipChannel& channel : clip.channels) {
        EXPECT_LE(channel.bands.size(), 2u); // two modes
        for (const ClipBand& band : channel.bands)
            for (std::size_t i = 0; i + 1 < band.waves.size(); ++i)
                EXPECT_LE(band.waves[i].endSeconds(), band.waves[i + 1].startSeconds + 1e-9);
    }
}

TEST(StrikeClip, LeavesNothingBehindACut) {
    CollisionEvent cut{1'000'000, 200.0, 0.0, 0.5, 0.5, 0.5, 20'000'000};
    const Clip clip = clipOf({&cut, 1}, 0.004);
    ASSERT_EQ(clip.channels[0].bands.size(), 1u);
    ASSERT_EQ(clip.channels[0].bands[0].waves.size(), 1u);
    EXPECT_EQ(clip.channels[0].bands[0].waves[0].amplitude.size(), 2u);
    EXPECT_NEAR(clip.seconds(), 0.021, 1.0 / rateHz);
}

TEST(StrikeClip, LeavesOutWhatAnEnchanterDoesNotGet) {
    CollisionEvent corner{0, 200.0, 40.0, 0.5, 0.0, 1.0};
    const Clip clip = clipOf({&corner, 1}, 0.004);
    EXPECT_EQ(clip.channels[0].bands.size(), 1u);
    for (std::size_t j = 1; j < 4; ++j) EXPECT_TRUE(clip.channels[j].bands.empty());
}

TEST(ClipSound, PlaysEveryWaveform) {
    constexpr double expected[5][4] = {{0.0, 1.0, 0.0, -1.0},
                                       {1.0, 1.0, -1.0, -1.0},
                                       {0.0, 1.0, 0.0, -1.0},
                                       {0.0, 0.5, -1.0, -0.5},
                                       {0.0, -0.5, 1.0, 0.5}};
    for (int w = 0; w < 5; ++w) {
        Clip clip{
            "",
            0,
            0,
            {ClipChannel{
                "A",
                {},
                {},
                {{{ClipWave{
                    0.0, 0.0, static_cast<ClipWaveform>(w), {{0.0, 1.0}, {1.0, 1.0}}, {{0.0, 1000.0}}}}}},
                {}}}};
        const auto sound = clipSound(clip, 4000);
        for (std::size_t n = 0; n < 4; ++n)
            EXPECT_NEAR(sound.channels[0][n], expected[w][n], 1e-6) << w << ' ' << n;
    }
}

TEST(ClipSound, FollowsAFrequencyThatGlides) {
    Clip clip{
        "",
        0,
        0,
        {ClipChannel{"A",
                     {},
                     {},
                     {{{ClipWave{0.25, 0.5, {}, {{0.0, 1.0}, {1.0, 0.5}}, {{0.1, 100.0}, {0.6, 300.0}}}}}},
                     {}}}};
    const auto sound = clipSound(clip, 8000);
    const auto phase = [](double t) { // 100 Hz, a glide of 400 Hz per second, 300 Hz
        const double glide = std::clamp(t - 0.1, 0.0, 0.5);
        return 0.5 +
               2.0 * std::numbers::pi * (100.0 * t + 200.0 * glide * glide + 200.0 * std::max(0.0, t - 0.6));
    };
    for (std::size_t n = 2000; n < 10000; n += 37) {
        const double t = static_cast<double>(n) / 8000 - 0.25;
        EXPECT_NEAR(sound.channels[0][n], (1.0 - 0.5 * t) * std::sin(phase(t)), 1e-6) << n;
    }
}

} // namespace
} // namespace physvib
