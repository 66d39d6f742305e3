// SPDX-License-Identifier: GPL-3.0-or-later
// A person's way through the mixer in a real window: start, drag a ball, attach a fifth enchanter, mute,
// record, save, open again; the recorded file has what the actions say.
#include "../MixerTesting.h"
#include "Host/FakeAudioDevice.h"
#include "Host/Views/EmergencyStop.h"
#include "Host/Views/WorldView.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/SessionRender.h"
#include "Mixer/Knock.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Model/MixerDevice.h"
#include "Mixer/OnlyScript.h"
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/World/DrawPane.h"
#include "Scene/SceneFile.h"
#include "Support/FullDisk.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;

/// The display's own mouse lies beside every window before there is one: what it tells when a window comes,
/// changes its size or goes, whenever that arrives, would release the hand's button.
struct OwnMouse : testing::Environment {
    void SetUp() override { juce::Desktop::setMousePosition({0, 0}); }
};
[[maybe_unused]] const auto* const ownMouse = testing::AddGlobalTestEnvironment(new OwnMouse);

/// A hand with a mouse and a keyboard, on the window's peer.
class Hand {
public:
    /// Waits for what the display tells of a new window: a click before that is lost now and then.
    explicit Hand(MixerWindow& window)
        : window_{window} {
        window.view().setMode(Mode::engineer); // has every control
        runFor(0.3);
    }
    /// What the display tells of the mouse: where it is, with which buttons and keys.
    void move(juce::Point<float> at, int buttons = 0) {
        // keys are told apart from the mouse
        juce::ModifierKeys::currentModifiers = juce::ModifierKeys{buttons}.withoutMouseButtons();
        // not behind what JUCE itself tells of the mouse
        timeMs_ = std::max(timeMs_ + 20, juce::Time::currentTimeMillis());
        window_.getPeer()->handleMouseEvent(juce::MouseInputSource::InputSourceType::mouse, at,
                                            juce::ModifierKeys{buttons}, 0.0f, 0.0f, timeMs_);
        runFor(0.03);
    }
    void click(juce::Component& c) { click(c, c.getLocalBounds().toFloat().getCentre()); }
    void click(juce::Component& c, juce::Point<float> inIt) {
        const auto at = placeOf(c, inIt);
        for (const int buttons : {0, left, 0}) move(at, buttons);
    }
    void longClick(juce::Component& c, juce::Point<float> inIt) {
        move(placeOf(c, inIt), left);
        timeMs_ += 1000;
        move(placeOf(c, inIt));
    }
    void drag(juce::Point<float> from, juce::Point<float> to, int keys = 0) {
        const int pressed = left | keys;
        move(from, keys);
        move(from, pressed);
        for (int k = 1; k <= 10; ++k) move(from + (to - from) * (static_cast<float>(k) / 10.0f), pressed);
        move(to, keys);
    }
    void key(int code, int modifiers = 0) {
        window_.getPeer()->handleKeyPress(KeyPress{code, modifiers, 0});
        runFor(0.05);
    }
    juce::Point<float> placeOf(juce::Component& c, juce::Point<float> inIt) {
        return window_.getLocalPoint(&c, inIt);
    }
    juce::Point<float> middleOf(juce::Component& c) {
        return placeOf(c, c.getLocalBounds().toFloat().getCentre());
    }

private:
    static constexpr int left = juce::ModifierKeys::leftButtonModifier;
    MixerWindow& window_;
    juce::int64 timeMs_ = juce::Time::currentTimeMillis();
};

juce::AudioBuffer<float> samplesOf(const juce::File& file) {
    juce::AudioFormatManager formats;
    formats.registerBasicFormats();
    const std::unique_ptr<juce::AudioFormatReader> reader{formats.createReaderFor(file)};
    if (!reader) return {};
    juce::AudioBuffer<float> samples{static_cast<int>(reader->numChannels),
                                     static_cast<int>(reader->lengthInSamples)};
    reader->read(&samples, 0, samples.getNumSamples(), 0, true, true);
    return samples;
}

constexpr const char* none = "None:no device";

bool isPlayedTo(MixerModel& model, std::int64_t ns = 500'000'000) {
    return runUntil([&] { return model.poll().session.sessionNs > ns; });
}

/// The card for a file, when it is open; throws where none comes.
FileCard& fileCard(MixerWindow& window) {
    FileCard* card = nullptr;
    runUntil([&] { return (card = dynamic_cast<FileCard*>(window.view().card())) != nullptr; });
    return card != nullptr ? *card : throw std::runtime_error{"no card for a file"};
}

/// For windows that have a folder of settings in common.
struct Windows : testing::Test {
    TestFolder folder;
    const juce::File config = folder("config");
};

/// A new session in a window without a device; references are to that session's.
struct Window : Windows {
    MixerWindow window{onlyNoDevice(), none, {}, config};
    Hand hand{window};
    MixerModel& model = window.model();
    MixerView& view = window.view();
    WorldView& world = view.world().view();
    DrawPane& pane = view.world().drawing();

    /// In the test's folder.
    void saveAs(const juce::String& name) {
        auto& card = fileCard(window);
        card.openFolder(folder.folder);
        card.setName(name);
        card.accept();
    }
    juce::Point<float> at(double x, double y) { return hand.placeOf(world, world.pixelOfShare({x, y})); }
    const std::vector<LiveInput>& inputs() { return model.savedSession().log.runs.back().inputs; }
    std::size_t bodies() { return model.world().drawing().drawn().bodies.size(); }
};

TEST_F(Window, ADragOf10MillimetresOfTheScreenIs320NewtonSecondsWhateverTheWindowsSize) {
    model.setSlowness(0);
    model.setDisplayWidth(displayOf(world).getWidth() / 4000.0); // 40 pixels are 10 mm
    model.dispatchPendingMessages();
    std::size_t drags = 0;
    for (const auto& size :
         {juce::Point<int>{1440, 900}, {MixerView::minWidth, MixerView::minHeight}, {1200, 880}}) {
        window.setSize(size.x, size.y);
        runFor(0.2);
        const auto ball = world.pixelOfBody("large rubber ball");
        hand.drag(hand.placeOf(world, ball), hand.placeOf(world, ball + juce::Point<float>{32.0f, -24.0f}));
        const auto& pulls = inputs();
        ASSERT_EQ(pulls.size(), ++drags);
        const auto push = std::get<ImpulseAction>(pulls.back().action).impulseNewtonSeconds;
        EXPECT_NEAR(push.x, 256.0, 0.01) << size.x; // pixels are floats
        EXPECT_NEAR(push.y, 192.0, 0.01) << size.x;
    }
}

TEST_F(Windows, TheMonitorIsOfferedOnceOnTwoOutputsAndKept) {
    FakeInterface speakers;
    speakers.outputs = 2;
    {
        MixerWindow window{fakeDrivers({&speakers}), "Fake:hands", folder("hands.json"), config};
        EXPECT_TRUE(window.model().device().choice().monitorOutputs.empty());
        ASSERT_TRUE(runUntil([&] {
            if (window.model().messageText().contains("no output"))
                window.model().report({}); // it waits behind
            return window.model().messageText().contains("headphones");
        })) << window.model().messageText();
        ASSERT_EQ(window.model().moveOutputsToMonitor({0, 1}, -30.0), "");
        window.save(); // or the next one would ask for it
        runFor(0.7);   // the settings are written twice a second
    }
    MixerWindow again{fakeDrivers({&speakers}), "", {}, config};
    EXPECT_EQ(again.model().device().choice().monitorOutputs, (std::vector{0, 1}));
    EXPECT_EQ(again.model().device().choice().monitorDb, -30.0);
    EXPECT_EQ(again.model().device().listening().settings().contacts, (std::vector{0, 1}))
        << "a new session's enchanters leave them alone";
    runFor(0.7);
    EXPECT_FALSE(again.model().messageText().contains("headphones")) << again.model().messageText();
}

