// SPDX-License-Identifier: MIT
// Intervals and tests against tabled values; grouping of choices and ratings; the choice of icons.
#include "Lab/Study/Identification.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace physvib::votes_test {

TEST(Ratings, OnePersonAmongSeveralHasNoInterval) {
    std::vector<RatingTrial> trials{{"A", "x", {10.0}}, {"A", "x", {90.0}}, {"B", "y", {50.0}}};
    EXPECT_EQ(summariseRatings(trials).front().halfIntervals, std::vector<double>{0.0});
    trials.pop_back();
    EXPECT_GT(summariseRatings(trials).front().halfIntervals.front(), 0.0) << "alone: over trials";
}

TEST(Proportion, WilsonsIntervalAsTabled) {
    const auto p = proportion(81, 263); // Newcombe 1998: 0.2553 to 0.3662
    EXPECT_NEAR(p.lower, 0.2553, 5e-5);
    EXPECT_NEAR(p.upper, 0.3662, 5e-5);
    EXPECT_EQ(proportion(0, 10).lower, 0.0);
    EXPECT_NEAR(proportion(10, 10).upper * proportion(0, 0).upper, 1.0, 1e-12);
}

TEST(Votes, ChoicesAreSharedOutByConditionAndFactor) {
    const auto summaries = summariseChoices({{"P1", "pair=wood size=small", "RM"},
                                             {"P1", "pair=wood size=large", "SV"},
                                             {"P2", "pair=wood size=small", "RM"},
                                             {"P2", "pair=steel size=small", "RM"}});
    EXPECT_TRUE(summaries.front().condition == "all" && summaries.front().participants == 2);
    EXPECT_NEAR(summaries.front().shares[0].share, 0.75, 1e-12);
    EXPECT_NEAR(summaries.front().shares[0].median, 0.75, 1e-12);
    const auto small = std::ranges::find(summaries, "size=small", &ChoiceSummary::condition);
    ASSERT_NE(small, summaries.end());
    EXPECT_EQ(small->shares[0].hits, 3u);
    EXPECT_EQ(summaries.size(), 1u + 4u + 3u);
    EXPECT_FALSE(small->shares[0].interval) << "two people have none of 95 %";
}

TEST(Votes, SharesAreOfTrialsThatOfferedIt) {
    for (const bool isTold : {true, false}) {
        std::vector<ChoiceTrial> trials;
        for (const char* who : {"P1", "P2"})
            for (const std::string pair : {"AB", "AC", "BC"})
                for (const char own : pair)
                    trials.push_back(
                        {who, pair, std::string{own}, isTold ? pair.substr(1) + "|" + pair[0] : "", pair});
        const auto summaries = summariseChoices(trials);
        EXPECT_TRUE(summaries[0].findShare("A")->trials == 8 && summaries[0].findShare("A")->share == 0.5);
        EXPECT_EQ(summaries.back().findShare("A"), nullptr) << "BC";
        std::erase_if(trials, [](const auto& one) { return one.condition == "BC" && one.choice == "C"; });
        EXPECT_EQ(std::isnan(summariseChoices(trials).front().shares[0].share), !isTold)
            << "which were offered is not known, as analysis.R has it";
    }
}

// One person's many trials must not outvote the others, nor be taken for as many people.
TEST(Votes, ThirteenForAndSevenAgainstIsNoDecision) {
    std::vector<ChoiceTrial> trials;
    for (int p = 0; p < 20; ++p)
        for (int t = 0; t < 100; ++t)
            trials.push_back({"P" + std::to_string(p), "", t < (p < 13 ? 60 + p : 30 - p) ? "RM" : "SV"});
    const auto all = summariseChoices(trials).front();
    EXPECT_TRUE(all.participants == 20 && all.trials == 2000);
    ASSERT_TRUE(all.shares[0].interval);
    EXPECT_NEAR(all.shares[0].interval->lower, 0.16, 1e-12) << "the sixth of twenty";
    EXPECT_NEAR(all.shares[0].interval->upper, 0.67, 1e-12);
    trials.resize(100);
    const auto one = summariseChoices(trials).front();
    EXPECT_NEAR(one.shares[0].interval->lower, proportion(one.shares[0].hits, 100).lower, 1e-12);
}

