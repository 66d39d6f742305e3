// SPDX-License-Identifier: MIT
// Where a tone is cut.
#include "Core/Samples.h"
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

TEST(ToneEnd, IsACrossingAQuarterPeriodAwayAtMost) {
    std::mt19937 random{1};
    for (int i = 0; i < 100'000; ++i) {
        const double hz = std::uniform_real_distribution{5.0, 2000.0}(random);
        const auto wanted = std::uniform_int_distribution<std::int64_t>{1'000'000, 3'600'000'000'000}(random);
        const std::int64_t end = softEndNs(hz, wanted);
        const double halfNs = 0.5e9 / hz;
        ASSERT_GE(end, 1);
        if (static_cast<double>(wanted) >= halfNs)
            ASSERT_LE(std::abs(static_cast<double>(end - wanted)), 0.5 * halfNs + 1.0) << hz << ' ' << wanted;
        else
            ASSERT_NEAR(static_cast<double>(end), halfNs, 1.0) << hz << ' ' << wanted;
        const double halves = static_cast<double>(end) / halfNs;
        ASSERT_NEAR(halves, std::round(halves), 1.0 / halfNs + 1e-9 * halves) << hz << ' ' << wanted;
    }
}

TEST(ToneEnd, StaysWhereItIsACrossing) {
    for (const std::int64_t ms : {2, 20, 250, 1000})
        EXPECT_EQ(softEndNs(250.0, ms * 1'000'000), ms * 1'000'000);
    EXPECT_EQ(softEndNs(205.0, 250'000'000), 251'219'512) << "ABA-250: 103 half periods";
    EXPECT_EQ(nearestCrossingNs(205.0, 1'000'000), 0);
}

} // namespace
} // namespace physvib
