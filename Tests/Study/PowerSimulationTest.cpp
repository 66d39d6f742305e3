// SPDX-License-Identifier: MIT
// Power by simulation, against textbooks.
#include "Lab/Statistics/PowerSimulation.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(PowerSimulation, APairedTestHasThePowerOfTheNoncentralT) {
    EXPECT_NEAR(PairedPower{34}.at(0.5, 0.05), 0.807, 0.03); // Cohen (1988), G*Power: n = 34, d_z = 0.5
    EXPECT_NEAR(PairedPower{12}.at(0.8, 0.05), 0.712, 0.04);
    EXPECT_NEAR(PairedPower{20}.at(0.0, 0.05), 0.05, 0.015)
        << "nothing is there: the error of the first kind";
    EXPECT_NEAR(*PairedPower{12}.smallestEffect(0.8, 0.05), 0.89, 0.05);
    EXPECT_GT(*PairedPower{12}.smallestEffect(0.8, 0.05 / 15), *PairedPower{12}.smallestEffect(0.8, 0.05));
    EXPECT_FALSE(PairedPower{2}.smallestEffect(0.8, 0.001));
}

TEST(PowerSimulation, MoreTrialsFindSmallerShares) {
    const SharePower few{12, 10}, many{12, 100};
    EXPECT_LT(few.at(0.5), 0.08);
    EXPECT_LT(few.at(0.55), many.at(0.55));
    EXPECT_LT(*many.smallestShare(0.8), *few.smallestShare(0.8));
    EXPECT_FALSE((SharePower{3, 10}.smallestShare(0.8)))
        << "three participants can never reach p < 0.05 by signed ranks";
}

} // namespace
} // namespace physvib
