// SPDX-License-Identifier: GPL-3.0-or-later
// Undo, redo, A and B: whole states with their parameters, and SILENCE stays.
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;
using Step = PluginProcessor::Step;

void seed(PluginProcessor& plugin, std::uint32_t number) {
    auto state = plugin.state();
    state.seed = number;
    ASSERT_TRUE(plugin.edit(state));
    std::this_thread::sleep_for(EditHistory::oneStep + std::chrono::milliseconds{20});
}

TEST(EditHistory, GoesBackAndForthAndANewEditForgetsWhatWasUndone) {
    TestHost host;
    auto& plugin = *host.plugin;
    EXPECT_FALSE(plugin.can(Step::undo));
    seed(plugin, 5);
    seed(plugin, 6);
    plugin.go(Step::undo);
    EXPECT_EQ(plugin.state().seed, 5u);
    plugin.go(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    EXPECT_FALSE(plugin.can(Step::undo));
    plugin.go(Step::redo);
    EXPECT_EQ(plugin.state().seed, 5u);
    seed(plugin, 7);
    EXPECT_FALSE(plugin.can(Step::redo));
}

TEST(EditHistory, AKnobIsAStepAndSilenceIsNone) {
    TestHost host;
    auto& level = host.plugin->parameter(Parameter::level);
    const float before = level.getValue();
    level.beginChangeGesture();
    level.setValueNotifyingHost(0.25f);
    level.endChangeGesture();
    auto& bypass = host.plugin->parameter(Parameter::bypass);
    bypass.beginChangeGesture();
    bypass.setValueNotifyingHost(1.0f);
    bypass.endChangeGesture();
    host.plugin->go(Step::undo);
    EXPECT_NEAR(level.getValue(), before, 1e-6f);
    EXPECT_EQ(bypass.getValue(), 1.0f) << "nothing but its button lifts it";
    EXPECT_FALSE(host.plugin->can(Step::undo));
}

TEST(EditHistory, WhatAutomationMovedStaysWhereItIs) {
    TestHost host;
    auto& plugin = *host.plugin;
    auto& tilt = plugin.parameter(Parameter::tilt);
    seed(plugin, 5);
    tilt.setValue(0.75f); // as a host does it, and a controller
    plugin.go(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    EXPECT_EQ(tilt.getValue(), 0.75f);
    tilt.setValue(0.875f);
    plugin.go(Step::redo);
    EXPECT_EQ(tilt.getValue(), 0.875f);
    plugin.go(Step::exchange);
    EXPECT_EQ(tilt.getValue(), 0.875f) << "A and B differ in what a hand has moved";
}

TEST(EditHistory, AProgramIsOneStepWithItsParametersWhoeverChoosesIt) {
    const int bass = presetPlace("Bass");
    for (const bool byHost : {true, false}) {
        TestHost host;
        auto& plugin = *host.plugin;
        auto state = plugin.state();
        state.seed = 4;
        ASSERT_TRUE(plugin.edit(state)); // just before: two steps still
        const double level = plugin.parameter(Parameter::strikeLevel).value();
        if (byHost)
            plugin.setCurrentProgram(bass);
        else
            plugin.choose(bass);
        EXPECT_NE(plugin.parameter(Parameter::strikeLevel).value(), level);
        plugin.go(Step::undo);
        EXPECT_EQ(plugin.state().scene.name, shakenBox().scene.name);
        EXPECT_EQ(plugin.state().seed, 4u);
        EXPECT_NEAR(plugin.parameter(Parameter::strikeLevel).value(), level, 1e-4);
        plugin.go(Step::redo);
        EXPECT_EQ(plugin.state().scene.name, "Bass");
        plugin.go(Step::undo);
        plugin.go(Step::undo);
        EXPECT_EQ(plugin.state().seed, 1u);
        EXPECT_FALSE(plugin.can(Step::undo));
    }
}

TEST(EditHistory, AAndBHaveStepsOfTheirOwn) {
    TestHost host;
    auto& plugin = *host.plugin;
    seed(plugin, 5);
    plugin.go(Step::exchange);
    EXPECT_FALSE(plugin.can(Step::undo)) << "nothing was done at B";
    seed(plugin, 6);
    plugin.go(Step::exchange);
    EXPECT_EQ(plugin.state().seed, 5u);
    plugin.go(Step::undo);
    EXPECT_EQ(plugin.state().seed, 1u);
    plugin.go(Step::exchange);
    EXPECT_EQ(plugin.state().seed, 6u);
    plugin.go(Step::undo);
    EXPECT_EQ(plugin.state().seed, 5u) << "where B began";
}

TEST(EditHistory, AAndBAreTwoStates) {
    TestHost host;
    host.plugin->go(Step::exchange);
    EXPECT_TRUE(host.plugin->isAtB());
    EXPECT_EQ(host.plugin->state().seed, 1u) << "at first the same";
    seed(*host.plugin, 9);
    host.plugin->go(Step::exchange);
    EXPECT_EQ(host.plugin->state().seed, 1u);
    host.plugin->go(Step::exchange);
    EXPECT_EQ(host.plugin->state().seed, 9u);
}

} // namespace
} // namespace physvib
