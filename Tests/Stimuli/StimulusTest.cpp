// SPDX-License-Identifier: MIT
// Patterns and phantoms as the engine renders them: frames, enchanters, gains.
#include "Stimuli/Stimulus.h"
#include "Stimuli/PinkNoise.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace physvib::stimulus_test {

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
                    if (j != pattern.actuators[std::size_t(k)]) {
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
    ActuatorLayout layout;
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

// Equal power in every octave, within full scale, the same again.

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

// The number, the order, the distinctness, the length and the labels of the thesis' spatiotemporal patterns
// (3.2).

TEST(PulsePattern, CountsAreThoseOfTheThesisNoTwoAreAlikeAndAllStayOnTheirEnchanters) {
    EXPECT_EQ(allPulsePatterns(2).size(), 28u);
    EXPECT_EQ(allPulsePatterns(3).size(), 78u);
    EXPECT_EQ(allPulsePatterns(4).size(), 168u);
    const auto patterns = allPulsePatterns(4);
    for (auto p = patterns.begin(); p != patterns.end(); ++p) {
        EXPECT_EQ(std::count(patterns.begin(), patterns.end(), *p), 1);
        EXPECT_TRUE(
            std::all_of(p->actuators.begin(), p->actuators.end(), [](int e) { return e >= 0 && e < 4; }));
    }
}

TEST(PulsePattern, TheLongestLasts950Milliseconds) {
    double longest = 0;
    for (const auto& p : allPulsePatterns(2)) // from the first onset to the last end
        longest = std::max(longest, p.count * p.pulseSeconds + (p.count - 1) * pulseGapSeconds);
    EXPECT_NEAR(longest, 0.95, 1e-12);
}

TEST(PulsePattern, AreOrderedByDurationThenCountThenActuators) {
    std::vector<std::string> labels;
    for (const PulsePattern& p : allPulsePatterns(2)) labels.push_back(patternLabel(p));
    labels.resize(15);
    EXPECT_EQ(labels, (std::vector<std::string>{"A-100", "B-100", "AA-100", "AB-100", "BA-100", "BB-100",
                                                "AAA-100", "AAB-100", "ABA-100", "ABB-100", "BAA-100",
                                                "BAB-100", "BBA-100", "BBB-100", "A-250"}));
}

TEST(PulsePattern, LabelsOfAllDurationsAndLettersAreReadBack) {
    for (int ms = 1; ms <= 10000; ++ms) {
        const std::string label = "A-" + std::to_string(ms);
        const auto pattern = parsePatternLabel(label);
        ASSERT_TRUE(pattern) << label;
        ASSERT_EQ(patternLabel(*pattern), label);
    }
    for (const PulsePattern& pattern : allPulsePatterns(4))
        EXPECT_EQ(parsePatternLabel(patternLabel(pattern)), pattern) << patternLabel(pattern);
    EXPECT_EQ(patternLabel({0.25, 3, {0, 1, 0}}), "ABA-250");
    for (const char* bad :
         {"", "A", "-100", "ABCD-100", "a-100", "A-0", "A-100 ", "A-10001", "A-99999", "A100"})
        EXPECT_FALSE(parsePatternLabel(bad)) << bad;
    const auto wide = parsePatternLabel("YZ-100");
    ASSERT_TRUE(wide);
    EXPECT_EQ(wide->actuators, (std::array<int, 3>{24, 25, 0}));
}

} // namespace physvib::stimulus_test
