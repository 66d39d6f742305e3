// SPDX-License-Identifier: MIT
// The simulated observer: blur fitted to published exact shares, what it predicts of the others, and what its
// analysis says.
#include "Lab/Study/Identification.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/Summaries.h"
#include "Lab/Thesis/ThesisPage.h"
#include "Thesis/PlaceBlur.h"
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace physvib {
namespace {

/// Thesis 4.1.2 as printed: exact shares, shares with tolerance 1, IT and tolerance-IT for 3 x 3, 4 x 4, 5
/// x 5.
struct Published {
    const char* name;
    std::array<double, 3> exact, tolerance1, bits, bitsTolerance1;
};
constexpr Published published[] = {
    {"PHONE", {0.740, 0.453, 0.306}, {0.934, 0.823, 0.702}, {1.89, 1.77, 1.76}, {2.76, 3.04, 3.00}},
    {"RING", {0.887, 0.617, 0.451}, {0.984, 0.926, 0.835}, {2.53, 2.32, 2.28}, {3.05, 3.50, 2.62}}};

double fitted(const Published& p) {
    const std::array<ExactShare, 3> shares{{{3, p.exact[0]}, {4, p.exact[1]}, {5, p.exact[2]}}};
    return fitPlaceBlur(shares);
}

TEST(PlaceBlur, FittedToExactSharesPredictsTheSharesWithTolerance) {
    std::printf("          blur  grid  exact: fitted published   tolerance 1: predicted published   IT: "
                "model published   tolerance-IT: model published\n");
    for (const Published& p : published) {
        const double blur = fitted(p);
        double worstExact = 0.0, worstTolerance = 0.0;
        for (std::size_t g = 0; g < 3; ++g) {
            const int lines = static_cast<int>(g) + 3;
            const BlurredGrid grid = blurredGrid(lines, blur);
            worstExact = std::max(worstExact, std::abs(grid.shareExact - p.exact[g]));
            worstTolerance = std::max(worstTolerance, std::abs(grid.shareTolerance1 - p.tolerance1[g]));
            std::printf("%-5s   %.4f  %dx%d   %12.1f %9.1f   %22.1f %9.1f   %9.2f %9.2f   %19.2f %9.2f\n",
                        p.name, blur, lines, lines, 100 * grid.shareExact, 100 * p.exact[g],
                        100 * grid.shareTolerance1, 100 * p.tolerance1[g], grid.bits, p.bits[g],
                        grid.bitsTolerance1, p.bitsTolerance1[g]);
        }
        EXPECT_LE(worstExact, 0.021) << "one number for three grids";
        EXPECT_LE(worstTolerance, 0.07)
            << "held out; too high by 1 to 7 points: people err farther than a normal blur";
    }
}

TEST(PlaceBlur, ThePresetsAreTheFit) {
    EXPECT_NEAR(observerNamed("simulated-PHONE")->placeBlur, fitted(published[0]), 1e-4);
    EXPECT_NEAR(observerNamed("simulated-RING")->placeBlur, fitted(published[1]), 1e-4);
    EXPECT_FALSE(observerNamed("person"));
    EXPECT_FALSE(observerNamed("simulated-GLOVE"));
}

TEST(PlaceBlur, RecoversABlurItWasMadeWith) {
    for (const double blur : {0.05, 0.123, 0.3}) {
        std::vector<ExactShare> shares;
        for (const int lines : {3, 4, 5, 7}) shares.push_back({lines, blurredGrid(lines, blur).shareExact});
        EXPECT_NEAR(fitPlaceBlur(shares), blur, 1e-3);
    }
}

std::vector<IdentificationTrial> mainTrials(const Protocol& p, const ObserverSettings& settings,
                                            int participants) {
    std::vector<IdentificationTrial> trials;
    for (int number = 1; number <= participants; ++number) {
        const Participant participant{"P", number};
        Experiment experiment{p, participant};
        const SimulatedObserver observer{settings, p, participant};
        while (!experiment.isDone()) {
            const auto record = experiment.take(observer.answer(experiment));
            trials.push_back({record.trial.stimulus, record.answer.response});
        }
    }
    return trials;
}

Protocol identification(StimulusSet stimuli, int repetitions) {
    Protocol p;
    p.name = "test";
    p.conditions = {{"A", "", "phone4", 205.0, 1.0, std::move(stimuli)}};
    p.sessions = {{.name = "main", .repetitions = repetitions}};
    return p;
}

TEST(SimulatedObserver, AnswersGridsAsItsModelSays) {
    for (const int lines : {3, 4, 5}) {
        const auto settings = *observerNamed("simulated-RING");
        const auto trials = mainTrials(identification(GridSet{lines, lines}, 10), settings, 18);
        const BlurredGrid model = blurredGrid(lines, settings.placeBlur);
        const ConfusionMatrix exact{trials}, tolerant{withTolerance(trials, 1)};
        const auto n = static_cast<double>(exact.trials());
        EXPECT_NEAR(static_cast<double>(exact.correct()) / n, model.shareExact, 3.5 * std::sqrt(0.25 / n));
        EXPECT_NEAR(static_cast<double>(tolerant.correct()) / n, model.shareTolerance1,
                    3.5 * std::sqrt(0.25 / n));
        EXPECT_NEAR(informationTransfer(exact).correctedBits(), model.bits, 0.05) << lines;
    }
}

TEST(SimulatedObserver, PullAndOffsetMoveWhatIsFelt) {
    ObserverSettings settings;
    settings.placeBlur = 1e-9;
    settings.pullToMiddle = 1.0;
    for (const auto& trial : mainTrials(identification(GridSet{3, 3}, 1), settings, 1))
        EXPECT_EQ(trial.response, "2,2");
    settings.pullToMiddle = 0.0;
    settings.offsetX = 0.5;
    for (const auto& trial : mainTrials(identification(GridSet{3, 1}, 1), settings, 1))
        EXPECT_EQ(trial.response, trial.stimulus == "1,1" ? "1,2" : "1,3");
}

TEST(SimulatedObserver, PatternsAreConfusedByPlaceDurationAndNumber) {
    ObserverSettings settings;
    settings.pulsePlaceConfusion = settings.durationConfusion = settings.numerosityConfusion = 0.0;
    for (const auto& trial : mainTrials(identification(PatternSet{3}, 1), settings, 1))
        EXPECT_EQ(trial.response, trial.stimulus);
    settings.durationConfusion = 1.0;
    for (const auto& trial : mainTrials(identification(PatternSet{2}, 1), settings, 1)) {
        const auto played = parsePatternLabel(trial.stimulus), felt = parsePatternLabel(trial.response);
        EXPECT_NE(played->pulseSeconds, felt->pulseSeconds);
        EXPECT_EQ(played->count, felt->count);
    }
    settings.durationConfusion = 0.0;
    settings.numerosityConfusion = 1.0;
    for (const auto& trial : mainTrials(identification(PatternSet{2}, 1), settings, 1))
        EXPECT_EQ(parsePatternLabel(trial.response)->count,
                  std::max(1, parsePatternLabel(trial.stimulus)->count - 1));
}

TEST(SimulatedObserver, TheThesisObserverIsFittedToWhatIsPrinted) {
    const ObserverSettings s = *observerNamed("simulated-thesis");
    EXPECT_EQ(s.placeBlur, observerNamed("simulated-PHONE")->placeBlur);
    EXPECT_EQ(s.ringBlur, observerNamed("simulated-RING")->placeBlur);
    double patterns = 0.0; // share right, all pulse counts, mean of 2, 3, 4 enchanters
    for (const int e : {2, 3, 4})
        for (const int pulses : {1, 2, 3})
            patterns += std::pow(e, pulses) / (e + e * e + e * e * e) *
                        std::pow(1.0 - s.pulsePlaceConfusion, pulses) * (1.0 - s.durationConfusion) *
                        (pulses > 1 ? 1.0 - s.numerosityConfusion : 1.0) / 3.0;
    EXPECT_NEAR(100.0 * patterns, thesis::patternsPercentMean, 0.05);
    EXPECT_DOUBLE_EQ(100.0 * s.firstAlternativePreference, thesis::modelChosenPercent);
    EXPECT_NEAR(s.amplitudeSpread, thesis::amplitudeGain * std::sqrt(20.0 / thesis::amplitudeF), 0.1);
    EXPECT_NEAR(s.frequencySpread, thesis::frequencyGain * std::sqrt(20.0 / thesis::frequencyF), 0.1);
    EXPECT_NEAR(s.decaySpread, thesis::decayGain * std::sqrt(20.0 / thesis::decayF), 0.1);
    EXPECT_EQ(s.amplitudeScore, thesis::amplitudeGain);
    EXPECT_EQ(s.frequencyScore, thesis::frequencyGain);
    EXPECT_EQ(s.decayScore, thesis::decayGain);
    double base = 0.0; // what AF-FF-DRF scores
    for (const double score : thesis::ratings.back().scores) base += score / 3.0;
    EXPECT_NEAR(s.scoreBase, base, 0.2);
}

TEST(SimulatedObserver, PatternRehearsalComesNearThePublishedShares) {
    for (const int enchanters : {2, 3, 4}) {
        const ConfusionMatrix matrix{
            mainTrials(identification(PatternSet{enchanters}, 1), *observerNamed("simulated-PHONE"), 12)};
        const double share = static_cast<double>(matrix.correct()) / static_cast<double>(matrix.trials());
        std::printf("%d enchanters: %.1f %% correct (published 89.2 to 95.0), IT %.2f bit\n", enchanters,
                    100 * share, informationTransfer(matrix).bits);
        EXPECT_NEAR(share, 0.92, 0.04);
    }
}

TEST(Observer, FeelsAConditionWithTheBlurThatItsProtocolSays) {
    Protocol p;
    p.name = "blurs";
    for (const double blur : {0.0, 0.01, 0.3}) {
        p.conditions.push_back({std::to_string(blur), "", "phone4", 205.0, 1.0, GridSet{5, 5}});
        p.conditions.back().observerBlur = blur;
    }
    p.sessions = {{.name = "main", .repetitions = 40}};
    Experiment experiment{p, {}};
    const SimulatedObserver observer{*observerNamed("simulated"), p, {}};
    std::vector<double> shares(3, 0.0);
    while (!experiment.isDone()) {
        const auto record = experiment.take(observer.answer(experiment));
        shares[record.trial.condition] += *isCorrect(p, record) / 1000.0;
    }
    EXPECT_NEAR(shares[0], blurredGrid(5, 0.15).shareExact, 0.05) << "the observer's own";
    EXPECT_DOUBLE_EQ(shares[1], 1.0);
    EXPECT_NEAR(shares[2], blurredGrid(5, 0.3).shareExact, 0.05);
}

} // namespace
} // namespace physvib
