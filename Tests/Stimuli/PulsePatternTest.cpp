// SPDX-License-Identifier: MIT
// The number, the distinctness and the length of the thesis' spatiotemporal patterns (3.2).
#include "Stimuli/PulsePattern.h"
#include <algorithm>
#include <gtest/gtest.h>

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

} // namespace
} // namespace physvib
