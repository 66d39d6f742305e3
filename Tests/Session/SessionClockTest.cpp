// SPDX-License-Identifier: MIT
// SessionClock: calls that come late, a crystal that drifts, a device that pauses.
#include "Live/Session/OutputClock.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

constexpr double ms = 1e6;

/// A device whose calls come at random up to `latestMs` after their time; the worst error of the clock 100 ms
/// ahead.
double worstErrorMs(double drift, double latestMs, double seconds) {
    std::mt19937 random{3};
    SessionClock clock;
    double worst = 0;
    for (double t = 0; t < seconds; t += 512 / 48000.0) { // session time
        const double late = latestMs * ms * (random() / 4294967296.0);
        const auto steadyOf = [&](double s) { return 5e9 + s * 1e9 / (1 + drift); };
        clock.add({static_cast<std::int64_t>(t * 1e9), static_cast<std::int64_t>(steadyOf(t) + late)});
        const double felt = t + 0.1;
        if (t > 0.5)
            worst = std::max(
                worst, std::abs(static_cast<double>(clock.steadyAt(static_cast<std::int64_t>(felt * 1e9))) -
                                steadyOf(felt)) /
                           ms);
    }
    return worst;
}

TEST(SessionClock, OfCallsThatComeLateTheEarliestCounts) {
    EXPECT_LT(worstErrorMs(0, 8, 60), 2.5) << "their mean would be 4 ms off";
}
TEST(SessionClock, FollowsACrystal) {
    EXPECT_LT(worstErrorMs(300e-6, 0, 60), 0.2);
    EXPECT_LT(worstErrorMs(-300e-6, 0, 60), 0.2);
    EXPECT_LT(worstErrorMs(300e-6, 2, 60), 0.7);
}

TEST(SessionClock, BeginsAnewAfterAPause) {
    SessionClock clock;
    EXPECT_FALSE(clock.isReady());
    clock.add({1000, 2000});
    EXPECT_TRUE(clock.isReady());
    EXPECT_EQ(clock.steadyAt(1500), 2500);
    const std::int64_t pause = 3 * SessionClock::halfWindowNs;
    clock.add({1010, 2010 + pause}); // session time stood still
    EXPECT_EQ(clock.steadyAt(1500), 2500 + pause);
}

TEST(SessionClock, TheSameMomentAgainChangesNothing) {
    SessionClock clock;
    for (int i = 0; i < 5; ++i) clock.add({1000, 2000});
    EXPECT_EQ(clock.steadyAt(0), 1000);
}

} // namespace
} // namespace physvib
