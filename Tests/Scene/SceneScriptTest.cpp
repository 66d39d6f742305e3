// SPDX-License-Identifier: MIT
// Which action happens in which step.
#include "Scene/SceneEdits.h"
#include "Scene/SceneFields.h"
#include "Scene/World/SceneWorld.h"
#include <array>
#include <gtest/gtest.h>
#include <utility>

namespace physvib::scene_script_test {

ScriptInput tilt(double seconds, double angle, int times = 1, double every = 0.0) {
    return {seconds, times, every, TiltAction{angle}};
}

Scene scripted(std::vector<ScriptInput> script, double periodSeconds = 0.0) {
    Scene scene;
    scene.script = std::move(script);
    scene.scriptPeriodSeconds = periodSeconds;
    return scene;
}

/// The tilts due in the steps from `first` to `last`, as {step, angle}.
using Due = std::vector<std::pair<std::int64_t, double>>;
Due tilts(SceneScript& script, std::int64_t first, std::int64_t last) {
    Due all;
    for (std::int64_t step = first; step <= last; ++step)
        for (DueAction due = script.next(step); due.action != nullptr; due = script.next(step))
            all.emplace_back(step, std::get<TiltAction>(*due.action).angleRadians);
    return all;
}

TEST(SceneScript, InputActsOnceInTheFirstStepAtOrAfterItsTime) {
    const Scene scene = scripted({tilt(0.07, 1.0), tilt(0.501, 2.0)});
    SceneScript script(scene, {100});
    EXPECT_EQ(tilts(script, 0, 10'000), (Due{{7, 1.0}, {51, 2.0}}));
}

TEST(SceneScript, TimesDoNotDependOnTheStepRate) {
    const Scene scene = scripted({tilt(0.07, 1.0)}, 1.0);
    SceneScript script(scene, {1000});
    EXPECT_EQ(tilts(script, 0, 1100), (Due{{70, 1.0}, {1070, 1.0}}));
}

TEST(SceneScript, InputsOfOneStepActInTheirOrder) {
    const Scene scene = scripted({tilt(0.2, 1.0), tilt(0.1, 2.0), tilt(0.2, 3.0), tilt(0.1, 4.0)});
    SceneScript script(scene, {100});
    EXPECT_EQ(tilts(script, 0, 100), (Due{{10, 2.0}, {10, 4.0}, {20, 1.0}, {20, 3.0}}));
}

TEST(SceneScript, RepeatsAfterItsPeriod) {
    const Scene scene = scripted({tilt(0.0, 1.0), tilt(0.5, 2.0)}, 1.0);
    SceneScript script(scene, {100});
    EXPECT_EQ(tilts(script, 0, 260),
              (Due{{0, 1.0}, {50, 2.0}, {100, 1.0}, {150, 2.0}, {200, 1.0}, {250, 2.0}}));
}

TEST(SceneScript, AnInputAtTheEndOfThePeriodIsNotLost) {
    const Scene scene = scripted({tilt(0.0, 1.0), tilt(0.995, 2.0)}, 1.0);
    SceneScript script(scene, {100});
    EXPECT_EQ(tilts(script, 0, 200), (Due{{0, 1.0}, {100, 2.0}, {100, 1.0}, {200, 2.0}, {200, 1.0}}));
}

TEST(SceneScript, RepetitionsAreCounted) {
    const Scene scene = scripted({tilt(0.1, 1.0, 3, 0.2)});
    SceneScript script(scene, {100});
    for (const int i : {0, 1, 2}) {
        EXPECT_EQ(script.next(9 + 20 * i).action, nullptr);
        const DueAction due = script.next(10 + 20 * i);
        EXPECT_EQ(due.action, &scene.script[0].action);
        EXPECT_EQ(due.repetition, i);
        EXPECT_EQ(due.times, 3);
    }
    EXPECT_EQ(script.next(1000).action, nullptr);
}

TEST(SceneScript, StepsThatWereNotAskedForAreCaughtUpWith) {
    const Scene scene = scripted({tilt(0.1, 1.0)}, 0.5);
    SceneScript script(scene, {100});
    EXPECT_EQ(tilts(script, 120, 120), (Due{{120, 1.0}, {120, 1.0}, {120, 1.0}}));
}

TEST(SceneScript, EmptyScriptDoesNothing) {
    const Scene scene = scripted({}, 1.0);
    SceneScript script(scene, {100});
    EXPECT_TRUE(tilts(script, 0, 1000).empty());
}

// Which actions change a scene permanently, and which of a script a user takes over.

using Names = std::vector<std::string_view>;

/// One action of each kind, in the order of actionNames.
const auto actions = []<std::size_t... kinds>(std::index_sequence<kinds...>) {
    return std::array{Action{std::in_place_index<kinds>}...};
}
(std::make_index_sequence<actionNames.size()>{});

TEST(SceneEdits, LastingIsWhatAddsRemovesOrChangesSomethingOfTheScene) {
    Names lasting;
    for (const Action& action : actions)
        if (isLasting(action)) lasting.push_back(actionNames[action.index()]);
    EXPECT_EQ(lasting, (Names{"spawn", "remove", "camera", "material", "sound", "texture", "change", "join",
                              "unjoin"}));
}

TEST(SceneEdits, AScriptLeavesToHandsWhatTheyDo) {
    Scene scene;
    for (const Action& action : actions) scene.script.push_back({0.0, 1, 0.0, action});
    Names left;
    for (const ScriptInput& input : sceneForUserInput(scene).script)
        left.push_back(actionNames[input.action.index()]);
    EXPECT_EQ(left, (Names{"spawn", "remove", "motor", "camera", "material", "sound", "texture", "change",
                           "join", "unjoin"}));
}

// Step times are exact integers at any rate and any length of run.

TEST(StepClock, RoundsEveryStepForItselfSoThatNothingDrifts) {
    const StepClock clock{60};
    EXPECT_EQ(clock.timeNs(1), 16'666'666);
    EXPECT_EQ(clock.timeNs(60), 1'000'000'000);
    EXPECT_EQ(clock.timeNs(60LL * 86'400 * 11), 950'400'000'000'000);
}

TEST(StepClock, DoesNotOverflowInLongRuns) {
    EXPECT_EQ(StepClock{10'000}.timeNs(10'000'000'001LL), 1'000'000'000'100'000);
}

} // namespace physvib::scene_script_test
