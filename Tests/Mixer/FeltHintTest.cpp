// SPDX-License-Identifier: GPL-3.0-or-later
// A material or a body that is not felt at usual impacts says so, and one press makes it felt.
#include "Host/FakeAudioDevice.h"
#include "Mixer/Model/MixerDevice.h"
#include "NewSceneRig.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/Drawing/ImpactTrial.h"

namespace physvib::felt_hint_test {

using namespace test;

/// A floor that is no haptic source.
struct DullWorld : testing::Test, NewSceneRig {
    DullWorld() {
        model.change("Dull floor", [&](Mix& mix) {
            auto scene = newScene(*mix.scene, SceneGround::floor);
            for (auto& body : scene.bodies) {
                for (auto& fixture : body.fixtures) fixture.material = 0;
                setSource(scene, body, false);
            }
            mix.scene = std::make_shared<const Scene>(scene);
        });
        settle();
        view.world().drawing().setTool(DrawTool::ball);
    }
    int soundless() {
        for (int i = 0; i < std::ssize(drawn().materials); ++i)
            if (nth(drawn().materials, i).frequencyHz <= 0.0) return i;
        return -1;
    }
};

TEST_F(DullWorld, AMaterialThatGivesNothingSaysSoAndIsMadeFelt) {
    const int dull = soundless();
    ASSERT_GE(dull, 0);
    const auto name = utf8(nth(drawn().materials, dull).name);
    auto& chip = button("Material " + name);
    EXPECT_TRUE(chip.getTooltip().contains("not felt at usual impacts")) << chip.getTooltip();
    chip.onClick();
    model.dispatchPendingMessages();
    EXPECT_TRUE(model.messageText().startsWith(name + " is not felt at usual impacts: "))
        << model.messageText();
    EXPECT_TRUE(model.messageText().contains("with Select, tick 'haptic source'"))
        << "the world's own explanation, in words of the mixer: " << model.messageText();
    auto& mend = button("Make it felt");
    ASSERT_TRUE(mend.isVisible());
    mend.onClick();
    model.dispatchPendingMessages();
    EXPECT_EQ(model.messageText(), "") << "it is felt now";
    EXPECT_GT(nth(drawn().materials, dull).frequencyHz, 0.0);
    EXPECT_EQ(silentBodyReason(drawn(), dull), "");
    EXPECT_FALSE(button("Material " + name).getTooltip().contains("not felt"));
    undo();
    EXPECT_EQ(nth(drawn().materials, dull).frequencyHz, 0.0) << "one step";
}

TEST_F(DullWorld, ABodyThatGivesNothingIsMadeAHapticSourceThatVibrates) {
    pane.setMaterial(soundless());
    pane.addAt(DrawTool::ball, share(0.5, 0.5));
    model.dispatchPendingMessages();
    EXPECT_TRUE(model.messageText().startsWith("ball 1 is not felt")) << model.messageText();
    button("Make it felt").onClick();
    model.dispatchPendingMessages();
    EXPECT_EQ(model.messageText(), "");
    const auto* ball = body("ball 1");
    EXPECT_TRUE(ball->fixtures[0].isCamera);
    EXPECT_EQ(silentBodyReason(drawn(), *ball), "");
    model.setSlowness(1);
    const auto hits = model.recentContacts().newestFirst().size();
    EXPECT_TRUE(
        runUntil([&] { return model.poll(), model.recentContacts().newestFirst().size() > hits; }, 5.0))
        << "and it is felt when it falls";
}

TEST_F(DullWorld, GoesWhenAFeltMaterialIsChosen) {
    const auto press = [&](int material) {
        button("Material " + utf8(nth(drawn().materials, material).name)).onClick();
        model.dispatchPendingMessages();
    };
    press(soundless());
    ASSERT_NE(model.messageText(), "");
    int felt = 0;
    while (!silentBodyReason(drawn(), felt).empty()) ASSERT_LT(++felt, std::ssize(drawn().materials));
    press(felt);
    EXPECT_EQ(model.messageText(), "");
}

TEST(FeltHint, WhatMeetsAFeltWallIsFelt) {
    NewSceneRig rig; // its floor is a haptic source
    for (int i = 0; i < std::ssize(rig.drawn().materials); ++i)
        EXPECT_EQ(silentBodyReason(rig.drawn(), i), "") << nth(rig.drawn().materials, i).name;
    rig.pane.addAt(DrawTool::ball, rig.share(0.5, 0.5));
    rig.pane.addAt(DrawTool::wall, rig.share(0.2, 0.5));
    EXPECT_EQ(rig.model.messageText(), "");
}

TEST(FeltHint, LevelsThatLetNothingBeFeltAreToldOnceAndNoLongerThanTheyDo) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    const auto told = [&] { return model.dispatchPendingMessages(), model.messageText(); };
    const auto all = [&](auto change) { model.change("All", [&](Mix& mix) { change(mix); }); };
    EXPECT_EQ(told(), "");
    all([](Mix& mix) { mix.levelDb = minStripDb; });
    EXPECT_EQ(told(), "Nothing is felt: the master is at " + number(-60.0, 0) + " dB");
    model.report({}); // dismissed
    all([](Mix& mix) { mix.strips[0].gainDb = -3.0; });
    EXPECT_EQ(told(), "") << "it was read";
    all([](Mix& mix) { mix.levelDb = -59.9; });
    EXPECT_EQ(told(), "");
    for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_EQ(told(), "") << j;
        all([j](Mix& mix) { mix.strips[j].isMuted = true; });
    }
    EXPECT_EQ(told(), "Nothing is felt: every strip is muted");
    const auto& strongest = the<juce::Label>(view, "Strongest hit");
    EXPECT_TRUE(runUntil([&] {
        return view.refresh(), strongest.getText().contains("every strip is muted");
    })) << strongest.getText();
    all([](Mix& mix) { mix.strips[2].isMuted = false; });
    EXPECT_EQ(told(), "");
    all([](Mix& mix) {
        for (Strip& strip : mix.strips) strip.gainDb = minStripDb;
    });
    EXPECT_EQ(told(), "Nothing is felt: every strip's fader is down");
    model.undoManager().undo();
    EXPECT_EQ(told(), "");
}

TEST(FeltHint, OutputsThatLetNothingBeFeltAreToldUnlessOneListens) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    MixerView view{model};
    const auto told = [&] { return model.dispatchPendingMessages(), model.messageText(); };
    const auto only = [&](std::size_t placed) {
        model.change("Outputs", [&](Mix& mix) {
            for (std::size_t j = 0; j < mix.strips.size(); ++j)
                mix.strips[j].output = j < placed ? static_cast<int>(j) : -1,
                mix.strips[j].isMuted = j < placed;
        });
    };
    only(0);
    EXPECT_EQ(told(), "Nothing is felt: no strip has an output");
    only(2);
    EXPECT_EQ(told(), "Nothing is felt: every strip is muted, or has no output");
    ASSERT_EQ(model.device().listening().setMonitor({4, 5}, -20.0), "");
    EXPECT_EQ(told(), "") << "it is heard";
}

} // namespace physvib::felt_hint_test
