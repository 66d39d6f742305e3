// SPDX-License-Identifier: MIT
// Psychometric functions against R's glm and simulated observers, intervals by how often they hold.
#include "Lab/Study/Psychometric.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace physvib::psychometric_test {

constexpr PsychometricShape shapes[] = {PsychometricShape::logistic, PsychometricShape::normal,
                                        PsychometricShape::weibull};

TEST(Psychometric, ThresholdAndWidthMeanTheSameForEveryShape) {
    for (const auto shape : shapes) {
        const PsychometricFunction f{shape, 3.0, 4.0, 0.5, 0.02};
        EXPECT_NEAR(f.probability(3.0), 0.5 + 0.48 * 0.5, 1e-12);
        EXPECT_NEAR(f.levelAt(0.5 + 0.48 * 0.95) - f.levelAt(0.5 + 0.48 * 0.05), 4.0, 1e-9);
        EXPECT_NEAR(f.probability(f.levelAt(0.8)), 0.8, 1e-12);
        EXPECT_NEAR(f.jnd(), 0.5 * (f.levelAt(0.5 + 0.48 * 0.75) - f.levelAt(0.5 + 0.48 * 0.25)), 1e-9);
    }
}

TEST(Psychometric, WithoutGuessesItIsTheModelOfRsGlm) {
    const std::vector<LevelCount> counts{{-6, 3, 30}, {-3, 8, 30}, {0, 14, 30}, {3, 25, 30}, {6, 29, 30}};
    const double thresholds[] = {-0.429167327062, -0.465371305764, 0.0806596061844},
                 widths[] = {13.441199548498, 12.836988906085, 14.1962160473825};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto fit = fitPsychometric(counts, {shapes[i], 0.0, 0.0});
        ASSERT_EQ(fit.error, "");
        EXPECT_NEAR(fit.function.threshold, thresholds[i], 1e-4);
        EXPECT_NEAR(fit.function.width, widths[i], 1e-3);
    }
    const std::vector<LevelCount> lapsing{{-4, 1, 40}, {-2, 8, 40}, {0, 20, 40}, {2, 32, 40}, {4, 39, 40}};
    EXPECT_NEAR(fitPsychometric(lapsing, {shapes[0], 0.0}).function.threshold, 0.0, 1e-3) << "both ends";
}

/// Trials of a two-alternative choice at eight levels.
std::vector<LevelCount> observed(const PsychometricFunction& truth, std::uint64_t each,
                                 SeededRandom& random) {
    std::vector<LevelCount> counts;
    for (int i = 0; i < 8; ++i) {
        LevelCount count{truth.threshold + truth.width * (0.25 * i - 0.8), 0, each};
        for (std::uint64_t t = 0; t < each; ++t) count.hits += random.chance(truth.probability(count.level));
        counts.push_back(count);
    }
    return counts;
}

TEST(Psychometric, WhatCannotBeFittedIsNamed) {
    EXPECT_EQ(fitPsychometric({}, {shapes[0]}).error, "expected trials, found none");
    const std::vector<LevelCount> one{{2, 3, 5}}, flat{{1, 5, 5}, {2, 7, 7}};
    EXPECT_EQ(fitPsychometric(one, {shapes[0]}).error, "expected trials at two or more levels, found one");
    EXPECT_EQ(fitPsychometric(flat, {shapes[0]}).error,
              "expected answers that change with the level, found the same share at every one");
    EXPECT_NE(fitPsychometric(std::vector<LevelCount>{{1, 5, 5}, {2, 0, 5}}, {shapes[2]}).error, "");
    const auto faultOf = [](const std::vector<LevelCount>& counts, double guess) {
        return fitPsychometric(counts, {shapes[0], guess}).error;
    };
    EXPECT_EQ(faultOf({{1, 9, 10}, {2, 6, 10}, {3, 2, 10}}, 0.0),
              "the share of answers does not rise with the level");
    // no finite width is likeliest: the threshold is known, the JND is not
    for (const auto& [between, threshold] :
         {std::pair<std::vector<LevelCount>, double>{{{1, 0, 5}, {2, 5, 5}}, 1.5},
          {{{2, 11, 20}, {4, 9, 20}, {6, 20, 20}, {8, 20, 20}}, 5.0},
          {{{1, 10, 22}, {2, 9, 22}, {3, 18, 22}, {4, 22, 22}}, 2.963}, // 2.927 to 3 are as likely
          {{{1, 5, 10}, {2, 5, 10}, {3, 5, 10}, {4, 9, 10}}, 3.5}}) {   // with the most lapses
        const auto fit = fitPsychometric(between, {shapes[0]});
        EXPECT_TRUE(fit.error.empty() && !fit.hasJnd) << fit.error;
        EXPECT_NEAR(fit.function.threshold, threshold, 0.003);
    }
    EXPECT_EQ(faultOf({{1, 4, 40}, {2, 7, 40}, {3, 10, 40}}, 0.0).find("the fitted threshold lies"), 0u);
    EXPECT_EQ(faultOf({{1, 50, 100}, {2, 55, 100}, {3, 60, 100}}, 0.0),
              "the function fits no better than a constant (likelihood ratio, p = 0.155)")
        << "2 (sum of h log(p / 0.55) + ...) = 2.02, chi-squared";
    EXPECT_EQ(faultOf({{1, 4, 40}, {2, 20, 40}, {3, 35, 40}}, 0.0), "");
}

