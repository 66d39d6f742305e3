// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are played in the mixer: a basket is moved by keys, mouse and tilt, a car is driven by keys,
// and the scene's script leaves it to them.
#include "MixerTesting.h"
#include "Scene/SceneFile.h"
#include <algorithm>

namespace physvib::scene_play_test {

using namespace test;

struct Played {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    WorldPanel& panel = view.world();

    explicit Played(const std::string& scene) {
        view.setSize(1440, 900);
        setScene(model, findScene(scene).value);
    }
    float x(const std::string& body) { return view.refresh(), panel.view().pixelOfBody(body).x; }
    bool isSeen(const std::function<bool()>& is) { return runUntil(is); }
    void press(int code) {
        panel.keyPressed(KeyPress{code});
        model.dispatchPendingMessages();
    }
    template <class A>
    A last() {
        const auto& inputs = model.savedSession().log.runs.back().inputs;
        return !inputs.empty() && std::holds_alternative<A>(inputs.back().action)
                   ? std::get<A>(inputs.back().action)
                   : A{};
    }
};

TEST(ScenePlay, ABasketGoesWhileAKeyIsHeldAndToWhereTheMouseIs) {
    Played played{"fruit-basket"};
    ASSERT_TRUE(played.isSeen([&] { return played.x("basket") > 0.0f; }));
    played.press(KeyPress::rightKey);
    EXPECT_TRUE(played.isSeen([&] {
        return played.view.refresh(),
               played.last<VelocityAction>().velocityMetresPerSecond.x == ScenePlayer::maxMetresPerSecond;
    }));
    EXPECT_TRUE(std::ranges::none_of(played.model.mix().scene->script, [](const ScriptInput& input) {
        return std::holds_alternative<VelocityAction>(input.action);
    }));
    const float start = played.x("basket");
    EXPECT_TRUE(played.isSeen([&] { return played.x("basket") > start + 60.0f; }));
    played.panel.keyStateChanged(false);
    EXPECT_EQ(played.last<VelocityAction>().velocityMetresPerSecond.x, 0.0) << "the key is let go";
    auto& world = played.panel.view();
    const auto to = world.pixelOfShare({0.25, 0.5});
    played.panel.mouseDrag(mouseAt(world, to));
    EXPECT_TRUE(played.isSeen([&] { return std::abs(played.x("basket") - to.x) < 12.0f; }))
        << played.x("basket") << " for " << to.x;
    played.panel.mouseUp(mouseAt(world, to));
    EXPECT_EQ(played.last<VelocityAction>().velocityMetresPerSecond.x, 0.0);
    played.model.undoManager().undo();
    EXPECT_TRUE(std::ranges::any_of(played.model.mix().scene->script, [](const ScriptInput& input) {
        return std::holds_alternative<VelocityAction>(input.action);
    })) << "the script plays again";
}

TEST(ScenePlay, ABasketStopsAtTheFieldsEdge) {
    Played played{"fruit-basket"};
    ASSERT_TRUE(played.isSeen([&] { return played.x("basket") > 0.0f; }));
    played.press(KeyPress::leftKey);
    EXPECT_TRUE(played.isSeen([&] {
        return played.x("basket") > 0.0f && played.last<VelocityAction>().velocityMetresPerSecond.x == 0.0;
    })) << "nobody lets the key go";
    EXPECT_GT(played.x("basket"), played.panel.view().pixelOfShare({0.0, 0.0}).x);
}

TEST(ScenePlay, ACarGoesAStepFasterWithEachKey) {
    Played played{"driving"};
    ASSERT_TRUE(played.isSeen([&] { return played.x("car") > 0.0f; }));
    played.press(KeyPress::rightKey);
    EXPECT_TRUE(played.isSeen([&] {
        return played.view.refresh(),
               played.last<MotorAction>().speedRadiansPerSecond == -ScenePlayer::stepRadiansPerSecond;
    }));
    const float start = played.x("car");
    played.press(KeyPress::rightKey);
    EXPECT_EQ(played.last<MotorAction>().speedRadiansPerSecond, -2.0 * ScenePlayer::stepRadiansPerSecond);
    EXPECT_TRUE(played.isSeen([&] { return played.x("car") > start + 20.0f; }));
    played.press(KeyPress::downKey);
    EXPECT_EQ(played.last<MotorAction>().speedRadiansPerSecond, 0.0);
}

} // namespace physvib::scene_play_test
