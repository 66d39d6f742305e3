// SPDX-License-Identifier: MIT
// GainRamp: straight lines between gains, exact at both ends.
#include "Core/Actuators/GainRamp.h"
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {
namespace {

TEST(GainRamp, AtOneItChangesNoBit) {
    GainRamp ramp;
    ramp.prepare(1000, 0.01, 1.0f);
    std::vector<float> x{0.1f, -3e-20f, 7.0f}, before = x;
    float* at = x.data();
    ramp.apply(&at, 1, 3);
    EXPECT_EQ(x, before);
}

TEST(GainRamp, MovesInAStraightLineAcrossBlocksAndThenRests) {
    GainRamp ramp;
    ramp.prepare(1000, 0.01, 0.0f); // a tenth per frame
    ramp.moveTo(1.0f);
    std::vector<float> x(20, 1.0f);
    float* at = x.data();
    ramp.apply(&at, 1, 7);
    at += 7;
    ramp.apply(&at, 1, 13);
    for (std::size_t n = 0; n < 20; ++n)
        EXPECT_NEAR(x[n], std::min(1.0f, 0.1f * static_cast<float>(n + 1)), 1e-6);
    EXPECT_TRUE(ramp.isResting());
    EXPECT_EQ(x.back(), 1.0f);
}

TEST(GainRamp, InAHurryItIsThereInTheFramesGivenAndExactly) {
    for (int frames = 1; frames <= 9; ++frames) {
        GainRamp ramp;
        ramp.prepare(1000, 0.01, 1.0f);
        ramp.moveTo(0.0f, frames);
        std::vector<float> x(9, 1.0f);
        float* at = x.data();
        ramp.apply(&at, 1, frames);
        EXPECT_EQ(x[static_cast<std::size_t>(frames) - 1], 0.0f) << frames;
        EXPECT_TRUE(ramp.isResting());
    }
}

TEST(GainRamp, SilenceIsExact) {
    GainRamp ramp;
    ramp.prepare(1000, 0.01, 1.0f);
    ramp.moveTo(0.0f);
    std::vector<float> x(30, 1.0f);
    float* at = x.data();
    ramp.apply(&at, 1, 30);
    EXPECT_EQ(x[9], 0.0f);
    EXPECT_EQ(x[29], 0.0f);
}

TEST(GainRamp, MovesOnThroughSilence) {
    GainRamp passed, applied;
    std::array<float, 100> zeros{}, a{}, b{};
    a.fill(1.0f);
    b.fill(1.0f);
    float *silence = zeros.data(), *atA = a.data(), *atB = b.data();
    for (auto* ramp : {&passed, &applied}) {
        ramp->prepare(48000, 0.01, 1.0f);
        ramp->moveTo(-0.5f);
    }
    passed.pass(100);
    applied.apply(&silence, 1, 100);
    passed.apply(&atA, 1, 100);
    applied.apply(&atB, 1, 100);
    EXPECT_EQ(a, b);
    EXPECT_LT(a[99], a[0]);
}

} // namespace
} // namespace physvib
