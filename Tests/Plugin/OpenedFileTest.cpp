// SPDX-License-Identifier: GPL-3.0-or-later
// Files of one's own in the plug-in: a scene, a layout, a mixer's session; what is wrong changes nothing.
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionFile.h"
#include "PluginFiles.h"
#include "PluginSettings.h"
#include "PluginTesting.h"
#include "Scene/SceneFile.h"

namespace physvib::opened_file_test {

using namespace test;

class PluginFiles : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) {
        const auto file = folder_.getChildFile(name);
        EXPECT_TRUE(file.replaceWithText(text));
        return file.getFullPathName().toStdString();
    }
    OpenedFile open(const std::string& name, const std::string& text, const PluginState& state) {
        auto opened = openFile(write(name, text), state);
        EXPECT_TRUE(opened) << opened.error;
        return std::move(opened.value);
    }
    void SetUp() override { ASSERT_TRUE(folder_.createDirectory().wasOk()); }
    void TearDown() override { folder_.deleteRecursively(); }
    TestHost host_;

private:
    const juce::File folder_ = juce::File::createTempFile("physvib");
};

SavedSession sampleSession() {
    SavedSession session;
    session.run.stepsPerSecond = 200;
    session.channels = 2;
    session.limiterEnabled = false;
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("drop"));
    mix.seed = 11;
    mix.layout = presetLayout("phone2");
    mix.law = PanningLaw::energy;
    mix.exponent = 2.0;
    mix.levelDb = -20.0;
    mix.strips.resize(2);
    mix.strips[0].gainDb = -6.0;
    mix.strips[0].output = 7;
    mix.strips[1].ceilingDb = -9.0;
    session.panner = mix.panner();
    session.equalised[1] = {{205.0, 12.0}, {160.0, 260.0}};
    SceneRun take;
    take.scene = mix.scene;
    take.seed = mix.seed;
    session.log.runs.push_back(take);
    session.mix = mix;
    return session;
}

TEST_F(PluginFiles, ASceneIsPlayedAndNotesThatItHasNoMaterialForAreLeftOut) {
    auto state = host_.plugin->state();
    const auto push = [&state](int note, std::size_t body) {
        return NoteRule{.note = note, .kind = NoteKind::push, .object = state.scene.bodies[body].name};
    };
    state.notes = {{.note = 0, .material = 1}, {.note = 1, .material = 2}, push(2, 1), push(3, 0)};
    Scene own = state.scene;
    own.name = "own";
    own.bodies.resize(1);
    own.bodies[0].fixtures[0].material = 0;
    own.bodies[0].fixtures[0].isCamera = false;
    own.joints.clear();
    own.script.clear();
    own.materials = {state.scene.materials[1]};
    const auto opened = open("scene.json", sceneJson(own), state);
    EXPECT_EQ(opened.state.scene.name, "own");
    ASSERT_EQ(opened.state.notes.size(), 2u);
    EXPECT_EQ(opened.state.notes[0].material, 0) << "the same, at its new place";
    EXPECT_EQ(opened.state.notes[1], state.notes[3]) << "the body that is there";
    EXPECT_TRUE(host_.plugin->edit(opened.state));
    EXPECT_EQ(host_.plugin->errorText(), "");
}

TEST_F(PluginFiles, ALayoutKeepsTheStripsOfThoseThatAreThere) {
    auto state = host_.plugin->state();
    state.strips[0].gainDb = -3.0;
    const auto opened = open("layout.json", layoutJson(presetLayout("ring3")), state);
    EXPECT_EQ(opened.state.layout.name, "ring3");
    ASSERT_EQ(opened.state.strips.size(), 3u);
    EXPECT_EQ(opened.state.strips[0].gainDb, -3.0);
}

