// SPDX-License-Identifier: MIT
// What a protocol will ask for, against counts by hand.
#include "Lab/Study/StudyPlan.h"
#include "Lab/Files/ProtocolFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Protocol builtIn(const std::string& name) { return findProtocol(name).value; }

/// Four conditions of one pattern each.
Protocol four(Protocol::ConditionOrder order) {
    Protocol protocol;
    protocol.conditionOrder = order;
    for (const char* name : {"a", "b", "c", "d"}) {
        protocol.conditions.push_back({});
        protocol.conditions.back().name = name;
        protocol.conditions.back().stimuli = PatternSet{2};
    }
    protocol.sessions.push_back({});
    protocol.sessions.back().name = "main";
    return protocol;
}

TEST(StudyPlan, EveryPartOfEveryStimulusIsPlannedAtItsLowestAndHighestLevel) {
    const auto planned = plannedStimuli(builtIn("model-or-sound"));
    ASSERT_EQ(planned.size(), 27u * (2u + 1u));
    for (const PlannedStimulus& s : planned)
        EXPECT_EQ(s.levelDb, s.part == "SV" ? -8.0 : s.isHighest ? -2.0 : -38.0) << s.part;
    const TrialJob job = planned.front().job(builtIn("model-or-sound"));
    EXPECT_NE(std::get<WrittenCall>(job).words.find("--level-db -38"), std::string::npos)
        << std::get<WrittenCall>(job).words;
    EXPECT_EQ(plannedStimuli(builtIn("patterns")).size(), 2u * (28u + 78u + 168u));
    EXPECT_EQ(plannedStimuli(builtIn("eight-methods")).size(), 24u);
}

TEST(StudyPlan, LevelsAddUpAsAnExperimentAddsThem) {
    Protocol protocol = builtIn("model-or-sound");
    for (Alternative& alternative : protocol.sessions[1].alternatives) alternative.levelDb = 3.0;
    for (const PlannedStimulus& s : plannedStimuli(protocol)) {
        if (!s.isHighest) continue;
        // 3 dB, and -2 dB that may have been set
        EXPECT_EQ(s.levelDb, s.part == "SV" ? 3.0 : 1.0) << s.part;
        EXPECT_EQ(s.session, 1u);
    }
    const StaircasePlan staircase = *builtIn("level-steps").sessions[0].staircase;
    for (const PlannedStimulus& s : plannedStimuli(builtIn("level-steps")))
        EXPECT_EQ(s.levelDb, s.part == staircase.alternative && s.isHighest ? staircase.mostDb : 0.0);
}

TEST(StudyPlan, TrialsAreThoseOfTheProtocol) {
    const auto second = [](std::size_t, const std::string&, const std::string&) { return 1.0; };
    const PlannedTime time = plannedTime(builtIn("model-or-sound"), second);
    EXPECT_EQ(time.trials, 27 + 108);
    EXPECT_NEAR(time.seconds, 135 * (2.0 + PlannedTime::answerSeconds) + 180.0, 1e-6);
    EXPECT_NEAR(time.longestStretchSeconds, (27 + 54) * (2.0 + PlannedTime::answerSeconds), 1e-6);
    double trials = 0.0;
    for (const PlannedTrials& planned : plannedTrials(builtIn("model-or-sound")))
        trials += planned.part == "SV" ? planned.count : 0;
    EXPECT_EQ(trials, 135.0);
}

TEST(StudyPlan, TouchesOfATrainingAreSharedByItsPlacesWithoutARest) {
    double touches = 0.0;
    for (const PlannedTrials& planned : plannedTrials(builtIn("phantom-places"))) touches += planned.count;
    EXPECT_NEAR(touches, 4 * (100 + 175), 1e-9); // 35 places: 2.86 touches each, not 2
}

TEST(StudyPlan, AWorldWithHandsLastsAsLongAsTheSessionAsks) {
    const auto nothing = [](std::size_t, const std::string&, const std::string&) { return 0.0; };
    const PlannedTime time = plannedTime(builtIn("eight-methods"), nothing);
    EXPECT_EQ(time.trials, 16 + 80);
    EXPECT_GT(time.seconds, 96 * 30.0);
}

TEST(StudyPlan, ASquareOfFourIsBalancedForFourAndNotForFive) {
    const Protocol square = four(Protocol::ConditionOrder::latinSquare);
    const OrderBalance whole = orderBalance(square, 4);
    EXPECT_TRUE(whole.isBalanced());
    EXPECT_EQ(whole.fewestAtPlace, 1);
    EXPECT_EQ(whole.possibleSuccessions, 12);
    EXPECT_FALSE(orderBalance(square, 5).isBalanced());
    const OrderBalance given = orderBalance(four(Protocol::ConditionOrder::given), 8);
    EXPECT_EQ(given.fewestAtPlace, 0);
    EXPECT_EQ(given.mostAtPlace, 8);
    EXPECT_EQ(given.successions, 3);
}

} // namespace
} // namespace physvib