TEST(Psychometric, IntervalsOfFittedParticipantsHoldAsOftenAsTheySay) {
    SeededRandom random{5, "studies"};
    constexpr int studies = 500, participants = 6;
    double off = 0.0, widths = 0.0;
    int held = 0;
    for (int study = 0; study < studies; ++study) {
        std::vector<double> thresholds;
        for (int p = 0; p < participants; ++p) {
            const PsychometricFunction truth{shapes[study % 3], 5.0 + random.normal(),
                                             3.0 + 3.0 * random.uniform(), 0.5, 0.02};
            thresholds.push_back(
                fitPsychometric(observed(truth, 60, random), {truth.shape}).function.threshold);
            off += thresholds.back() - truth.threshold;
            widths += truth.width;
        }
        const auto interval = Moments(thresholds);
        held += interval.lowerLimit() < 5.0 && 5.0 < interval.upperLimit();
    }
    EXPECT_LT(std::abs(off), 0.02 * widths);
    EXPECT_NEAR(held, 0.95 * studies, 0.02 * studies);
}

TEST(Moments, FewParticipantsHaveAnIntervalToo) {
    const std::vector<double> two{1, 3}, same{2, 2, 2};
    EXPECT_NEAR(Moments(two).halfInterval(), 12.706204736174698, 1e-9);
    EXPECT_EQ(Moments(same).lowerLimit(), 2.0);
    EXPECT_EQ(Moments(std::span{two}.first(1)).upperLimit(), 1.0);
    for (const auto& [df, quantile] : {std::pair{1u, 12.706204736174698},
                                       {2u, 4.3026527297494637},
                                       {11u, 2.2009851600916388},
                                       {48u, 2.0106347576242314},
                                       {1000u, 1.9623390808264078}}) // R: qt(0.975, df)
        EXPECT_NEAR(studentQuantile(0.975, df), quantile, 1e-12) << df;
    EXPECT_NEAR(normalQuantile(0.975), 1.959963984540054, 1e-14);
    EXPECT_NEAR(normalQuantile(1e-6), -4.753424308822899, 1e-13);
}

TEST(PowerLaw, ExponentAndFactorComeBack) {
    std::vector<LevelAnswer> trials;
    for (const double level : {0.1, 0.3, 1.0, 3.0})
        trials.push_back({"P", level, 4.0 * std::pow(level, 0.55)});
    const auto law = fitPowerLaw(trials);
    EXPECT_NEAR(law.exponent, 0.55, 1e-12);
    EXPECT_NEAR(law.factor, 4.0, 1e-12);
    EXPECT_NEAR(law.rSquared, 1.0, 1e-12);
    EXPECT_EQ(fitPowerLaw(std::span{trials}.first(1)).error, "expected magnitudes of two or more levels");
    trials[0].answer = 0.0;
    EXPECT_EQ(fitPowerLaw(trials).error, "expected levels and magnitudes > 0");
}

} // namespace physvib::psychometric_test
