// SPDX-License-Identifier: MIT
// Patterns and phantoms as the engine renders them: frames, enchanters, gains.
#include "Stimuli/Stimulus.h"
#include "Support/Rendering.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

test::Channels render(const Stimulus& stimulus, int rate, double extraSeconds = 0.05) {
    const int frames = static_cast<int>(std::lround((stimulus.seconds + extraSeconds) * rate));
    return test::renderEvents(stimulus.events, {rate, stimulus.panner.channels(), stimulus.panner, false},
                              frames)
        .channels;
}

/// First and one past the last frame that is not silent, from `from` on; equal if all are.
std::pair<int, int> soundFrom(const std::vector<float>& samples, int from, int to) {
    while (from < to && std::abs(samples[std::size_t(from)]) < 1e-9f) ++from;
    while (to > from && std::abs(samples[std::size_t(to - 1)]) < 1e-9f) --to;
    return {from, to};
}

TEST(Stimulus, EveryPulseOfEveryPatternStartsAndEndsOnItsFrame) {
    for (const int rate : {48000, 44100, 8000})
        for (const PulsePattern& pattern : allPulsePatterns(rate == 48000 ? 4 : 2)) {
            const int enchanters = rate == 48000 ? 4 : 2;
            const auto channels = render(patternStimulus(pattern, enchanters, {205.0, 0.8}), rate);
            const int pulse = static_cast<int>(std::lround(pattern.pulseSeconds * rate)),
                      period = pulse + rate / 10;
            for (int k = 0; k < pattern.count; ++k)
                for (int j = 0; j < enchanters; ++j) {
                    const auto [first, end] = soundFrom(
                        channels[std::size_t(j)], std::max(0, k * period - 100), k * period + pulse + 100);
                    if (j != pattern.enchanters[std::size_t(k)]) {
                        EXPECT_EQ(first, end) << patternLabel(pattern) << " pulse " << k << " on " << j;
                        continue;
                    }
                    // the sine is zero on its first frame
                    EXPECT_EQ(first, k * period + 1) << patternLabel(pattern);
                    // and may be on its last
                    EXPECT_NEAR(end, k * period + pulse, 1) << patternLabel(pattern);
                    EXPECT_LE(end, k * period + pulse);
                }
        }
}

TEST(Stimulus, PatternsAreSinesOfTheirLevelToTheSample) {
    const int rate = 48000;
    const auto channels = render(patternStimulus({0.25, 2, {1, 0}}, 3, {205.0, 0.5}), rate);
    double worst = 0.0;
    for (int n = 0; n < rate / 4; ++n)
        for (const auto& [channel, start] : {std::pair{1, 0}, {0, rate * 35 / 100}}) {
            const double expected = 0.5 * std::sin(2.0 * std::numbers::pi * 205.0 * n / rate);
            worst =
                std::max(worst, std::abs(channels[std::size_t(channel)][std::size_t(start + n)] - expected));
        }
    EXPECT_LE(worst, 1e-6);
}

TEST(Stimulus, PulsesStayOnOneEnchanterInEveryNumberOfThem) {
    for (int count = 1; count <= 12; ++count)
        for (int j = 0; j < count; ++j) {
            const auto stimulus = patternStimulus({0.1, 1, {j, 0, 0}}, count, {});
            PhantomPanner::Gains gains{};
            stimulus.panner.gainsAt(stimulus.events[0].x, stimulus.events[0].y, gains);
            for (int other = 0; other < count; ++other)
                EXPECT_NEAR(gains[std::size_t(other)], other == j ? 1.0 : 0.0, 3e-13) << count;
        }
}

TEST(Stimulus, PhantomsFollowTheLawAtEveryPointOfTheGrid) {
    EnchanterLayout layout;
    ASSERT_TRUE(layoutPreset("phone4", layout));
    for (const int lines : {3, 4, 5, 7})
        for (int point = 0; point < lines * lines; ++point) {
            const FieldPlace place{static_cast<double>(point % lines) / (lines - 1),
                                   static_cast<double>(point / lines) / (lines - 1)};
            const auto stimulus = phantomStimulus(place, layout, PanningLaw::linear, 1.0, {205.0, 1.0}, 0.02);
            const auto channels = render(stimulus, 48000, 0.0);
            // Eq. 4.2, A upper left
            const double gains[] = {(1 - place.x) * (1 - place.y), place.x * (1 - place.y),
                                    (1 - place.x) * place.y, place.x * place.y};
            for (std::size_t j = 0; j < 4; ++j)
                for (const std::size_t n : {59u, 300u, 959u})
                    EXPECT_NEAR(channels[j][n],
                                gains[j] *
                                    std::sin(2.0 * std::numbers::pi * 205.0 * static_cast<double>(n) / 48000),
                                1e-6)
                        << point;
        }
}

TEST(Stimulus, CentreLevelsOfTheLaws) {
    EnchanterLayout layout;
    ASSERT_TRUE(layoutPreset("ring4", layout));
    const auto centre = [&](PanningLaw law) {
        const auto stimulus = phantomStimulus({0.5, 0.5}, layout, law, 1.0, {});
        PhantomPanner::Gains gains{};
        stimulus.panner.gainsAt(stimulus.events[0].x, stimulus.events[0].y, gains);
        double power = 0.0;
        for (std::size_t j = 0; j < 4; ++j) power += gains[j] * gains[j];
        return 10.0 * std::log10(power);
    };
    EXPECT_NEAR(centre(PanningLaw::linear), -6.0, 0.05);
    EXPECT_NEAR(centre(PanningLaw::log), -9.3, 0.05);
    EXPECT_NEAR(centre(PanningLaw::energy), 0.0, 0.05);
}

TEST(PulsePattern, LabelsAreReadBack) {
    for (const PulsePattern& pattern : allPulsePatterns(4))
        EXPECT_EQ(parsePatternLabel(patternLabel(pattern)), pattern) << patternLabel(pattern);
    EXPECT_EQ(patternLabel({0.25, 3, {0, 1, 0}}), "ABA-250");
    for (const char* bad : {"", "A", "-100", "ABCD-100", "a-100", "A-0", "A-100 ", "A-99999", "A100"})
        EXPECT_FALSE(parsePatternLabel(bad)) << bad;
}

} // namespace
} // namespace physvib
