// SPDX-License-Identifier: GPL-3.0-or-later
// A material or a body that is not felt at usual impacts says so, and one press makes it felt.
#include "Host/FakeAudioDevice.h"
#include "Mixer/Model/MixerDevice.h"
#include "NewSceneRig.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/Drawing/FeltTrial.h"

namespace physvib {
namespace {

using namespace test;

/// A floor that is no haptic source.
struct DullRig : NewSceneRig {
    DullRig() {
        model.change("Dull floor", [&](Mix& mix) {
            auto scene = newScene(*mix.scene, SceneGround::floor);
            for (auto& body : scene.bodies) {
                for (auto& fixture : body.fixtures) fixture.material = 0;
                setSource(scene, body, false);
            }
            mix.scene = std::make_shared<const Scene>(scene);
        });
        settle();
        view.world().drawing().use(DrawTool::ball);
    }
    int soundless() {
        for (int i = 0; i < std::ssize(drawn().materials); ++i)
            if (drawn().materials[static_cast<std::size_t>(i)].frequencyHz <= 0.0) return i;
        return -1;
    }
    juce::Button* button(const juce::String& title) { return dynamic_cast<juce::Button*>(find(view, title)); }
};

TEST(FeltHint, AMaterialThatGivesNothingSaysSoAndIsMadeFelt) {
    DullRig rig;
    const int dull = rig.soundless();
    ASSERT_GE(dull, 0);
    const auto name = utf8(rig.drawn().materials[static_cast<std::size_t>(dull)].name);
    auto* chip = rig.button("Material " + name);
    ASSERT_NE(chip, nullptr);
    EXPECT_TRUE(chip->getTooltip().contains("not felt at usual impacts")) << chip->getTooltip();
    chip->onClick();
    rig.model.dispatchPendingMessages();
    EXPECT_TRUE(rig.model.trouble().startsWith(name + " is not felt at usual impacts: "))
        << rig.model.trouble();
    EXPECT_TRUE(rig.model.trouble().contains("with Select, tick 'haptic source'"))
        << "the world's own explanation, in words of the mixer: " << rig.model.trouble();
    auto* mend = rig.button("Make it felt");
    ASSERT_TRUE(mend != nullptr && mend->isVisible());
    mend->onClick();
    rig.model.dispatchPendingMessages();
    EXPECT_EQ(rig.model.trouble(), "") << "it is felt now";
    EXPECT_GT(rig.drawn().materials[static_cast<std::size_t>(dull)].frequencyHz, 0.0);
    EXPECT_EQ(whyNotFelt(rig.drawn(), dull), "");
    EXPECT_FALSE(rig.button("Material " + name)->getTooltip().contains("not felt"));
    rig.model.undoManager().undo();
    EXPECT_EQ(rig.drawn().materials[static_cast<std::size_t>(dull)].frequencyHz, 0.0) << "one step";
}

TEST(FeltHint, ABodyThatGivesNothingIsMadeAHapticSourceThatVibrates) {
    DullRig rig;
    rig.pane.setMaterial(rig.soundless());
    rig.pane.addAt(DrawTool::ball, rig.share(0.5, 0.5));
    rig.model.dispatchPendingMessages();
    EXPECT_TRUE(rig.model.trouble().startsWith("ball 1 is not felt")) << rig.model.trouble();
    rig.button("Make it felt")->onClick();
    rig.model.dispatchPendingMessages();
    EXPECT_EQ(rig.model.trouble(), "");
    const auto* ball = rig.model.world().drawing().find("ball 1");
    EXPECT_TRUE(ball->fixtures[0].isCamera);
    EXPECT_EQ(whyNotFelt(rig.drawn(), *ball), "");
    rig.model.setSlowness(1);
    const auto hits = rig.model.recent().newestFirst().size();
    EXPECT_TRUE(
        runUntil([&] { return rig.model.look(), rig.model.recent().newestFirst().size() > hits; }, 5.0))
        << "and it is felt when it falls";
}

TEST(FeltHint, GoesWhenAFeltMaterialIsChosen) {
    DullRig rig;
    const auto press = [&](int material) {
        rig.button("Material " + utf8(rig.drawn().materials[static_cast<std::size_t>(material)].name))
            ->onClick();
        rig.model.dispatchPendingMessages();
    };
    press(rig.soundless());
    ASSERT_NE(rig.model.trouble(), "");
    int felt = 0;
    while (!whyNotFelt(rig.drawn(), felt).empty()) ASSERT_LT(++felt, std::ssize(rig.drawn().materials));
    press(felt);
    EXPECT_EQ(rig.model.trouble(), "");
}

TEST(FeltHint, WhatMeetsAFeltWallIsFelt) {
    NewSceneRig rig; // its floor is a haptic source
    for (int i = 0; i < std::ssize(rig.drawn().materials); ++i)
        EXPECT_EQ(whyNotFelt(rig.drawn(), i), "") << rig.drawn().materials[static_cast<std::size_t>(i)].name;
    rig.pane.addAt(DrawTool::ball, rig.share(0.5, 0.5));
    rig.pane.addAt(DrawTool::wall, rig.share(0.2, 0.5));
    EXPECT_EQ(rig.model.trouble(), "");
}

TEST(FeltHint, LevelsThatLetNothingBeFeltAreToldOnceAndNoLongerThanTheyDo) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    const auto told = [&] { return model.dispatchPendingMessages(), model.trouble(); };
    const auto all = [&](auto change) { model.change("All", [&](Mix& mix) { change(mix); }); };
    EXPECT_EQ(told(), "");
    all([](Mix& mix) { mix.levelDb = leastStripDb; });
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
    const auto* const strongest = dynamic_cast<juce::Label*>(find(view, "Strongest hit"));
    EXPECT_TRUE(runUntil([&] {
        return view.refresh(), strongest->getText().contains("every strip is muted");
    })) << strongest->getText();
    all([](Mix& mix) { mix.strips[2].isMuted = false; });
    EXPECT_EQ(told(), "");
    all([](Mix& mix) {
        for (Strip& strip : mix.strips) strip.gainDb = leastStripDb;
    });
    EXPECT_EQ(told(), "Nothing is felt: every strip's fader is down");
    model.undoManager().undo();
    EXPECT_EQ(told(), "");
}

TEST(FeltHint, OutputsThatLetNothingBeFeltAreToldUnlessOneListens) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    MixerView view{model};
    const auto told = [&] { return model.dispatchPendingMessages(), model.trouble(); };
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
    ASSERT_EQ(model.device().listening().monitor({4, 5}, -20.0), "");
    EXPECT_EQ(told(), "") << "it is heard";
}

} // namespace
} // namespace physvib
