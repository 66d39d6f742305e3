// SPDX-License-Identifier: MIT
// The simulated observer: blur fitted to published exact shares, what it predicts of the others, and what its
// analysis says.
#include "Lab/Study/Identification.h"
#include "Lab/Study/Summaries.h"
#include "Support/Studies.h"
#include "Thesis/Printed.h"
#include <cmath>
#include <gtest/gtest.h>

namespace physvib::observer_test {

TEST(PlaceBlur, FittedToExactSharesPredictsTheSharesWithTolerance) {
    for (const char* configuration : {"PHONE", "RING"}) {
        const double blur = thesis::printedBlur(configuration);
        for (const thesis::Identification& one : thesis::identifications) {
            if (one.study != "phantom-grids" || !one.condition.starts_with(configuration)) continue;
            const BlurredGrid grid = blurredGrid(thesis::linesOf(one), blur);
            EXPECT_NEAR(100.0 * grid.shareExact, one.percentCorrect, 2.1) << "one number for three grids";
            EXPECT_NEAR(100.0 * grid.shareTolerance1, one.percentTolerance, 7.0)
                << "held out; too high by 1 to 7 points: people err farther than a normal blur";
        }
    }
}

TEST(PlaceBlur, ThePresetsAreTheFit) {
    EXPECT_NEAR(observerNamed("simulated-PHONE")->placeBlur, thesis::printedBlur("PHONE"), 1e-4);
    EXPECT_NEAR(observerNamed("simulated-RING")->placeBlur, thesis::printedBlur("RING"), 1e-4);
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
    for (int number = 1; number <= participants; ++number)
        for (const auto& [trial, answer] : answered(p, {"P", number}, settings))
            trials.push_back({trial.stimulus, answer.response});
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
        const ConfusionMatrix exact{trials}, tolerant{tolerate(trials, 1)};
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
    settings.centralTendency = 1.0;
    for (const auto& trial : mainTrials(identification(GridSet{3, 3}, 1), settings, 1))
        EXPECT_EQ(trial.response, "2,2");
    settings.centralTendency = 0.0;
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

TEST(Observer, FeelsAConditionWithTheBlurThatItsProtocolSays) {
    Protocol p;
    p.name = "blurs";
    for (const double blur : {0.0, 0.01, 0.3}) {
        p.conditions.push_back({std::to_string(blur), "", "phone4", 205.0, 1.0, GridSet{5, 5}});
        p.conditions.back().observerBlur = blur;
    }
    p.sessions = {{.name = "main", .repetitions = 40}};
    std::vector<double> shares(3, 0.0);
    for (const TrialRecord& record : answered(p))
        shares[record.trial.condition] += *isCorrect(p, record) / 1000.0;
    EXPECT_NEAR(shares[0], blurredGrid(5, 0.15).shareExact, 0.05) << "the observer's own";
    EXPECT_DOUBLE_EQ(shares[1], 1.0);
    EXPECT_NEAR(shares[2], blurredGrid(5, 0.3).shareExact, 0.05);
}

} // namespace physvib::observer_test
