// SPDX-License-Identifier: MIT
// Eq. 5.4 and 5.7 with numbers worked out by hand.
#include "Contacts/ImpactSettings.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(ImpactModel, AmplitudeIsImpulseOverMassesTimesNormalisation) {
    const ImpactModel model{0.125, 30.0, 1.0};
    EXPECT_DOUBLE_EQ(model.amplitude(80.0, 10.0), 0.25);
}

TEST(ImpactModel, DriveGainMultiplies) {
    const ImpactModel model{0.125, 30.0, 4.0};
    EXPECT_DOUBLE_EQ(model.amplitude(80.0, 10.0), 1.0);
}

TEST(ImpactModel, FastestBodyCrossesTheFieldInASecond) { EXPECT_DOUBLE_EQ(defaultNormalisation(4.0), 0.125); }

} // namespace
} // namespace physvib