TEST_F(Window, ABodyIsHeldWithShiftUntilTheButtonIsReleased) {
    ASSERT_TRUE(isPlayedTo(model));
    model.setSlowness(0);
    runFor(0.3);
    const auto ball = world.pixelOfBody("large rubber ball");
    ASSERT_TRUE(world.getLocalBounds().toFloat().contains(ball));
    const auto to = ball + juce::Point<float>{-80.0f, 30.0f};
    hand.drag(hand.placeOf(world, ball + juce::Point<float>{5.0f, 0.0f}), hand.placeOf(world, to),
              juce::ModifierKeys::shiftModifier);
    const auto told = inputs();
    ASSERT_GE(told.size(), 3u);
    const Scene& scene = model.world().scene();
    const auto left = world.pixelOfShare({0.0, 0.0}), right = world.pixelOfShare({1.0, 1.0});
    for (std::size_t i = 0; i + 1 < told.size(); ++i) {
        const auto& grip = std::get<GripAction>(told[i].action);
        EXPECT_EQ(grip.body, "large rubber ball");
        ASSERT_TRUE(grip.toMetres && grip.pointMetres) << i << " of " << told.size();
        EXPECT_NEAR(std::hypot(grip.pointMetres->x, grip.pointMetres->y),
                    5.0 / static_cast<double>(right.x - left.x) * scene.fieldWidthMetres, 0.01)
            << "where it was taken, turned with the ball";
        EXPECT_GT(grip.overSeconds, 0.0);
    }
    const auto& last = std::get<GripAction>(told[told.size() - 2].action);
    EXPECT_NEAR(last.toMetres->x,
                static_cast<double>((to.x - left.x) / (right.x - left.x)) * scene.fieldWidthMetres, 0.01)
        << "the last place is told";
    EXPECT_NEAR(last.toMetres->y,
                static_cast<double>((left.y - to.y) / (left.y - right.y)) * scene.fieldHeightMetres, 0.01);
    EXPECT_FALSE(std::get<GripAction>(told.back().action).toMetres.has_value()) << "let go";
    EXPECT_FALSE(world.isHolding());
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(Windows, APersonsWayThroughTheMixer) {
    juce::File wav;
    std::int64_t from = 0, playOut = 0;
    {
        MixerWindow window{onlyNoDevice(), none, folder("hands.json"), config};
        ASSERT_NE(window.getPeer(), nullptr);
        Hand hand{window};
        auto& view = window.view().world().view();
        ASSERT_TRUE(isPlayedTo(window.model()));
        window.model().setSlowness(0); // a ball that lies still is easier to grasp
        runFor(0.3);
        const auto ball = view.pixelOfBody("large rubber ball");
        ASSERT_TRUE(view.getLocalBounds().toFloat().contains(ball));
        hand.drag(hand.placeOf(view, ball), hand.placeOf(view, ball + juce::Point<float>{60.0f, -40.0f}));
        const auto& pulls = window.model().savedSession().log.runs.back().inputs;
        ASSERT_EQ(pulls.size(), 1u);
        const auto& pull = std::get<ImpulseAction>(pulls[0].action);
        EXPECT_EQ(pull.body, "large rubber ball");
        EXPECT_GT(pull.impulseNewtonSeconds.x, 0.0);
        EXPECT_GT(pull.impulseNewtonSeconds.y, 0.0);
        EXPECT_TRUE(window.hasUnsavedChanges());
        window.model().setSlowness(1);
        hand.drag(hand.placeOf(view, view.pixelOfBody("large rubber ball")),
                  hand.placeOf(view, view.pixelOfShare({0.8, 0.5})), juce::ModifierKeys::shiftModifier);
        EXPECT_TRUE(std::holds_alternative<GripAction>(
            window.model().savedSession().log.runs.back().inputs.back().action))
            << "what is held renders again to the bit as well";

        auto* place = find(window.view(), "Attach an actuator");
        ASSERT_NE(place, nullptr);
        hand.drag(hand.middleOf(*place), hand.placeOf(view, view.getLocalBounds().toFloat().getCentre()));
        ASSERT_EQ(window.model().mix().count(), 5);
        const auto& at = window.model().mix().layout.geometry.places[4];
        EXPECT_NEAR(at.xMetres / 0.12, 0.5, 0.05);
        EXPECT_NEAR(at.yMetres / 0.06, 0.5, 0.08);

        auto* ceiling = dynamic_cast<juce::Slider*>(find(window.view(), "Ceiling of A"));
        ASSERT_NE(ceiling, nullptr);
        const auto mark = hand.placeOf(*ceiling, {14.0f, 9.0f});
        hand.drag(mark, mark.translated(0.0f, 40.0f));
        EXPECT_LT(window.model().mix().strips[0].ceilingDb, -15.0);
        EXPECT_GT(window.model().mix().strips[0].ceilingDb, -40.0);
        const double dragged = window.model().mix().strips[0].ceilingDb;
        hand.click(*ceiling);
        hand.click(*ceiling);
        EXPECT_EQ(window.model().mix().strips[0].ceilingDb, dragged) << "a click moves nothing";

        auto* mute = find(window.view(), "Mute B");
        ASSERT_NE(mute, nullptr);
        hand.click(*mute);
        EXPECT_TRUE(window.model().mix().strips[1].isMuted);
        runFor(0.3);

        hand.key('r', juce::ModifierKeys::commandModifier);
        ASSERT_TRUE(window.model().recording().isRunning());
        runUntil([&] { return window.model().recording().seconds() > 4.0; });
        hand.key('r', juce::ModifierKeys::commandModifier);
        ASSERT_TRUE(runUntil([&] { return window.lastRecording() != juce::File{}; }));
        wav = window.lastRecording();
        from = window.model().recording().startFrame();
        playOut = window.model().session().timeline().outputLatencyFrames();
        EXPECT_EQ(window.model().poll().session.render.late, 0u);
        hand.key('s', juce::ModifierKeys::commandModifier);
        EXPECT_FALSE(window.hasUnsavedChanges());
    }
    const auto saved = loadSession(pathOf(folder("hands.json")));
    ASSERT_TRUE(saved) << saved.error;
    const auto recorded = samplesOf(wav);
    ASSERT_EQ(recorded.getNumChannels(), 5);
    EXPECT_EQ(recorded.getMagnitude(1, 0, recorded.getNumSamples()), 0.0f) << "B was muted";
    EXPECT_GT(recorded.getMagnitude(0, recorded.getNumSamples()), 0.0f);
    EXPECT_LE(recorded.getMagnitude(0, 0, recorded.getNumSamples()),
              channelCeiling(saved.value.mix->strips[0]));
    const auto events = loadEventsCsv(pathOf(wav.withFileExtension("csv")));
    ASSERT_TRUE(events) << events.error;
    EXPECT_FALSE(events.value.events.empty());

    // what was recorded is what the saved session renders, to the bit
    const std::int64_t frames = from - playOut + recorded.getNumSamples();
    int wrong = 0;
    std::int64_t done = 0;
    renderOffline(sessionEvents(saved.value, frames * 1'000'000'000 / 48000).events,
                  {{48000, saved.value.channels, saved.value.panner, true, saved.value.ceilings},
                   frames,
                   512,
                   logControls(saved.value.log, true, saved.value.channels)},
                  [&](const float* const* block, int n) {
                      for (int k = 0; k < n; ++k)
                          if (const auto frame = done + k - (from - playOut); frame >= 0)
                              for (int j = 0; j < 5; ++j)
                                  wrong +=
                                      block[j][k] != recorded.getSample(j, static_cast<int>(frame)) ? 1 : 0;
                      done += n;
                      return true;
                  });
    EXPECT_EQ(wrong, 0) << "samples that are not as they were felt";

    MixerWindow again{onlyNoDevice(), none, folder("hands.json"), config};
    EXPECT_EQ(again.model().mix().count(), 5);
    EXPECT_TRUE(again.model().mix().strips[1].isMuted);
    EXPECT_EQ(again.model().messageText(), "");
    EXPECT_FALSE(again.hasUnsavedChanges());
}

TEST_F(Window, WhatIsDrawnAndPlayedByHandIsASceneThatGivesTheSameHits) {
    model.setSlowness(0);
    model.change("Materials", [](Mix& mix) {
        Scene scene = *mix.scene;
        scene.materials.resize(2);
        scene.bodies.clear();
        mix.scene = std::make_shared<const Scene>(scene);
    });
    window.newScene(SceneGround::floor);
    EXPECT_EQ(model.mix().scene->materials, MixerModel::defaultMix().scene->materials)
        << "not of the scene before";
    runFor(0.5);
    const auto draw = [&](DrawTool tool, juce::Point<float> from, juce::Point<float> to) {
        pane.setTool(tool);
        hand.drag(from, to);
        runFor(0.2);
    };
    draw(DrawTool::wall, at(0.05, 0.75), at(0.35, 0.5)); // a slope
    draw(DrawTool::ball, at(0.1, 0.9), at(0.13, 0.9));
    draw(DrawTool::box, at(0.4, 0.14), at(0.75, 0.18)); // a see-saw
    draw(DrawTool::pin, at(0.575, 0.16), at(0.575, 0.16));
    pane.setTool(DrawTool::polygon); // a bell
    for (const auto& corner : {at(0.8, 0.3), at(0.9, 0.3), at(0.85, 0.45)}) hand.drag(corner, corner);
    hand.key(KeyPress::returnKey);
    draw(DrawTool::rope, at(0.85, 0.4), at(0.85, 0.8));
    const auto& drawn = model.world().drawing();
    ASSERT_EQ(bodies(), 5U) << model.messageText();
    ASSERT_EQ(drawn.drawn().joints.size(), 2U) << model.messageText();
    pane.setTool(DrawTool::select);
    pane.select({"polygon 1"});
    runFor(0.2);
    const auto& materials = drawn.drawn().materials;
    ASSERT_GT(materials.back().frequencyHz, 0.0) << "a haptic source has to sound";
    ASSERT_NE(drawn.find("polygon 1")->fixtures[0].material, std::ssize(materials) - 1);
    hand.click(*find(view, "Material " + utf8(materials.back().name)));
    EXPECT_EQ(drawn.find("polygon 1")->fixtures[0].material, std::ssize(materials) - 1)
        << model.messageText();
    runFor(1.0); // its sound is over

    pane.setTool(DrawTool::hand);
    hand.key('r', juce::ModifierKeys::commandModifier);
    ASSERT_TRUE(model.recording().isRunning());
    hand.key('r', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier);
    ASSERT_TRUE(runUntil([&] { return model.script().seconds() > 0.3; }));
    const auto plank = world.pixelOfBody("box 1");
    hand.drag(hand.placeOf(world, plank + juce::Point<float>{40.0f, 0.0f}),
              hand.placeOf(world, plank + juce::Point<float>{40.0f, -60.0f}));
    for (int k = 0; k < 4; ++k) hand.key(KeyPress::leftKey);
    const auto ball = world.pixelOfBody("ball 1");
    hand.drag(hand.placeOf(world, ball), hand.placeOf(world, ball + juce::Point<float>{50.0f, -30.0f}),
              juce::ModifierKeys::shiftModifier);
    ASSERT_TRUE(runUntil([&] { return model.script().seconds() > 3.0; }));
    const std::size_t take = model.savedSession().log.runs.size() - 1;
    hand.key('r', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier);
    ASSERT_NE(model.script().recording(), nullptr) << model.messageText();
    const double length = model.script().recording()->lengthSeconds;
    EXPECT_GT(model.script().recording()->inputs.size(), 5U);
    hand.key('r', juce::ModifierKeys::commandModifier);
    ASSERT_TRUE(runUntil([&] { return window.lastRecording() != juce::File{}; }));
    ASSERT_EQ(window.saveSceneTo(folder("own.json"), false), "");

    const auto scene = loadScene(pathOf(folder("own.json")));
    ASSERT_TRUE(scene) << scene.error;
    const auto rendered =
        simulateScene(scene.value, {model.mix().seed, 100}, static_cast<std::int64_t>(1e9 * length)).events;
    const auto live = loadEventsCsv(pathOf(window.lastRecording().withFileExtension("csv")));
    ASSERT_TRUE(live) << live.error;
    EXPECT_GT(rendered.size(), 2U);
    const auto& recorded = live.value.events;
    ASSERT_GE(recorded.size(), rendered.size());
    const bool hasWaited = !model.savedSession().log.runs[take].stalls.empty();
    std::size_t same = 0;
    for (std::size_t i = 0; i < rendered.size(); ++i) {
        CollisionEvent felt = recorded[i];
        if (!hasWaited)
            EXPECT_EQ(felt.timeNs - rendered[i].timeNs, recorded[0].timeNs - rendered[0].timeNs) << i;
        felt.timeNs = rendered[i].timeNs;
        same += felt == rendered[i] ? 1 : 0;
    }
    EXPECT_EQ(same, rendered.size());
    window.save(); // nothing to be asked
}

/// Four enchanters as loud as a file can ask for, on outputs 1, 2, 3 and 6.
juce::File loudSession(const TestFolder& folder) {
    MixerModel model{onlyNoDevice(), {"None:no device", 0, 0}};
    model.change("loud", [](Mix& mix) {
        mix.levelDb = 0.0;
        for (Strip& strip : mix.strips) strip.gainDb = maxStripDb;
        mix.strips[3].output = 5;
    });
    const auto file = folder("theirs.json");
    EXPECT_EQ(writeFile(pathOf(file), sessionJson(model.savedSession())), "");
    return file;
}

void expectLowered(const Mix& mix) {
    EXPECT_EQ(mix.levelDb, -30.0);
    EXPECT_EQ(mix.strips[0].gainDb, 0.0);
    EXPECT_EQ(mix.strips[0].ceilingDb, -18.0);
    EXPECT_TRUE(mix.strips[1].isMuted);
    EXPECT_EQ(mix.strips[2].output, 2);
    EXPECT_EQ(mix.strips[3].output, -1);
}

TEST_F(Windows, AStrangersSessionIsNoLouderThanTheDeskWas) {
    const auto theirs = loudSession(folder);
    {
        MixerWindow window{onlyNoDevice(), none, folder("mine.json"), config};
        window.model().change("mine", [](Mix& mix) {
            mix.levelDb = -30.0;
            mix.strips[0].ceilingDb = -18.0;
            mix.strips[1].isMuted = true;
        });
        window.save(); // nothing to be asked
        window.model().setSilent(true);
        window.openFile(theirs);
        ASSERT_EQ(window.document(), theirs);
        expectLowered(window.model().mix());
        EXPECT_TRUE(window.model().isSilent()) << "what was silenced by hand stays so";
        const auto told = window.model().messageText();
        EXPECT_TRUE(told.startsWith(
            "Lowered to this desk: master 0.0 to -30.0 dB; A gain 6.0 to 0.0 dB; A ceiling 0.0 to -18.0 dB"))
            << told;
        EXPECT_TRUE(told.contains("D without output 6")) << told;
    }
    MixerWindow again{onlyNoDevice(), none, theirs, config};
    expectLowered(again.model().mix());
    again.newDocument();
    EXPECT_EQ(again.model().mix().strips[3].output, 3) << "what a file took is the user's still";
    EXPECT_EQ(again.model().mix().levelDb, -30.0);
    again.openFile(theirs);
    again.model().messages().current().action.run(); // Levels of the file
    EXPECT_EQ(again.model().mix().levelDb, 0.0);
    EXPECT_EQ(again.model().mix().strips[0].gainDb, maxStripDb);
}

TEST_F(Windows, ASessionOfOnesOwnComesBackAsItWasSavedUnlessItWasChangedSince) {
    const auto mine = folder("mine.json");
    const auto save = [&](const char* name, double levelDb, int output) {
        MixerWindow window{onlyNoDevice(), none, folder(name), config};
        window.model().change("own", [&](Mix& mix) { mix.levelDb = levelDb, mix.strips[3].output = output; });
        window.save();
    };
    const auto opened = [&] {
        MixerWindow window{onlyNoDevice(), none, mine, config};
        return std::pair{window.model().mix().levelDb, window.model().mix().strips[3].output};
    };
    save("mine.json", -3.0, 5);
    save("other.json", -40.0, -1);
    EXPECT_EQ(opened(), (std::pair{-3.0, 5}));
    save("other.json", -40.0, -1);
    mine.appendText("\n"); // as somebody else's
    EXPECT_EQ(opened(), (std::pair{-40.0, -1}));
}

TEST_F(Windows, NoStartIsLouderThanTheMixerWasLeftAndSilenceStays) {
    const auto next = [&](double leftDb, double asksDb, bool isSilent) {
        MixerWindow window{onlyNoDevice(), none, {}, config};
        EXPECT_EQ(window.model().mix().levelDb, asksDb) << "after " << leftDb;
        EXPECT_EQ(window.model().isSilent(), isSilent);
        EXPECT_EQ(window.model().output().isSilent(), isSilent);
        window.newDocument();
        EXPECT_EQ(window.model().mix().levelDb, asksDb) << "new";
        EXPECT_EQ(window.model().isSilent(), isSilent) << "new";
        return window.model().mix().strips;
    };
    const auto leave = [&](double db, bool isSilent) {
        MixerWindow window{onlyNoDevice(), none, folder("left.json"), config};
        window.model().change("Left", [&](Mix& mix) {
            mix.levelDb = db;
            mix.strips[1].gainDb = -20.0;
            mix.strips[2].output = -1; // not felt
        });
        window.model().setSilent(isSilent);
        window.save(); // nothing to be asked
    };
    leave(-24.0, false); // as the first start does
    auto strips = next(-24.0, -24.0, false);
    EXPECT_EQ(strips[1].gainDb, 0.0) << "levels belong to the session that was left";
    EXPECT_EQ(strips[2].output, -1) << "no new output";
    leave(-6.0, true);
    next(-6.0, MixerModel::defaultMix().levelDb, true); // the lower of what was left and what is asked
    folder("left.json").deleteFile();
    leave(-6.0, false);
    next(-6.0, MixerModel::defaultMix().levelDb, false);
}

TEST_F(Windows, AnotherOutputKeepsWhatWasDrawnAndItsUndoSteps) {
    for (const char* answer : {"Do not save", "Save"}) {
        TestFolder own; // a card asks for what the first leaves behind
        MixerWindow window{onlyNoDevice(), none, own("hands.json"), own("config")};
        Hand hand{window};
        auto& view = window.view().world().view();
        window.model().setSlowness(0);
        window.newScene(SceneGround::floor);
        runFor(0.5);
        window.view().world().drawing().setTool(DrawTool::box);
        hand.drag(hand.placeOf(view, view.pixelOfShare({0.4, 0.3})),
                  hand.placeOf(view, view.pixelOfShare({0.6, 0.4})));
        runFor(0.3);
        ASSERT_EQ(window.model().world().drawing().drawn().bodies.size(), 2u) << window.model().messageText();
        const double level = window.model().mix().levelDb;
        window.model().change("Master gain", [](Mix& mix) { mix.levelDb -= 6.0; });
        DeviceChoice other = window.model().device().choice();
        other.sinks = {{"BOARD", "/dev/not-there"}};
        window.model().device().onSinksRequested(other);
        ASSERT_TRUE(runUntil([&] { return window.view().question() != nullptr; }));
        window.view().question()->answer(answer);
        ASSERT_TRUE(runUntil([&] { return window.model().device().choice().sinks.size() == 1; }));
        const auto expect = [&](std::size_t bodies, double levelDb, const juce::String& when) {
            EXPECT_EQ(window.model().world().drawing().drawn().bodies.size(), bodies) << when;
            EXPECT_EQ(window.model().mix().levelDb, levelDb) << when;
        };
        expect(2, level - 6.0, answer);
        auto& undo = window.model().undoManager();
        EXPECT_TRUE(undo.undo());
        expect(2, level, "the fader; what was drawn before it stays");
        EXPECT_TRUE(undo.undo());
        expect(1, level, "the box");
        EXPECT_TRUE(undo.redo() && undo.redo());
        expect(2, level - 6.0, "both");
    }
}

TEST_F(Windows, ASessionSavedPausedOpensPaused) {
    for (const int slowness : {0, 8, 1}) {
        {
            MixerWindow window{onlyNoDevice(), none, folder("hands.json"), config};
            window.model().setSlowness(1);
            ASSERT_TRUE(isPlayedTo(window.model()));
            window.model().setSlowness(slowness);
            runFor(0.5);
            window.save();
        }
        MixerWindow again{onlyNoDevice(), none, folder("hands.json"), config};
        EXPECT_EQ(again.model().session().world().slowness(), slowness == 0 ? 0 : 1) << slowness;
        const auto begun = again.model().session().world().sceneNs();
        runFor(0.3);
        EXPECT_EQ(again.model().session().world().sceneNs() == begun, slowness == 0) << slowness;
    }
}

TEST_F(Windows, ARecordingGoesToTheUsersFolderIsShownAndOverwritesNothing) {
    const auto cwd = folder("elsewhere");
    cwd.createDirectory();
    const auto before = juce::File::getCurrentWorkingDirectory();
    cwd.setAsCurrentWorkingDirectory();
    juce::StringArray names;
    for (int k = 0; k < 2; ++k) {
        MixerWindow window{onlyNoDevice(), none, {}, config};
        window.record();
        ASSERT_TRUE(window.model().recording().isRunning()) << window.model().messageText();
        window.model().eventPlayer().testPulse(0);
        runUntil([&] { return window.model().recording().seconds() > 0.5; });
        reportNoHeadphoneOutput(window.model(), {2, 3}); // waits behind what was recorded
        window.record();
        ASSERT_TRUE(runUntil([&] { return window.lastRecording() != juce::File{}; }));
        const auto documents = juce::File::getSpecialLocation(juce::File::userDocumentsDirectory);
        EXPECT_EQ(window.lastRecording().getParentDirectory(), documents.getChildFile("PhysVib"));
        EXPECT_TRUE(window.model().messageText().contains(window.lastRecording().getFileName()));
        ASSERT_EQ(window.model().messages().current().action.name, "Play");
        window.model().setSlowness(0); // what is felt is the recording
        runFor(0.3);
        const auto inputs = window.model().editCount();
        window.model().messages().current().action.run();
        EXPECT_TRUE(runUntil([&] { return window.model().editCount() > inputs; })) << "it is played";
        names.add(window.lastRecording().getFileName());
        window.model().report({});
        EXPECT_TRUE(window.model().messageText().startsWith("C, D have no output"))
            << window.model().messageText();
    }
    EXPECT_NE(names[0], names[1]);
    EXPECT_EQ(cwd.getNumberOfChildFiles(juce::File::findFilesAndDirectories), 0);
    before.setAsCurrentWorkingDirectory();
}

TEST_F(Window, ARecordingOfNothingSaysSo) {
    const auto record = [&](bool isStruck) {
        const auto last = window.lastRecording();
        window.record();
        if (isStruck) model.eventPlayer().testPulse(0);
        runUntil([&] { return model.recording().seconds() > 0.5; });
        window.record();
        EXPECT_TRUE(runUntil([&] { return window.lastRecording() != last; }));
        return model.messageText();
    };
    model.setSlowness(0);
    bool isSilent = false;
    for (int take = 0; take < 10 && !isSilent; ++take) // what was sent before it stopped rings on
        isSilent = record(false).startsWith("Nothing was played");
    EXPECT_TRUE(isSilent) << model.messageText();
    EXPECT_EQ(model.messages().current().action.name, "Show");
    EXPECT_TRUE(record(true).startsWith("Recorded")) << model.messageText();
    EXPECT_EQ(model.messages().current().action.name, "Play");
}

TEST_F(Window, ShareLeadsWhereAPersonCanGo) {
    window.share();
    ASSERT_NE(view.question(), nullptr);
    auto& files = *view.question();
    EXPECT_EQ(files.getWidth(), QuestionCard::cardWidth) << "no hole for a code";
    if (PageServer::isAvailable())
        EXPECT_TRUE(the<juce::Button>(files, "Serve it here").getToggleState());
    else
        EXPECT_TRUE(files.message().contains("physvib-page")) << files.message();
    for (const char* words : {"Save movie", "Save as scene"})
        EXPECT_TRUE(the<juce::Button>(files, words + ellipsis()).isEnabled()) << words;
    files.answer("Save as scene" + ellipsis());
    auto& saving = fileCard(window);
    EXPECT_FALSE(saving.folder().isAChildOf(config)) << "nobody looks there";
    EXPECT_FALSE(saving.folder().getFullPathName().contains("/."));
    saving.setName("for a friend");
    saving.accept();
    ASSERT_TRUE(runUntil([&] { return model.messageText().contains("for a friend.json"); }));
    window.share();
    view.question()->answer("Other page" + ellipsis());
    ASSERT_TRUE(runUntil([&] {
        auto* next = view.question();
        return next != nullptr && find(*next, "Address of the page") != nullptr;
    }));
    auto* card = view.question();
    runFor(0.1);
    const auto said = [](juce::Component& in) {
        juce::String all;
        const std::function<void(juce::Component&)> read = [&](juce::Component& c) {
            if (const auto* label = dynamic_cast<juce::Label*>(&c)) all << label->getText() << "\n";
            if (const auto* text = dynamic_cast<juce::TextEditor*>(&c)) all << text->getText() << "\n";
            for (auto* child : c.getChildren()) read(*child);
        };
        return read(in), all;
    };
    for (const char* nowhere : {"127.0.0.1", "localhost", "Docs/", ".md"})
        EXPECT_FALSE(said(*card).contains(nowhere)) << said(*card);
    EXPECT_TRUE(card->value("Link").isEmpty()) << "there is no page yet";
    const auto button = [card](const juce::String& words) -> juce::Button& {
        return the<juce::Button>(*card, words);
    };
    EXPECT_FALSE(button("Copy the link").isEnabled());
    EXPECT_TRUE(button("Copy the link").getToggleState());
    EXPECT_TRUE(said(*card).contains("web page")) << said(*card);
    auto& address = the<juce::TextEditor>(*card, "Address of the page");
    const auto places = [&] {
        std::vector<juce::Rectangle<int>> all{card->getLocalBounds(), address.getScreenBounds()};
        for (const juce::String& words : {juce::String{"Copy the link"}, juce::String{"Open it"}})
            all.push_back(button(words).getScreenBounds());
        return all;
    };
    const auto first = places();
    EXPECT_EQ(std::ranges::max_element(first.begin() + 2, first.end(), {}, &juce::Rectangle<int>::getX),
              first.begin() + 2)
        << "what leads on is at the right";
    address.setText("localhost", true);
    ASSERT_TRUE(runUntil([&] { return card->placeholder().contains("leads nowhere"); }));
    EXPECT_EQ(places(), first);
    address.setText("https://example.org/page/", true);
    ASSERT_TRUE(runUntil([&] { return card->picture().isValid(); })) << "a code for a phone";
    EXPECT_TRUE(card->value("Link").startsWith("https://example.org/page/#scene=")) << card->value("Link");
    EXPECT_TRUE(button("Copy the link").isEnabled() && button("Copy the link").getToggleState());
    EXPECT_EQ(places(), first) << "nothing moves while one types";
    EXPECT_TRUE(card->keyPressed(KeyPress{KeyPress::returnKey}));
    ASSERT_TRUE(runUntil([&] { return view.question() == nullptr; }));
    EXPECT_TRUE(model.messageText().startsWith("Copied a link of ")) << model.messageText();
    window.share();
    EXPECT_EQ(view.question()->value("Address of the page"), "https://example.org/page/") << "kept";
}

TEST_F(Window, AFaderGoesWhereItIsDraggedAndAClickBesideItsHandleChangesNothing) {
    model.setSlowness(0);
    model.change("Levels", [](Mix& mix) { mix.strips[1].gainDb = mix.levelDb = -20.0; });
    model.dispatchPendingMessages();
    const auto levelOf = [&](const juce::String& fader) {
        return fader == "Master gain" ? model.mix().levelDb : model.mix().strips[1].gainDb;
    };
    for (const juce::String title : {"Master gain", "Gain of B"}) {
        auto& fader = the<juce::Slider>(view, title);
        const float middle = 0.5f * static_cast<float>(fader.getWidth());
        const auto high = static_cast<float>(fader.getHeight());
        const auto edits = model.editCount();
        for (const float share : {0.1f, 0.25f, 0.4f, 0.8f, 0.95f})
            hand.click(fader, {middle, share * high}), runFor(0.6); // no double click
        EXPECT_EQ(levelOf(title), -20.0) << title;
        EXPECT_EQ(model.editCount(), edits) << title;
        const float handle = fader.getPositionOfValue(-20.0);
        hand.drag(hand.placeOf(fader, {middle, 0.9f * high}),
                  hand.placeOf(fader, {middle, 0.9f * high - 30.0f}));
        EXPECT_NEAR(fader.getPositionOfValue(levelOf(title)), handle - 30.0f, 1.5f)
            << title << ": with the pointer, from any place of the lane";
        for (int k = 0; k < 2; ++k) hand.click(fader, {middle, 0.9f * high});
        EXPECT_EQ(levelOf(title), title == "Master gain" ? -12.0 : 0.0) << title << ": a double click";
    }
}

TEST_F(Window, BehindACardNothingHearsAKeyOrAClickButTheButtonThatSilences) {
    ASSERT_TRUE(runUntil([&] { return model.poll().session.sessionNs > 200'000'000; }));
    model.setSlowness(0);
    const auto drawn = bodies();
    const auto edits = model.editCount();
    auto& slow = *find(view, "Slow motion");
    const struct {
        const char* name;
        std::function<void()> open;
        const char* field;
    } cards[]{
        {"render", [&] { window.renderOffline(); }, "Seconds"},
        {"save", [&] { window.saveAs(); }, "Name of the file"},
        {"open", [&] { window.openDocument(); }, "Name of the file"},
        {"share", [&] { window.share(); }, nullptr},
        {"values",
         [&] {
             askForValues(view.tabs(), "Hits by OSC", "Connect", {{"Address", ""}}, [](auto&) {});
         },
         "Address"},
        {"question",
         [&] {
             view.setQuestion(std::make_unique<QuestionCard>(
                 "Quit?", "Really?", std::vector<QuestionCard::Answer>{{"Yes", [] {}, false}}));
         },
         nullptr},
    };
    for (const auto& card : cards) {
        view.grabKeyboardFocus();
        card.open();
        ASSERT_TRUE(runUntil([&] { return view.openCard() != nullptr; })) << card.name;
        runFor(0.1);
        auto* const opened = view.openCard();
        auto* const focused = juce::Component::getCurrentlyFocusedComponent();
        ASSERT_NE(focused, nullptr) << card.name;
        EXPECT_TRUE(focused == opened || opened->isParentOf(focused)) << card.name << focused->getTitle();
        if (card.field != nullptr) {
            EXPECT_EQ(focused->getTitle(), card.field) << card.name;
            hand.key('a', juce::ModifierKeys::commandModifier);
            hand.key(KeyPress::deleteKey);
            for (const char letter : {'1', '2', '.', '5'})
                window.getPeer()->handleKeyPress(KeyPress{letter, 0, static_cast<juce::juce_wchar>(letter)});
            EXPECT_EQ(dynamic_cast<juce::TextEditor&>(*focused).getText(), "12.5") << card.name;
        }
        for (const int key :
             std::initializer_list<int>{'b', 'n', 'r', 's', 'a', '.', KeyPress::spaceKey, KeyPress::deleteKey,
                                        KeyPress::F10Key, KeyPress::F11Key}) {
            view.keyPressed(KeyPress{key});
            window.keyPressed(KeyPress{key, juce::ModifierKeys::commandModifier, 0});
            window.keyPressed(KeyPress{key});
        }
        for (int k = 0; k < 12; ++k) hand.key(KeyPress::tabKey);
        EXPECT_TRUE(opened->hasKeyboardFocus(true)) << card.name << ": Tab stays in it";
        for (const char* const title : {"Mute A", "Menu", "Attach an actuator"})
            if (auto* const behind = find(view, title);
                !opened->getScreenBounds().contains(behind->getScreenBounds().getCentre()))
                hand.click(*behind);
        EXPECT_FALSE(window.isInterestedInFileDrag({folder("scene.json").getFullPathName()}));
        EXPECT_EQ(view.openCard(), opened) << card.name;
        EXPECT_EQ(model.editCount(), edits) << card.name;
        EXPECT_EQ(bodies(), drawn) << card.name;
        EXPECT_EQ(model.session().world().slowness(), 0) << card.name;
        EXPECT_EQ(view.world().drawing().tool(), DrawTool::hand) << card.name;
        EXPECT_FALSE(view.isShowMode()) << card.name;
        EXPECT_EQ(juce::PopupMenu::dismissAllActiveMenus(), false) << card.name;
        auto& silence = *find(view, "Silence");
        model.setSilent(false);
        auto* const at = window.getComponentAt(hand.middleOf(silence).roundToInt());
        EXPECT_EQ(at, &silence) << card.name
                                << (at != nullptr ? at->getTitle() + at->getName() : juce::String{});
        hand.click(silence);
        EXPECT_TRUE(model.isSilent()) << card.name;
        runFor(0.1);
        EXPECT_TRUE(opened->hasKeyboardFocus(true)) << card.name << ": silence does not take the keyboard";
        model.setSilent(false);
        slow.grabKeyboardFocus(); // as a menu that closes gives it back
        runFor(0.1);
        EXPECT_TRUE(opened->hasKeyboardFocus(true)) << card.name;
        view.setCard(nullptr);
        EXPECT_TRUE(view.hasKeyboardFocus(true)) << card.name;
    }
    hand.click(*find(view, "Mute A"));
    EXPECT_TRUE(model.mix().strips[0].isMuted) << "without a card it does";
}

TEST_F(Window, APressThatClosesAMenuDrawsNothing) {
    model.setSlowness(0);
    window.newScene(SceneGround::floor);
    runFor(0.5);
    pane.setTool(DrawTool::ball);
    const auto before = bodies();
    const auto place = world.pixelOfShare({0.5, 0.5});
    for (const char* title : {"Menu", "Scene"}) {
        hand.click(*find(view, title));
        ASSERT_TRUE(runUntil([] { return juce::Component::getCurrentlyModalComponent() != nullptr; }))
            << title;
        hand.click(world, place);
        EXPECT_EQ(juce::Component::getCurrentlyModalComponent(), nullptr) << title;
        EXPECT_EQ(bodies(), before) << title;
        runFor(0.3);
    }
    hand.click(world, place);
    EXPECT_EQ(bodies(), before + 1) << "the next one does";
}

TEST_F(Windows, EscClosesAMenuAndSilencesWhatSounds) {
    FakeInterface hands;
    MixerWindow window{fakeDrivers({&hands}), "Fake:hands", folder("menu.json"), config};
    Hand hand{window};
    window.model().eventPlayer().testPulse(0);
    for (int k = 0; k < 100; ++k) hands.play(64);
    hand.click(*find(window.view(), "Menu"));
    ASSERT_TRUE(runUntil([] { return juce::Component::getCurrentlyModalComponent() != nullptr; }));
    juce::Component::getCurrentlyModalComponent()->getPeer()->handleKeyPress(KeyPress{KeyPress::escapeKey});
    ASSERT_TRUE(runUntil([] { return juce::Component::getCurrentlyModalComponent() == nullptr; }));
    EXPECT_TRUE(window.model().isSilent()) << "it sounds";
}

TEST_F(Windows, EscClosesACardAndSilencesOnlyWhatSounds) {
    FakeInterface hands;
    MixerWindow window{fakeDrivers({&hands}), "Fake:hands", folder("esc.json"), config};
    Hand hand{window};
    auto& view = window.view();
    auto& model = window.model();
    const auto isSilentAfterACard = [&] {
        window.saveAs();
        runFor(0.1);
        EXPECT_NE(view.openCard(), nullptr);
        hand.key(KeyPress::escapeKey);
        EXPECT_TRUE(runUntil([&] { return view.openCard() == nullptr; }));
        return model.isSilent();
    };
    model.setSlowness(0);
    ASSERT_TRUE(runUntil([&] {
        hands.play(64), view.refresh();
        return std::ranges::all_of(view.snapshot().heldPeaks, [](float hold) { return hold == 0.0f; });
    }));
    EXPECT_FALSE(isSilentAfterACard()) << "nothing sounded";
    model.eventPlayer().testPulse(0);
    for (int k = 0; k < 100; ++k) hands.play(64);
    EXPECT_TRUE(isSilentAfterACard());
    model.setSilent(false);
    hand.key(KeyPress::escapeKey);
    EXPECT_TRUE(model.isSilent()) << "where none is open";
}

TEST_F(Window, EscEndsADragAndAllIsAsBefore) {
    ASSERT_TRUE(isPlayedTo(model));
    model.setSlowness(0);
    runFor(0.3);
    const auto before = model.mix();
    const auto edits = model.editCount();
    const auto escapeDuring = [&](juce::Point<float> from, int keys = 0) {
        const int pressed = juce::ModifierKeys::leftButtonModifier | keys;
        const auto at = hand.placeOf(world, from), to = at + juce::Point<float>{70.0f, 40.0f};
        hand.move(at, keys);
        hand.move(at, pressed);
        for (int k = 1; k <= 5; ++k) hand.move(at + (to - at) * (0.2f * static_cast<float>(k)), pressed);
        EXPECT_TRUE(view.world().isDragging());
        hand.key(KeyPress::escapeKey);
        EXPECT_FALSE(view.world().isDragging());
        hand.move(to + juce::Point<float>{9.0f, 9.0f}, pressed);
        hand.move(to);
        EXPECT_FALSE(model.isSilent()) << "nothing sounded";
    };
    const auto ball = world.pixelOfBody("large rubber ball");
    escapeDuring(ball);
    EXPECT_EQ(model.editCount(), edits) << "thrown";
    escapeDuring(ball, juce::ModifierKeys::shiftModifier);
    EXPECT_FALSE(world.isHolding());
    EXPECT_FALSE(std::get<GripAction>(inputs().back().action).toMetres) << "held";
    escapeDuring(world.actuatorPixel(0));
    EXPECT_EQ(layoutJson(model.mix().layout), layoutJson(before.layout)) << "moved";
    const auto drawn = bodies();
    for (const DrawTool tool : {DrawTool::ball, DrawTool::line, DrawTool::polygon}) {
        pane.setTool(tool);
        escapeDuring(world.pixelOfShare({0.3, 0.7}));
        EXPECT_EQ(bodies(), drawn) << static_cast<int>(tool);
    }
    pane.setTool(DrawTool::select);
    escapeDuring(ball);
    EXPECT_EQ(model.world().drawing().find("large rubber ball")->positionMetres,
              before.scene
                  ->bodies[static_cast<std::size_t>(
                      std::ranges::find(before.scene->bodies, "large rubber ball", &BodyDescription::name) -
                      before.scene->bodies.begin())]
                  .positionMetres);
    hand.key(KeyPress::escapeKey);
    EXPECT_TRUE(model.isSilent()) << "where nothing is dragged";
}

TEST_F(Window, EscSilencesFromACardWhatGoesToAReceiverAlone) {
    OscChoice choice;
    choice.access = OscAccess::thisComputer, choice.receiver = "127.0.0.1:9";
    EXPECT_EQ(model.inputs().configure(choice), "");
    model.eventPlayer().testPulse(0);
    runFor(0.3);
    window.saveAs();
    runFor(0.1);
    hand.key(KeyPress::escapeKey);
    EXPECT_TRUE(runUntil([&] { return view.openCard() == nullptr; }));
    EXPECT_TRUE(model.isSilent());
}

TEST_F(Window, TheRightButtonOfTheMousePressesNoButton) {
    for (const char* const title : {"Mute A", "Attach an actuator", "Solo B", "Record"}) {
        auto* const button = find(view, title);
        ASSERT_NE(button, nullptr) << title;
        const auto at = hand.middleOf(*button);
        for (const int buttons : {0, static_cast<int>(juce::ModifierKeys::rightButtonModifier)})
            hand.move(at, buttons);
        hand.move(at + juce::Point<float>{1.0f, 0.0f}, juce::ModifierKeys::rightButtonModifier);
        hand.move(at);
    }
    EXPECT_EQ(model.mix().count(), 4);
    EXPECT_FALSE(model.mix().strips[0].isMuted);
    EXPECT_FALSE(model.mix().strips[1].isSolo);
    EXPECT_FALSE(model.recording().isRunning());
    hand.click(*find(view, "Solo B"));
    EXPECT_TRUE(model.mix().strips[1].isSolo) << "the left one does";
}

TEST_F(Windows, ANewSessionHasTheDefaultLevelsAndIsNoLouderThanTheLoudestWasLeft) {
    const auto levels = [](const Mix& mix) {
        std::vector<double> all{mix.levelDb};
        for (const Strip& strip : mix.strips) all.push_back(strip.gainDb);
        return all;
    };
    const auto leave = [&](auto change) {
        MixerWindow window{onlyNoDevice(), none, folder("left.json"), config};
        window.model().change("Left", change);
        window.save();
        runFor(0.7); // the settings are written twice a second
    };
    leave([](Mix& mix) { // C where A will be
        assignOutput(mix.strips, 2, 0);
        mix.strips[2].gainDb = -27.7;
    });
    {
        MixerWindow window{onlyNoDevice(), none, {}, config};
        EXPECT_EQ(levels(window.model().mix()), (std::vector{-12.0, 0.0, 0.0, 0.0, 0.0}));
    }
    leave([](Mix& mix) {
        for (Strip& strip : mix.strips) strip.gainDb = -20.0;
    });
    MixerWindow window{onlyNoDevice(), none, {}, config};
    EXPECT_EQ(levels(window.model().mix()), (std::vector{-32.0, 0.0, 0.0, 0.0, 0.0}));
}

TEST_F(Windows, ARouteThatWasChosenIsKeptByTheNextSessions) {
    FakeInterface hands; // of eight outputs
    const auto routes = [](MixerWindow& window) {
        std::vector<int> all;
        for (const Strip& strip : window.model().mix().strips) all.push_back(strip.output);
        return all;
    };
    {
        MixerWindow window{fakeDrivers({&hands}), "Fake:hands", folder("left.json"), config};
        window.model().change("Output", [](Mix& mix) { assignOutput(mix.strips, 0, 5); });
        window.save();
        runFor(0.7); // the settings are written twice a second
        window.newDocument();
        EXPECT_EQ(routes(window), (std::vector{5, 1, 2, 3})) << "new";
    }
    for (const char* device : {"", none, "Fake:hands"}) {
        MixerWindow window{fakeDrivers({&hands}), device, {}, config};
        EXPECT_EQ(routes(window), (std::vector{5, 1, 2, 3})) << device;
        runFor(0.7);
    }
    {
        MixerWindow window{fakeDrivers({&hands}), "", folder("left.json"), config};
        window.model().change("Preset", [](Mix& mix) {
            setLayout(mix, "phone2");
            assignOutput(mix.strips, 1, 2);
        });
        window.save();
    }
    MixerWindow window{fakeDrivers({&hands}), "", {}, config};
    EXPECT_EQ(routes(window), (std::vector{5, 2, -1, -1})) << "no output that was not in use";
}

TEST_F(Windows, OnHeadphonesASessionForOtherOutputsIsHeardOnBothEarsAndTheNextStartsAreNoLower) {
    FakeInterface hands; // of eight outputs
    const auto mine = folder("mine.json");
    {
        MixerWindow window{fakeDrivers({&hands}), "Fake:hands", mine, config};
        window.model().change("Mine", [](Mix& mix) {
            assignOutput(mix.strips, 0, 5);
            mix.strips[1].gainDb = -19.5;
        });
        window.save();
        ASSERT_EQ(openHeadphones(window.model(), window.model().device().choice()), "");
        window.save();
        runFor(0.7);
    }
    const auto theirs = folder("theirs.json");
    {
        auto session = loadSession(pathOf(mine));
        ASSERT_TRUE(session) << session.error;
        for (std::size_t j = 0; j < 4; ++j)
            session.value.mix->strips[j].output = j == 0 ? 5 : static_cast<int>(j);
        ASSERT_EQ(writeFile(pathOf(theirs), sessionJson(session.value)), "");
    }
    {
        MixerWindow window{fakeDrivers({&hands}), "", theirs, config};
        const auto& strips = window.model().mix().strips;
        ASSERT_EQ(strips.size(), 4u);
        EXPECT_EQ(strips[0].output, 0);
        EXPECT_EQ(strips[1].output, 1);
        EXPECT_EQ(strips[2].output, -1);
        EXPECT_EQ(strips[3].output, -1);
        EXPECT_EQ(strips[1].gainDb, -19.5);
        EXPECT_EQ(window.model().mix().levelDb, defaultContactDb);
        EXPECT_FALSE(window.model().messageText().contains("without")) << window.model().messageText();
        runFor(0.7);
    }
    for (int start = 0; start < 3; ++start) {
        MixerWindow window{fakeDrivers({&hands}), "", {}, config};
        EXPECT_EQ(window.model().mix().levelDb, defaultContactDb) << start;
        EXPECT_EQ(window.model().output().channelMap(), (std::vector{0, 1})) << start;
        runFor(0.7);
    }
}

TEST_F(Windows, HeadphonesAreKept) {
    FakeInterface hands; // of eight outputs
    {
        MixerWindow window{fakeDrivers({&hands}), "Fake:hands", folder("ears.json"), config};
        ASSERT_EQ(openHeadphones(window.model(), window.model().device().choice()), "");
        window.save();
        runFor(0.7);
    }
    {
        MixerWindow again{fakeDrivers({&hands}), "", {}, config};
        EXPECT_TRUE(again.model().device().choice().isHeadphones);
        EXPECT_EQ(again.model().output().channelMap(), (std::vector{0, 1})) << "two actuators";
        EXPECT_EQ(again.model().mix().levelDb, defaultContactDb);
        DeviceChoice actuators = again.model().device().choice();
        EXPECT_EQ(actuators.outputsBeforeHeadphones, (std::vector{0, 1, 2, 3})) << "of the session before";
        runFor(0.7);
    }
    MixerWindow asked{fakeDrivers({&hands}), "Fake:hands", {}, config};
    EXPECT_FALSE(asked.model().device().choice().isHeadphones) << "a device that is asked for has actuators";
    EXPECT_EQ(asked.model().output().channelMap(), (std::vector{0, 1, 2, 3})) << "all of them";
}

TEST_F(Windows, AfterHeadphonesOfTheFirstStartEveryActuatorHasAnOutput) {
    FakeInterface hands; // of eight outputs
    {
        MixerWindow window{fakeDrivers({&hands}), none, folder("a.json"), config};
        auto& model = window.model();
        FirstStart card{model, {{"Headphones: Fake:hands", {"Fake:hands"}, 8, false, true}}};
        card.keyPressed(KeyPress{KeyPress::returnKey});
        ASSERT_EQ(model.output().channelMap(), (std::vector{0, 1}));
        ASSERT_EQ(model.open({.name = "Fake:hands",
                              .outputsBeforeHeadphones = model.device().choice().outputsBeforeHeadphones}),
                  "");
        window.save();
        runFor(0.7);
    }
    MixerWindow next{fakeDrivers({&hands}), "", {}, config};
    EXPECT_EQ(next.model().output().channelMap(), (std::vector{0, 1, 2, 3}));
}

TEST_F(Windows, ALayoutOfMoreEnchantersIsFeltWhereSomebodySaysSo) {
    const auto file = folder("eight.json");
    ActuatorLayout eight = presetLayout("phone4").geometry;
    for (; eight.count < 8; ++eight.count) nth(eight.places, eight.count) = {0.01 * eight.count, 0.01};
    ASSERT_EQ(writeFile(pathOf(file), layoutJson(describeLayout("eight", eight))), "");
    MixerWindow window{onlyNoDevice(), none, {}, config};
    window.openFile(file);
    const auto& strips = window.model().mix().strips;
    ASSERT_EQ(strips.size(), 8u);
    for (std::size_t j = 0; j < 8; ++j) EXPECT_EQ(strips[j].output, j < 4 ? static_cast<int>(j) : -1);
    EXPECT_TRUE(window.model().messageText().contains("E without output 5")) << window.model().messageText();
    window.model().undoManager().undo();
    EXPECT_EQ(window.model().mix().strips.size(), 4u);
}

TEST_F(Windows, ARecordingIsDroppedOnTheMaterialsAndFeltWhereOneClicks) {
    ASSERT_TRUE(writeKnock(folder("knock.wav")));
    MixerWindow window{onlyNoDevice(), none, folder("materials.json"), config};
    Hand hand{window};
    hand.click(*find(window.view().tabs(), "Materials"));
    auto& tab = *window.view().tabs().find<MaterialsTab>();
    ASSERT_TRUE(runUntil([&] { return tab.isShowing(); }));
    auto& plot = *find(tab, "Spectrum of the material");
    const juce::ComponentPeer::DragInfo drop{
        {folder("knock.wav").getFullPathName()}, {}, hand.middleOf(plot).toInt()};
    EXPECT_TRUE(window.getPeer()->handleDragMove(drop));
    window.getPeer()->handleDragDrop(drop);
    const auto& concrete = window.model().world().scene().materials[3]; // the first that sounds is chosen
    ASSERT_TRUE(runUntil([&] { return concrete.frequencyHz != 80.0; })) << window.model().messageText();
    EXPECT_NEAR(concrete.frequencyHz, 352.0, 0.5);
    EXPECT_NEAR(concrete.decayPerSecond, 98.0, 2.0);

    auto& world = window.view().world().view();
    hand.click(world, world.pixelOfShare({0.25, 0.75}));
    hand.longClick(world, world.pixelOfShare({0.75, 0.25}));
    auto& feel = *find(tab, "Feel the material at the spot");
    feel.grabKeyboardFocus();
    hand.key(KeyPress::returnKey);
    const auto& strikes = window.model().savedSession().log.strikes;
    ASSERT_EQ(strikes.size(), 3u);
    EXPECT_EQ(strikes[0].frequencyHz, concrete.frequencyHz);
    EXPECT_NEAR(strikes[0].x / window.model().world().scene().fieldWidthMetres, 0.25, 0.01);
    EXPECT_NEAR(strikes[0].y / window.model().world().scene().fieldHeightMetres, 0.75, 0.01);
    EXPECT_NEAR(strikes[1].x / window.model().world().scene().fieldWidthMetres, 0.75, 0.01)
        << "a long press is a click";
    EXPECT_EQ(strikes[2].x, strikes[1].x);
    hand.key('z', juce::ModifierKeys::commandModifier);
    EXPECT_EQ(concrete.frequencyHz, 80.0);
    hand.key('z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier);

    hand.key('s', juce::ModifierKeys::commandModifier);
    MixerWindow again{onlyNoDevice(), none, folder("materials.json"), config};
    EXPECT_EQ(again.model().mix().scene->materials[3].frequencyHz, concrete.frequencyHz);
}

TEST_F(Windows, ABrokenSessionIsNamedAndNothingIsLost) {
    folder("broken.json").replaceWithText(R"({"physvib_session": 2, "seconds": -1})");
    MixerWindow window{onlyNoDevice(), none, {}, config};
    window.model().change("Law", [](Mix& mix) { mix.law = PanningLaw::energy; });
    window.model().undoManager().undo();
    MixerWindow broken{onlyNoDevice(), none, folder("broken.json"), config};
    EXPECT_TRUE(broken.model().messageText().contains("broken.json: seconds: expected a number from 0 to "))
        << broken.model().messageText();
    EXPECT_EQ(broken.document(), juce::File{}) << "saving would replace the broken file";
    EXPECT_TRUE(runUntil([&] { return broken.model().poll().session.render.played > 3; }))
        << "the mixer plays on";
}

TEST_F(Windows, SceneLayoutAndSessionFilesAreOpenedByNameAndByDrop) {
    Scene scene = *findBuiltInScene("drop");
    scene.name = "mine";
    folder("scene.json").replaceWithText(sceneJson(scene));
    folder("layout.json")
        .replaceWithText(layoutJson(describeLayout("three", presetLayout("ring3").geometry)));
    folder("other.json").replaceWithText("{}");
    const auto start = [&](const char* name) {
        return std::make_unique<MixerWindow>(onlyNoDevice(), none, folder(name), config);
    };
    auto window = start("scene.json");
    EXPECT_EQ(window->model().mix().scene->name, "mine");
    EXPECT_EQ(window->document(), juce::File{}) << "saving would replace the scene";
    EXPECT_FALSE(window->hasUnsavedChanges());
    window = start("layout.json");
    EXPECT_EQ(window->model().mix().count(), 3);
    EXPECT_EQ(window->model().mix().strips.size(), 3u);
    window = start("other.json");
    EXPECT_TRUE(window->model().messageText().endsWith("other.json: expected a session, a scene or a layout"))
        << window->model().messageText();
    window->model().report({});

    const auto drop = [&](const char* name) {
        const juce::StringArray files{folder(name).getFullPathName()};
        EXPECT_TRUE(window->isInterestedInFileDrag(files));
        window->fileDragEnter(files, 100, 100);
        window->filesDropped(files, 100, 100);
    };
    EXPECT_FALSE(window->isInterestedInFileDrag({folder("take.wav").getFullPathName()}))
        << "recordings are for others";
    drop("other.json");
    EXPECT_TRUE(window->model().messageText().contains("other.json"));
    drop("scene.json");
    EXPECT_EQ(window->model().mix().scene->name, "mine");
    drop("layout.json");
    EXPECT_EQ(window->model().mix().count(), 3);
    window->model().undoManager().undo();
    window->model().undoManager().undo();
    EXPECT_EQ(window->model().mix().scene->name, "shake-the-box");
    EXPECT_EQ(window->model().mix().count(), 4);

    window->model().change("Level", [](Mix& mix) { mix.levelDb = -30.0; });
    folder("session.json").replaceWithText(sessionJson(window->model().savedSession()));
    window = start("session.json");
    EXPECT_EQ(window->model().mix().levelDb, -30.0);
    EXPECT_EQ(window->document(), folder("session.json"));
}

TEST_F(Window, ARenderIsAsLongAsWantedWhileTheSessionGoesOnAndACancelledOneLeavesNothing) {
    ASSERT_TRUE(isPlayedTo(model));
    const auto before = model.poll().session.sessionNs;
    window.renderTo(folder("long.wav"), 20.0);
    ASSERT_TRUE(runUntil([&] { return model.isInfo() && model.messageText().contains("long.wav"); }, 60.0))
        << model.messageText();
    EXPECT_GT(model.poll().session.sessionNs, before);
    const auto samples = samplesOf(folder("long.wav"));
    EXPECT_EQ(samples.getNumSamples(), 20 * 48000);
    EXPECT_GT(samples.getMagnitude(18 * 48000, 2 * 48000), 0.0f) << "the box is shaken on";

    window.renderTo(folder("cancelled.wav"), 86'400.0);
    auto& cancel = the<juce::Button>(view, "Cancel the making of the file");
    EXPECT_EQ(juce::Component::getCurrentlyModalComponent(), nullptr) << "the mixer can be used meanwhile";
    runFor(0.3);
    window.renderTo(folder("second.wav"), 1.0);
    EXPECT_TRUE(model.messageText().contains("cancelled.wav")) << "one at a time: " << model.messageText();
    cancel.onClick();
    EXPECT_TRUE(runUntil([&] { return model.messageText().contains("nothing was written"); }))
        << model.messageText();
    EXPECT_EQ(find(view, "Progress"), nullptr);
    EXPECT_EQ(folder.folder.getNumberOfChildFiles(juce::File::findFiles, "*cancelled*"), 0);
}

TEST_F(Window, AMovieIsAsLongAsWantedAndOnAFullDiskOneLineSaysSoAndAllGoesOn) {
    const OnlyScript ffmpeg{
        folder, "ffmpeg", // the pictures become the movie
        "for word; do case $before in -i) [ \"$first\" ] || first=$word;; esac; before=$word; "
        "done\ncat \"$first\" >\"$word\"\n"};
    ASSERT_TRUE(runUntil([&] { return model.poll().session.sessionNs > 2'500'000'000; }));
    const auto ask = [&](const char* seconds) {
        window.saveMovie();
        EXPECT_GE(view.question()->value("Seconds").getDoubleValue(), 2.5) << "all of it";
        view.question()->setValue("Seconds", seconds);
        view.question()->answer("Choose a file" + ellipsis());
    };
    ask("601");
    ASSERT_TRUE(runUntil([&] { return model.messageText().contains("expected 1 to 600"); }))
        << model.messageText();
    EXPECT_EQ(view.card(), nullptr);
    model.report({}); // news wait behind trouble
    ask("1.0");
    saveAs("short");
    const auto movie = folder("short.mp4");
    ASSERT_TRUE(runUntil([&] { return model.isInfo() && model.messageText().contains("short.mp4"); }, 60.0));
    juce::MemoryBlock bytes;
    movie.loadFileAsData(bytes);
    const std::string_view text{static_cast<const char*>(bytes.getData()), bytes.getSize()};
    int pictures = 0;
    for (auto at = text.find("IEND"); at != std::string_view::npos; at = text.find("IEND", at + 4))
        ++pictures;
    EXPECT_EQ(pictures, 20) << "a second";

    const auto before = model.poll().session.sessionNs;
    {
        const FileSizeLimit full{20'000};
        window.saveMovieTo(folder("full.mp4"), 2.0);
        const auto told = folder("full.mp4").getFullPathName() + ": cannot be written";
        ASSERT_TRUE(runUntil([&] { return model.messageText().contains(told); }, 60.0))
            << model.messageText();
        EXPECT_FALSE(model.isInfo());
    }
    EXPECT_EQ(folder.folder.getNumberOfChildFiles(juce::File::findFiles, "full*"), 0);
    EXPECT_TRUE(movie.existsAsFile());
    EXPECT_EQ(find(view, "Progress"), nullptr);
    EXPECT_TRUE(runUntil([&] { return model.poll().session.sessionNs > before + 500'000'000; }));
}

/// A folder as a crash leaves it: a copy of a session at -30 dB, settings of a model that was then turned
/// down to -40 dB, 12.5 g^2 s felt.
struct AfterACrash : TestFolder {
    juce::File copy = folder.getChildFile("after/recovery-99999999.json"); // of a process that is not there
    AfterACrash() {
        MixerWindow window{onlyNoDevice(), "None:no device", folder.getChildFile("mine.json"),
                           folder.getChildFile("config")};
        window.model().exposure().addEarlierExposure(12.5);
        const auto change = [&](double levelDb) {
            window.model().change("Level", [levelDb](Mix& mix) { mix.levelDb = levelDb; });
        };
        const auto copies = [&] {
            return folder.getChildFile("config").findChildFiles(juce::File::findFiles, false,
                                                                "recovery-*.json");
        };
        change(-30.0);
        runUntil([&] { return !copies().isEmpty(); });
        copy.getParentDirectory().createDirectory();
        copies()[0].copyFileTo(copy);
        change(-40.0);
        runFor(1.5); // the settings are written twice a second
        folder.getChildFile("config/mixer.settings").copyFileTo(folder.getChildFile("after/mixer.settings"));
        window.save(); // nothing to be asked
    }
};

TEST_F(Windows, AfterACrashItAsksInTheWindowAndLevelAndExposureStay) {
    AfterACrash crash;
    ASSERT_TRUE(crash.copy.existsAsFile());
    for (const bool isTakenUp : {false, true}) {
        TestFolder again;
        crash.folder.getChildFile("after").copyDirectoryTo(again("config"));
        MixerWindow window{onlyNoDevice(), none, {}, again("config")};
        auto* question = window.view().question();
        ASSERT_NE(question, nullptr);
        EXPECT_EQ(window.view().firstStart(), nullptr) << "one question at a time";
        const auto beside = window.view().getLocalArea(question, question->getLocalBounds()).getCentre() -
                            window.view().getLocalBounds().getCentre();
        EXPECT_LE(std::abs(beside.x), 1) << "in the middle";
        EXPECT_EQ(window.model().mix().levelDb, -40.0) << "before it is answered";
        EXPECT_GE(window.model().exposure().squareGSeconds(), 12.5) << "hands have felt that today";
        question->answer(isTakenUp ? "Take it up" : "Discard it");
        ASSERT_TRUE(runUntil([&] { return !again("config/recovery-99999999.json").existsAsFile(); }));
        EXPECT_EQ(window.model().mix().levelDb, -40.0)
            << (isTakenUp ? "the copy is older than the desk was" : "discarded");
        EXPECT_GE(window.model().exposure().squareGSeconds(), 12.5);
        EXPECT_EQ(window.view().question(), nullptr);
        EXPECT_EQ(window.hasUnsavedChanges(), isTakenUp);
    }
}

TEST_F(Windows, ZoomAndDividersAreKeptAndAnUnsavedSessionIsAskedForInTheWindow) {
    {
        MixerWindow window{onlyNoDevice(), none, folder("zoom.json"), config};
        window.setZoom(125);
        EXPECT_NEAR(juce::Desktop::getInstance().getGlobalScaleFactor(), 1.25f, 1e-4f);
        EXPECT_GE(window.view().getWidth(), MixerView::minWidth);
        window.setZoom(60);
        EXPECT_LE(window.getConstrainer()->getMinimumWidth(), 640) << "for the smallest display";
        window.setZoom(200); // leaves no room on this display
        EXPECT_LT(juce::Desktop::getInstance().getGlobalScaleFactor(), 1.6f);
        window.setZoom(125);
        constexpr auto ctrl = juce::ModifierKeys::commandModifier;
        window.keyPressed(KeyPress{'-', ctrl, '-'});
        EXPECT_EQ(window.zoom(), 100);
        window.keyPressed(KeyPress{'+', ctrl | juce::ModifierKeys::shiftModifier, '+'});
        EXPECT_EQ(window.zoom(), 125);
        window.keyPressed(KeyPress{'0', ctrl, 0});
        EXPECT_EQ(window.zoom(), 0) << "by the display";
        window.setZoom(125);
        window.keyPressed(KeyPress{KeyPress::F11Key});
        EXPECT_TRUE(window.view().isShowMode());
        window.keyPressed(KeyPress{KeyPress::escapeKey});
        EXPECT_TRUE(window.view().isShowMode() && window.model().isSilent()) << "Esc only silences";
        window.keyPressed(KeyPress{KeyPress::F11Key});
        EXPECT_FALSE(window.view().isShowMode());
        window.model().setSilent(false);
        window.view().setDividers({0.5, 0.4, 0.6});
        runFor(1.2); // the settings are written twice a second
        window.model().change("Level", [](Mix& mix) { mix.levelDb = -18.0; });
        window.newDocument();
        ASSERT_NE(window.view().question(), nullptr);
        EXPECT_EQ(juce::Component::getCurrentlyModalComponent(), nullptr);
        window.view().question()->answer("Cancel");
        EXPECT_TRUE(runUntil([&] { return window.view().question() == nullptr; }));
        EXPECT_TRUE(window.hasUnsavedChanges());
        window.view().tabs().choose("Output");
        chooseIn(window.view(), "Device", "Game controller: none is plugged in");
        window.model().messages().current().action.run();
        ASSERT_TRUE(runUntil([&] { return window.view().question() != nullptr; }));
        EXPECT_EQ(the<juce::ComboBox>(window.view(), "Device").getText(), "No device: seen, not felt")
            << "until the question is answered";
        window.view().question()->answer("Do not save");
        ASSERT_TRUE(runUntil([&] { return !window.model().device().choice().sinks.empty(); }));
        EXPECT_TRUE(window.hasUnsavedChanges()) << "its mix is in no file";
        window.setShowMode(true);
        EXPECT_EQ(window.view().world().getBounds(), window.view().getLocalBounds());
        window.setShowMode(false);
    }
    MixerWindow again{onlyNoDevice(), none, folder("zoom.json"), config};
    EXPECT_EQ(again.zoom(), 125);
    EXPECT_EQ(again.view().dividers(), (Dividers{0.5, 0.4, 0.6}));
    again.setZoom(0);
    EXPECT_NEAR(juce::Desktop::getInstance().getGlobalScaleFactor(), 1.0f, 1e-4f);
}

TEST_F(Window, WhoSavesAtAQuestionGoesOnOnceItIsSaved) {
    window.model().change("Level", [](Mix& mix) { mix.levelDb = -18.0; });
    window.newDocument();
    ASSERT_NE(window.view().question(), nullptr);
    window.view().question()->answer("Save");
    fileCard(window);
    EXPECT_EQ(window.model().mix().levelDb, -18.0) << "not before it is saved";
    saveAs("kept");
    ASSERT_TRUE(runUntil([&] { return folder("kept.json").existsAsFile() && !window.hasUnsavedChanges(); }));
    EXPECT_TRUE(runUntil([&] { return !window.model().undoManager().canUndo(); })) << "a new session";
    EXPECT_EQ(window.document(), juce::File{});
    EXPECT_TRUE(window.model().messageText().contains("kept.json")) << window.model().messageText();
    EXPECT_EQ(window.model().messages().current().action.name, "Show");

    window.model().change("Level", [](Mix& mix) { mix.levelDb = -20.0; });
    window.newDocument(); // who gives up at the file stays
    window.view().question()->answer("Save");
    fileCard(window).onCancel();
    ASSERT_TRUE(runUntil([&] { return window.view().card() == nullptr; }));
    EXPECT_EQ(window.model().mix().levelDb, -20.0);
    EXPECT_TRUE(window.hasUnsavedChanges());
}

TEST_F(Window, ACardOfTheMenuHasTheKeysAndTheWorldHasThemAfterIt) {
    const auto menu = [] { return juce::Component::getCurrentlyModalComponent(); };
    const auto choose = [&](int menuFromTheEnd, int fromTheEnd) {
        hand.click(*find(view, "Menu"));
        ASSERT_TRUE(runUntil([&] { return menu() != nullptr; }));
        menu()->getPeer()->toFront(true); // as a press on an item does: the window loses the keys
        runFor(0.3);
        const auto up = [&](int times) {
            for (int k = 0; k < times; ++k) menu()->getPeer()->handleKeyPress(KeyPress{KeyPress::upKey});
        };
        up(menuFromTheEnd);
        menu()->getPeer()->handleKeyPress(KeyPress{KeyPress::rightKey});
        runFor(0.1);
        up(fromTheEnd); // the first item is chosen as it opens
        menu()->getPeer()->handleKeyPress(KeyPress{KeyPress::returnKey});
        ASSERT_TRUE(runUntil([&] { return menu() == nullptr; }));
        runFor(0.3);
    };
    choose(2, 1); // View: Width of the display
    ASSERT_NE(view.card(), nullptr);
    EXPECT_TRUE(view.card()->hasKeyboardFocus(true)) << "though the menu gives them back late";
    hand.key(KeyPress::returnKey);
    ASSERT_TRUE(runUntil([&] { return view.card() == nullptr; })) << "Return answers";
    runFor(0.3);
    EXPECT_EQ(menu(), nullptr);
    hand.key(KeyPress::spaceKey);
    EXPECT_EQ(menu(), nullptr);
    EXPECT_EQ(model.session().world().slowness(), 0) << "Space is the world's";
    choose(1, 0); // Help: First steps
    EXPECT_TRUE(model.messageText().contains("Drag a ball"));
    hand.key(KeyPress::spaceKey);
    EXPECT_EQ(menu(), nullptr);
    EXPECT_EQ(model.session().world().slowness(), 1) << "without a card as well";
}

TEST_F(Windows, ACopyIsKeptUntilTheWindowIsClosedWell) {
    const auto copies = [&] {
        return config.findChildFiles(juce::File::findFiles, false, "recovery-*.json");
    };
    {
        MixerWindow window{onlyNoDevice(), none, folder("kept.json"), config};
        window.model().change("Level", [](Mix& mix) { mix.levelDb = -18.0; });
        ASSERT_TRUE(runUntil([&] { return !copies().isEmpty(); }));
        const auto copy = loadSession(copies()[0].getFullPathName().toStdString());
        ASSERT_TRUE(copy) << copy.error;
        EXPECT_EQ(mixAtEnd(copy.value).levelDb, -18.0);
        window.save();
        EXPECT_TRUE(copies().isEmpty());
    }
}

/// Copies that runs left behind, the first the newest; of each the words of its scene's name.
struct LeftBehind : TestFolder {
    explicit LeftBehind(int count) {
        Mix mix = MixerModel::defaultMix();
        for (int k = 0; k < count; ++k) {
            Scene scene = *mix.scene;
            scene.name = "s" + std::to_string(k);
            mix.scene = std::make_shared<const Scene>(scene);
            MixerModel model{onlyNoDevice(), noDevice, mix};
            const auto file = copy(k);
            file.create();
            file.replaceWithText(utf8(sessionJson(model.savedSession())));
            file.setLastModificationTime(juce::Time::getCurrentTime() -
                                         juce::RelativeTime::seconds(10.0 * k));
        }
    }
    juce::File copy(int k) const {
        return folder.getChildFile("config/recovery-" + juce::String{90'000'000 + k} + ".json");
    }
    int copies() const {
        return folder.getChildFile("config").getNumberOfChildFiles(juce::File::findFiles, "recovery-*.json");
    }
};

TEST_F(Windows, OfSeveralCopiesEachIsShownAndWhatIsNotTakenUpOrDiscardedStays) {
    LeftBehind left{4};
    MixerWindow window{onlyNoDevice(), none, {}, left.folder.getChildFile("config")};
    const auto words = [&] { return window.view().question()->message(); };
    const auto answer = [&](const char* with, auto isDone) {
        window.view().question()->answer(with);
        ASSERT_TRUE(runUntil(isDone)) << with;
    };
    EXPECT_TRUE(words().contains("S0 on 4 actuators") && words().contains("Copy 1 of 4")) << words();
    answer("Older", [&] { return words().contains("S1 on"); });
    answer("Discard it", [&] { return !left.copy(1).existsAsFile(); });
    EXPECT_EQ(left.copies(), 3);
    ASSERT_NE(window.view().question(), nullptr) << "there are others";
    EXPECT_TRUE(words().contains("Copy 1 of 3")) << words();
    window.view().question()->keyPressed(KeyPress{KeyPress::rightKey});
    ASSERT_TRUE(runUntil([&] { return words().contains("S2 on"); }));
    answer("Take it up", [&] { return window.view().question() == nullptr; });
    EXPECT_EQ(window.model().mix().scene->name, "s2");
    EXPECT_TRUE(window.hasUnsavedChanges());
    window.model().change("Level", [](Mix& mix) { mix.levelDb = -18.0; });
    EXPECT_TRUE(window.hasUnsavedChanges()) << "after one edit as well";
    EXPECT_FALSE(left.copy(2).existsAsFile()) << "this run's own is on the disk";
    EXPECT_TRUE(left.copy(0).existsAsFile() && left.copy(3).existsAsFile());
    EXPECT_EQ(left.copies(), 3);
}

TEST_F(Windows, ANewestCopyThatIsCutIsToldAndTheOlderOneIsOffered) {
    LeftBehind left{2};
    left.copy(0).replaceWithText(left.copy(0).loadFileAsString().dropLastCharacters(500));
    MixerWindow window{onlyNoDevice(), none, {}, left.folder.getChildFile("config")};
    EXPECT_TRUE(window.model().messageText().contains("recovery-90000000.json: "))
        << window.model().messageText();
    EXPECT_FALSE(window.model().messageText().containsChar('\n'));
    auto* question = window.view().question();
    ASSERT_NE(question, nullptr);
    EXPECT_TRUE(question->message().contains("S1 on 4 actuators")) << question->message();
    question->answer("Not now");
    ASSERT_TRUE(runUntil([&] { return window.view().question() == nullptr; }));
    EXPECT_EQ(left.copies(), 2);
}

TEST_F(Windows, OnAFullDiskWhatWasTakenUpStaysUntilThereIsRoom) {
    LeftBehind left{1};
    {
        MixerWindow window{onlyNoDevice(), none, {}, left.folder.getChildFile("config")};
        const FileSizeLimit full{4000};
        window.view().question()->answer("Take it up");
        ASSERT_TRUE(runUntil([&] { return window.view().question() == nullptr; }));
        EXPECT_TRUE(window.model().messageText().contains("cannot be written"))
            << window.model().messageText();
        EXPECT_TRUE(left.copy(0).existsAsFile());
    }
    MixerWindow window{onlyNoDevice(), none, {}, left.folder.getChildFile("config")};
    ASSERT_NE(window.view().question(), nullptr) << "offered again";
    window.view().question()->answer("Take it up");
    EXPECT_TRUE(runUntil([&] { return !left.copy(0).existsAsFile(); }));
    EXPECT_EQ(left.copies(), 1);
}

TEST_F(Windows, OfVeryManyCopiesTheNewestAreOfferedAndTheOthersStay) {
    LeftBehind left{1};
    for (int k = 1; k < 45; ++k) left.copy(0).copyFileTo(left.copy(k));
    MixerWindow window{onlyNoDevice(), none, {}, left.folder.getChildFile("config")};
    auto* question = window.view().question();
    ASSERT_NE(question, nullptr);
    EXPECT_TRUE(question->message().contains("Copy 1 of 20") &&
                question->message().contains("25 older ones stay in "))
        << question->message();
    question->answer("Discard all 20");
    EXPECT_TRUE(runUntil([&] { return left.copies() == 25; }));
    EXPECT_TRUE(runUntil([&] { return window.view().question()->message().contains("5 older ones stay"); }))
        << "the next are offered";
}

/// Tells when it was pressed.
struct Pressed : juce::Component {
    void mouseDown(const juce::MouseEvent&) override { is = true; }
    bool is = false;
};

// The click lies in the display's socket when the mouse is asked for, so its answer is read behind the click;
// nothing more comes afterwards that would wake JUCE.
TEST(Display, AClickThatWasReadAheadIsHeardAtOnce) {
    if (std::system("command -v xdotool >/dev/null") != 0) GTEST_SKIP() << "no xdotool";
    Pressed pressed;
    const EmergencyStop stop{pressed, [] {}};
    pressed.setBounds(100, 100, 300, 300);
    pressed.addToDesktop(juce::ComponentPeer::windowIsTemporary);
    pressed.setVisible(true);
    for (int k = 0; k < 5; ++k) {
        runFor(0.3);
        pressed.is = false;
        ASSERT_EQ(std::system("xdotool mousemove 250 250 click 1"), 0);
        juce::Desktop::getMousePosition();
        EXPECT_TRUE(runUntil([&] { return pressed.is; }, 5.0)) << "press " << k;
    }
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const physvib::test::TestFolder home; // of what the windows record
    setenv("HOME", home.folder.getFullPathName().toRawUTF8(), 1);
    return RUN_ALL_TESTS();
}
