// SPDX-License-Identifier: MIT
// Which gravity input acts in which step.
#include "Physics/GravityScript.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Scene scripted(double periodSeconds) {
    Scene scene;
    scene.script = {{0.07, 1.0, 0.0}, {0.5, 2.0, 0.0}};
    scene.scriptPeriodSeconds = periodSeconds;
    return scene;
}

TEST(GravityScript, InputActsFromTheFirstStepAtOrAfterItsTime) {
    const GravityScript script(scripted(0.0), {100});
    EXPECT_EQ(script.at(6).xMetresPerSecond2, 0.0);
    EXPECT_EQ(script.at(7).xMetresPerSecond2, 1.0);
    EXPECT_EQ(script.at(49).xMetresPerSecond2, 1.0);
    EXPECT_EQ(script.at(50).xMetresPerSecond2, 2.0);
    EXPECT_EQ(script.at(1'000'000).xMetresPerSecond2, 2.0);
}

TEST(GravityScript, RepeatsAfterItsPeriodAndKeepsTheLastInputUntilTheFirst) {
    const GravityScript script(scripted(1.0), {100});
    EXPECT_EQ(script.at(99).xMetresPerSecond2, 2.0);
    EXPECT_EQ(script.at(106).xMetresPerSecond2, 2.0);
    EXPECT_EQ(script.at(107).xMetresPerSecond2, 1.0);
    EXPECT_EQ(script.at(150).xMetresPerSecond2, 2.0);
}

TEST(GravityScript, TimesDoNotDependOnTheStepRate) {
    const GravityScript script(scripted(1.0), {1000});
    EXPECT_EQ(script.at(69).xMetresPerSecond2, 0.0);
    EXPECT_EQ(script.at(70).xMetresPerSecond2, 1.0);
    EXPECT_EQ(script.at(1070).xMetresPerSecond2, 1.0);
}

TEST(GravityScript, EmptyScriptIsWeightless) {
    EXPECT_EQ(GravityScript(Scene{}, {100}).at(5).yMetresPerSecond2, 0.0);
}

} // namespace
} // namespace physvib
