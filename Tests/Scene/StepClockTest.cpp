// SPDX-License-Identifier: MIT
// Step times are exact integers at any rate and any length of run.
#include "Scene/World/SceneWorld.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(StepClock, RoundsEveryStepForItselfSoThatNothingDrifts) {
    const StepClock clock{60};
    EXPECT_EQ(clock.timeNs(1), 16'666'666);
    EXPECT_EQ(clock.timeNs(60), 1'000'000'000);
    EXPECT_EQ(clock.timeNs(60LL * 86'400 * 11), 950'400'000'000'000);
}

TEST(StepClock, DoesNotOverflowInLongRuns) {
    EXPECT_EQ(StepClock{10'000}.timeNs(10'000'000'001LL), 1'000'000'000'100'000);
}

} // namespace
} // namespace physvib