TEST_F(PluginFiles, ASessionBringsItsDeskSeedActuatorsAndSteps) {
    const auto session = sampleSession();
    const auto opened = open("session.json", sessionJson(session), host_.plugin->state());
    EXPECT_EQ(opened.note, "session.json: lowered to this instance: the limiter stays on");
    host_.plugin->open(opened.state);
    ASSERT_EQ(host_.plugin->errorText(), "");
    const auto now = host_.plugin->state();
    EXPECT_EQ(now.scene.name, "drop");
    EXPECT_EQ(now.seed, 11u);
    EXPECT_EQ(now.stepsPerSecond, 200);
    EXPECT_EQ(now.layout.name, "phone2");
    EXPECT_TRUE(now.limiterEnabled) << "no file takes it off";
    EXPECT_EQ(now.equalised, session.equalised);
    ASSERT_EQ(now.strips.size(), 2u);
    EXPECT_EQ(now.strips[0].gainDb, -6.0);
    EXPECT_EQ(now.strips[0].output, 0) << "channel j is enchanter j";
    EXPECT_EQ(now.strips[1].ceilingDb, -9.0);
    EXPECT_EQ(host_.plugin->parameter(Parameter::law).value(), static_cast<double>(PanningLaw::energy));
    EXPECT_NEAR(host_.plugin->parameter(Parameter::exponent).value(), 2.0, 1e-6);
    EXPECT_NEAR(host_.plugin->parameter(Parameter::level).value(), -20.0, 1e-4);
}

TEST_F(PluginFiles, NoFileMakesAnythingLouder) {
    auto session = sampleSession();
    session.limiterEnabled = true;
    session.mix->levelDb = -1.0;
    session.mix->strips[0].gainDb = 6.0;
    host_.setToDefault(Parameter::level);
    auto state = host_.plugin->state();
    ASSERT_EQ(state.strips.size(), 4u);
    state.strips[0].ceilingDb = -20.0;
    state.strips[1].isMuted = true;
    const auto opened = open("session.json", sessionJson(session), state);
    EXPECT_EQ(opened.note, "session.json: lowered to this instance: master -1.0 to -12.0 dB; A gain "
                           "6.0 to 0.0 dB; A ceiling 0.0 to -20.0 dB; B muted");
    host_.plugin->open(opened.state);
    EXPECT_NEAR(host_.plugin->parameter(Parameter::level).value(), -12.0, 1e-4);
    EXPECT_EQ(host_.plugin->state().strips[0].ceilingDb, -20.0);
    EXPECT_TRUE(host_.plugin->state().strips[1].isMuted);
    state.strips[1].isMuted = false;
    applyLayoutPreset(state, "phone2");
    const auto wider = open("layout.json", layoutJson(presetLayout("phone4")), state);
    EXPECT_EQ(wider.note, "layout.json: lowered to this instance: C without output 3; D without output 4");
    ASSERT_EQ(wider.state.strips.size(), 4u);
    for (std::size_t j = 0; j < 4; ++j)
        EXPECT_EQ(wider.state.strips[j].isMuted, j > 1) << "nothing was felt there: " << j;
}

TEST_F(PluginFiles, WhatOfASessionIsNotPlayedIsSaid) {
    auto session = sampleSession();
    session.limiterEnabled = true;
    session.shaping.gain = 2.0;
    const auto opened = open("session.json", sessionJson(session), host_.plugin->state());
    EXPECT_EQ(opened.note, "session.json: its method, timing and recordings are not played here");
}

TEST_F(PluginFiles, WhatIsWrongIsNamed) {
    const auto state = host_.plugin->state();
    const auto other = write("other.json", "{ \"answer\": 42 }"),
               broken = write("scene.json", "{ \"physvib_scene\": 1 }");
    EXPECT_EQ(openFile(other, state).error,
              other + ": expected a preset of the plug-in, a scene, a layout or a saved session");
    EXPECT_NE(openFile(broken, state).error.find(broken + ": "), std::string::npos);
}

} // namespace physvib::opened_file_test
