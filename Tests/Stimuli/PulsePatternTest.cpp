// SPDX-License-Identifier: MIT
// The number, the order, the distinctness, the length and the labels of the thesis' spatiotemporal patterns
// (3.2).
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace physvib {
namespace {

TEST(PulsePattern, CountsAreThoseOfTheThesis) {
    EXPECT_EQ(allPulsePatterns(2).size(), 28u);
    EXPECT_EQ(allPulsePatterns(3).size(), 78u);
    EXPECT_EQ(allPulsePatterns(4).size(), 168u);
}

TEST(PulsePattern, NoTwoAreAlikeAndAllStayOnTheirEnchanters) {
    const auto patterns = allPulsePatterns(4);
    for (auto p = patterns.begin(); p != patterns.end(); ++p) {
        EXPECT_EQ(std::count(patterns.begin(), patterns.end(), *p), 1);
        EXPECT_TRUE(
            std::all_of(p->enchanters.begin(), p->enchanters.end(), [](int e) { return e >= 0 && e < 4; }));
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
    EXPECT_FALSE(parsePatternLabel("A-10001"));
    const auto wide = parsePatternLabel("YZ-100");
    ASSERT_TRUE(wide);
    EXPECT_EQ(wide->enchanters, (std::array<int, 3>{24, 25, 0}));
}

} // namespace
} // namespace physvib
