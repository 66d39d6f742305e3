// SPDX-License-Identifier: MIT
// When and how fast two surfaces met in Godot, from what it has at the look, against a fall on paper.
#include "Api/Godot/ImpactEstimate.h"

#include <gtest/gtest.h>

namespace {
using physvib::godot::estimateImpact;
using physvib::godot::ImpactEstimate;
constexpr double g = 9.8;

// A surface falls from `height`; places at looks are on the parabola, and the velocity is half a step ahead.
struct Fall {
    double height, seconds;
    double met() const { return std::sqrt(2.0 * height / g); }
    /// At a look, `late` steps after the surfaces met (before it, if negative).
    ImpactEstimate at(double late) const {
        const double time = met() + late * seconds;
        const double gap = height - 0.5 * g * time * time;
        return estimateImpact(g * (time + 0.5 * seconds), gap, g, seconds);
    }
};

TEST(GodotMeeting, IsThatOfTheFallWheneverTheEngineLooks) {
    for (const double rate : {30.0, 60.0, 120.0, 240.0})
        for (const double late : {0.0, 0.1, 0.5, 0.999, -0.3, -1.0}) {
            const Fall fall{.height = 0.8, .seconds = 1.0 / rate};
            const ImpactEstimate impact = fall.at(late);
            EXPECT_NEAR(impact.approachMetresPerSecond, g * fall.met(), 1e-9) << rate << " ticks/s, " << late;
            EXPECT_NEAR(impact.fraction, -late, 1e-9) << rate << " ticks/s, " << late;
        }
}

TEST(GodotMeeting, WithoutGravityIsStraight) {
    const ImpactEstimate impact = estimateImpact(3.0, -0.02, 0.0, 1.0 / 60.0);
    EXPECT_DOUBLE_EQ(impact.approachMetresPerSecond, 3.0);
    EXPECT_NEAR(impact.fraction, -0.02 / 3.0 * 60.0, 1e-12);
}

TEST(GodotMeeting, OfWhatRestsIsNow) {
    const double seconds = 1.0 / 60.0;
    const ImpactEstimate resting = estimateImpact(0.5 * g * seconds, -0.001, g, seconds);
    EXPECT_EQ(resting.fraction, 0.0);
    EXPECT_DOUBLE_EQ(resting.approachMetresPerSecond, 0.5 * g * seconds);
    EXPECT_EQ(estimateImpact(-2.0, -0.001, g, seconds).fraction, 0.0) << "it parts";
}

// A body that was put deep into another one has met it in no step that the engine computed.
TEST(GodotMeeting, IsWithinOneStep) {
    for (const double gap : {-5.0, -0.5, 0.5, 5.0}) {
        const ImpactEstimate impact = estimateImpact(2.0, gap, g, 1.0 / 60.0);
        EXPECT_LE(std::abs(impact.fraction), 1.0) << gap;
        EXPECT_TRUE(std::isfinite(impact.approachMetresPerSecond)) << gap;
        EXPECT_GE(impact.approachMetresPerSecond, 0.0) << gap;
    }
}

TEST(GodotMeeting, OfNoNumbersHarmsNothing) {
    const ImpactEstimate impact = estimateImpact(std::nan(""), 0.0, g, 1.0 / 60.0);
    EXPECT_EQ(impact.fraction, 0.0);
}
} // namespace