TEST(Votes, RatingsAreOfConditions) {
    const auto summaries = summariseRatings({{"P1", "f=2 l=1", {80, 60}},
                                             {"P2", "f=2 l=1", {70, 60}},
                                             {"P1", "f=1 l=1", {30, 40}},
                                             {"P2", "f=1 l=1", {40, 40}}});
    ASSERT_EQ(summaries.size(), 2u) << "levels of factors are R's";
    EXPECT_NEAR(summaries[1].means[0], 75.0, 1e-12);
    EXPECT_NEAR(summaries[1].medians[0], 75.0, 1e-12);
    EXPECT_NEAR(summaries[1].deviations[0], std::sqrt(50.0), 1e-9);
    EXPECT_NEAR(summaries[1].halfIntervals[0], 12.706204736174698 * 5.0, 1e-9);
    EXPECT_EQ(summaries[1].halfIntervals[1], 0.0);
    EXPECT_EQ(summaries[1].condition, "f=2 l=1");
}

TEST(Votes, NamesOfLevelsAreWholeWhereTheyHaveSpaces) {
    std::string names;
    for (const auto& one : summariseChoices({{"P1", "condition=no noise stimulus=rather soft = b", "A"},
                                             {"P1", "condition=no noise stimulus=rather hard", "A"},
                                             {"P1", "condition=hum stimulus=f & rather soft", "A"}}))
        if (one.condition.find(" stimulus") == std::string::npos) names += one.condition + "; ";
    EXPECT_EQ(names,
              "all; condition=hum; condition=no noise; stimulus=f & rather soft; stimulus=rather hard; "
              "stimulus=rather soft = b; ");
}

TEST(LevelTrials, ThresholdsAreMeansOfTheLaterReversals) {
    std::vector<LevelTrial> trials;
    const auto add = [&](const char* who, const std::vector<double>& levels, const std::string& answers,
                         const char* session = "") {
        for (std::size_t i = 0; i < levels.size(); ++i)
            trials.push_back({LevelTrial::Kind::staircase,
                              who,
                              "A",
                              who,
                              levels[i],
                              answers[i] == 'r' ? 1.0 : 0.0,
                              session,
                              "",
                              {{0.0, 20.0}}});
    };
    add("P1", {8, 8, 6, 6, 4, 5, 5, 4.5, 5, 5, 4.5}, "rrrrwrrwrrw"); // turns at 4, 5, 4.5 and 5
    add("P2", {2, 1}, "rr");
    add("P3", {1, 1, 0, 0, 0, 1, 1, 0, 1}, "rrrrwrrwr"); // half of its reversals are at 0
    add("P4", {8, 8, 6, 6, 4, 5, 5, 4.5, 5, 5, 4.5}, "rrrrwrrwrrw", "main/1");
    add("P4", {2, 1}, "rr", "main/2");
    add("P5", {8, 6, 6, 4, 5, 5, 4.5, 5, 5, 4.5}, "rrrwrrwrrw");
    add("P6", {2, 2, 1, 2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0}, "rrwrrrrrrrrrrr"); // turned above, held at 0
    const auto summaries = summariseLevels(trials);
    ASSERT_EQ(summaries.at(0).excluded.size(), 4u);
    EXPECT_EQ(summaries[0].excluded[3].first, "P6");
    EXPECT_EQ(summaries[0].excluded[3].second.find("a staircase had half or more of its trials"), 0u);
    EXPECT_EQ(summaries[0].trials, 21u);
    EXPECT_EQ(summaries[0].participants, 2u);
    EXPECT_NEAR(summaries[0].estimate, 4.75, 1e-12);
    using Left = std::pair<std::string, std::string>;
    EXPECT_EQ(summaries[0].excluded.at(0), Left("P2", "a staircase has fewer than two reversals"));
    EXPECT_EQ(summaries[0].excluded.at(1),
              Left("P3", "a staircase had half or more of its trials, or of the reversals "
                         "that count, at the lower end of its levels"));
    EXPECT_EQ(summaries[0].excluded.at(2), Left("P4", "staircase 2 of main has fewer than two reversals"));
}

