// SPDX-License-Identifier: MIT
// Labels, counts and tolerance.
#include "Lab/Study/Identification.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(ConfusionMatrix, CountsEveryPairOnce) {
    const ConfusionMatrix matrix{{{"b", "b"}, {"a", "b"}, {"a", "a"}, {"a", "b"}}};
    ASSERT_EQ(matrix.stimuli(), 2u);
    EXPECT_EQ(matrix.label(0), "a");
    EXPECT_EQ(matrix.count(0, 0), 1u);
    EXPECT_EQ(matrix.count(0, 1), 2u);
    EXPECT_EQ(matrix.count(1, 1), 1u);
    EXPECT_EQ(matrix.correct(), 2u);
    EXPECT_EQ(matrix.trials(), 4u);
    EXPECT_EQ(matrix.stimulusTotals(), (std::vector<std::uint64_t>{3, 1}));
    EXPECT_EQ(matrix.responseTotals(), (std::vector<std::uint64_t>{1, 3}));
}

TEST(ConfusionMatrix, ResponsesThatAreNoStimulusStandLastAndAreWrong) {
    const ConfusionMatrix matrix{{{"b", "a"}, {"b", "b"}}};
    ASSERT_EQ(matrix.stimuli(), 1u);
    ASSERT_EQ(matrix.responses(), 2u);
    EXPECT_EQ(matrix.label(1), "a");
    EXPECT_EQ(matrix.correct(), 1u);
}

TEST(ConfusionMatrix, GridLabelsAreOrderedByNumber) {
    const ConfusionMatrix matrix{{{"10,1", "10,1"}, {"2,10", "2,10"}, {"2,9", "2,9"}}};
    EXPECT_EQ(matrix.label(0), "2,9");
    EXPECT_EQ(matrix.label(1), "2,10");
    EXPECT_EQ(matrix.label(2), "10,1");
}

TEST(ConfusionMatrix, GridLabelsAreTwoNumbersFromOne) {
    EXPECT_EQ(parseGridCell("2,5"), (GridCell{2, 5}));
    EXPECT_EQ(parseGridCell(" 2 , 5 "), (GridCell{2, 5}));
    for (const char* bad : {"", ",", "2", "2,", ",5", "0,1", "-1,2", "1,2,3", "a,b", "99999999999,1"})
        EXPECT_FALSE(parseGridCell(bad)) << bad;
}

TEST(ConfusionMatrix, ToleranceCountsNeighboursAsTheStimulus) {
    const auto trials = withTolerance({{"2,2", "2,3"}, {"2,2", "3,3"}, {"2,2", "2,2"}, {"2,2", "x"}}, 1);
    EXPECT_EQ(trials[0].response, "2,2");
    EXPECT_EQ(trials[1].response, "3,3");
    EXPECT_EQ(trials[2].response, "2,2");
    EXPECT_EQ(trials[3].response, "x");
}

TEST(ConfusionMatrix, NoTrialIsAnEmptyMatrix) {
    const ConfusionMatrix matrix{{}};
    EXPECT_EQ(matrix.stimuli(), 0u);
    EXPECT_EQ(matrix.correct(), 0u);
}

} // namespace
} // namespace physvib