TEST(LevelTrials, AnEndIsOneThoughNoTrialWasHeldThere) {
    std::vector<LevelTrial> trials; // half of the later reversals are at 0, which one error leaves
    for (const double level : {3.0, 3.0, 1.0, 2.0, 2.0, 1.5, 1.5, 1.0, 1.0, 0.5, 1.0, 1.5,
                               1.5, 1.0, 1.0, 0.5, 0.5, 0.0, 0.0, 0.5, 0.5, 0.0, 0.5})
        trials.push_back({LevelTrial::Kind::staircase, "P", "A", "", level, 1.0});
    EXPECT_TRUE(summariseLevels(trials).at(0).excluded.empty());
    for (LevelTrial& trial : trials) trial.range = {0.0, 14.0};
    EXPECT_EQ(summariseLevels(trials).at(0).excluded.size(), 1u);
    for (LevelTrial& trial : trials) trial.range = {-1.0, 14.0};
    EXPECT_TRUE(summariseLevels(trials).at(0).excluded.empty());
}

TEST(LevelTrials, TheEndThatAStaircaseWasHeldAtIsToldByItsName) {
    for (const bool isUpper : {false, true}) {
        std::vector<LevelTrial> trials;
        for (const double level : {1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0})
            trials.push_back(
                {LevelTrial::Kind::staircase, "P", "A", "", isUpper ? 20.0 - level : level, 1.0});
        for (LevelTrial& trial : trials) trial.range = {0.0, 20.0};
        const auto excluded = summariseLevels(trials).at(0).excluded;
        ASSERT_EQ(excluded.size(), 1u);
        EXPECT_TRUE(excluded[0].second.ends_with(isUpper ? " at the upper end of its levels"
                                                         : " at the lower end of its levels"))
            << excluded[0].second;
    }
}

TEST(LevelTrials, MatchesAreMeansAndMagnitudesGeometricMeans) {
    using Kind = LevelTrial::Kind;
    const auto summaries = summariseLevels({{Kind::adjustment, "P1", "A", "s", 0, -3},
                                            {Kind::adjustment, "P1", "A", "s", 0, -5},
                                            {Kind::magnitude, "P1", "A", "s", 0, 1},
                                            {Kind::magnitude, "P2", "A", "s", 0, 100}});
    EXPECT_NEAR(summaries.at(0).estimate, -4.0, 1e-12);
    EXPECT_NEAR(summaries.at(1).estimate, 10.0, 1e-12);
    EXPECT_NEAR(summaries[1].deviation, std::sqrt(2.0), 1e-12);
}

TEST(TactileIcons, TheMostConfusedAreDroppedFirst) {
    std::vector<IdentificationTrial> trials;
    const auto add = [&](const char* s, const char* r, int n) {
        trials.insert(trials.end(), static_cast<std::size_t>(n), {s, r});
    };
    add("a", "a", 10), add("b", "b", 6), add("b", "c", 4);
    add("c", "c", 7), add("c", "b", 3), add("d", "d", 9), add("d", "a", 1);
    const ConfusionMatrix matrix{trials};
    EXPECT_EQ(leastConfused(matrix, 3), (std::vector<std::size_t>{0, 2, 3}))
        << "of b and c the one with fewer correct answers goes";
    EXPECT_EQ(leastConfused(matrix, 9).size(), 4u);
    EXPECT_NEAR(shareCorrect(matrix, 1), 0.6, 1e-12);
    EXPECT_NEAR(bitsForMeanings(8), 3.0, 1e-12);
}

} // namespace physvib::votes_test
