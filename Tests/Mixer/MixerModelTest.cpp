// SPDX-License-Identifier: GPL-3.0-or-later
// The model without a window: what is set reaches the session, comes back by undo, and is saved.
#include "Host/FakeAudioDevice.h"
#include "MixerTesting.h"
#include "Scene/SceneFile.h"

namespace physvib::mixer_model_test {

using namespace test;
using Kind = RenderControl::Kind;

struct PlayingModel : testing::Test {
    MixerModel model{onlyNoDevice(), noDevice};
};

TEST_F(PlayingModel, AFifthEnchanterIsAttachedWhileItPlaysStartsQuietlyAndCanBeTakenBack) {
    ASSERT_TRUE(model.attach(0.5, 0.25));
    EXPECT_EQ(model.mix().count(), 5);
    EXPECT_EQ(model.mix().layout.actuators.back().label, "E");
    EXPECT_LT(model.mix().strips.back().gainDb, -6.0);
    EXPECT_EQ(model.mix().strips.back().output, 4);
    EXPECT_EQ(model.savedSession().log.panners.back().panner.channels(), 5);
    EXPECT_EQ(model.savedSession().channels, 5);
    model.undoManager().undo();
    EXPECT_EQ(model.mix().count(), 4);
    EXPECT_EQ(model.savedSession().log.panners.back().panner.channels(), 4);
    EXPECT_EQ(model.savedSession().channels, 5) << "it was there for a while";
    model.undoManager().redo();
    model.detach(1);
    EXPECT_EQ(model.mix().layout.actuators[1].label, "C");
    EXPECT_EQ(model.mix().strips[1].output, 2) << "what plays it goes with it";
}

TEST_F(PlayingModel, TheLastEnchanterStays) {
    for (int k = 0; k < 5; ++k) model.detach(0);
    ASSERT_EQ(model.mix().count(), 1);
    EXPECT_EQ(model.mix().layout.actuators[0].label, "D");
}

TEST(MixerModel, StartsSilentIfItIsAsked) {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isSilent = true}};
    EXPECT_TRUE(model.isSilent());
    EXPECT_TRUE(model.output().isSilent());
}

TEST(MixerModel, WhatASessionWasPlayedWithAndTheMixerLacksIsTold) {
    SavedSession session;
    EXPECT_TRUE(unsupportedFeatures(session).isEmpty());
    session.equalised[1] = {{175.0, 8.0}, {100.0, 300.0}};
    EXPECT_TRUE(unsupportedFeatures(session).contains("equalisers of its own, which the mixer has not"));
    session = {};
    session.shaping.truncation = 0.1;
    EXPECT_TRUE(unsupportedFeatures(session).contains("method, remapping and gain of its own"));
}

TEST_F(PlayingModel, ASavedSessionIsAsLongAsItWasPlayed) {
    ASSERT_TRUE(runUntil([&] { return model.poll().posesNs > 200'000'000; }));
    EXPECT_GT(model.savedSession().lengthNs, 200'000'000);
}

TEST_F(PlayingModel, SoloMutesTheOthers) {
    model.change("Solo", [](Mix& mix) { mix.strips[2].isSolo = true; });
    std::vector<int> muted;
    for (const auto& c : model.savedSession().log.channels)
        if (c.kind == Kind::mute && c.value != 0.0f) muted.push_back(c.channel);
    EXPECT_EQ(muted, (std::vector<int>{0, 1, 3}));
}

TEST(MixerModel, ATestPulseIsOnItsActuatorAloneInSpaceToo) {
    for (const char* name : {"ring4", "glove5", "sleeve8", "vest16"}) {
        MixerModel model{onlyNoDevice(), noDevice};
        model.change("Layout", [&](Mix& mix) { setLayout(mix, name); });
        for (int j = 0; j < model.mix().count(); ++j) {
            model.eventPlayer().testPulse(j);
            ASSERT_TRUE(runUntil(
                [&] { return model.savedSession().log.strikes.size() == static_cast<std::size_t>(j) + 1; }));
            const auto log = model.savedSession().log;
            PhantomPanner::Gains gains{};
            const CollisionEvent& pulse = log.strikes.back();
            log.panners.back().panner.gainsAt(pulse, gains);
            for (int k = 0; k < model.mix().count(); ++k)
                EXPECT_NEAR(nth(gains, k), j == k ? 1.0 : 0.0, 1e-6) << name << j << k;
        }
    }
}

TEST_F(PlayingModel, ACeilingIsKeptSavedTakenBackAndHeldByTheNextEnchanter) {
    model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
    model.change("Ceiling of A", [](Mix& mix) { mix.strips[0].ceilingDb = -30.0; });
    // A session that plays already lowers a ceiling in a ramp of 10 ms.
    const auto changedNs = model.savedSession().log.channels.back().timeNs;
    ASSERT_TRUE(runUntil([&] { return model.poll().posesNs > changedNs + 100'000'000; }));
    for (int k = 0; k < 4; ++k) model.eventPlayer().testPulse(0); // 2 of full scale together
    float highest = 0.0f;
    ASSERT_TRUE(runUntil([&] {
        highest = std::max(highest, model.poll().heldPeaks[0]);
        return highest > 0.9f * channelCeiling(model.mix().strips[0]);
    }));
    EXPECT_LE(highest, channelCeiling(model.mix().strips[0]) * 1.0001f);
    const auto ceilings = [&] {
        std::vector<float> all;
        for (const auto& c : model.savedSession().log.channels)
            if (c.kind == Kind::ceiling) all.push_back(c.value);
        return all;
    };
    EXPECT_EQ(ceilings(), (std::vector<float>{channelCeiling({.ceilingDb = -30.0})}));
    model.attach(0.5, 0.5);
    EXPECT_EQ(model.mix().strips.back().ceilingDb, -30.0) << "not above what the others are held to";
    model.undoManager().undo();
    model.undoManager().undo();
    ASSERT_FALSE(ceilings().empty());
    EXPECT_EQ(ceilings().back(), 1.0f);
}

TEST_F(PlayingModel, AHeldFaderIsOneThingToUndo) {
    for (int k = 0; k < 20; ++k)
        model.change("Gain of A", k > 0, [k](Mix& mix) { mix.strips[0].gainDb = -0.5 * k; });
    EXPECT_EQ(model.mix().strips[0].gainDb, -9.5);
    model.undoManager().undo();
    EXPECT_EQ(model.mix().strips[0].gainDb, 0.0);
    EXPECT_FALSE(model.undoManager().canUndo());
}

TEST_F(PlayingModel, WhatGoesOnAfterAnUndoIsAStepOfItsName) {
    auto& undo = model.undoManager();
    const auto set = [&](bool isOfWorld, double value) { // as a message does, or a key on a point of a lane
        if (isOfWorld) return void(model.world().edit("Sound", SoundAction{0, value, 9.0}, true));
        model.change("Strips by message", true, [=](Mix& mix) { mix.strips[0].delayMs = value; });
    };
    for (const bool isOfWorld : {false, true}) {
        const juce::String name = isOfWorld ? "Sound" : "Strips by message";
        set(isOfWorld, 101.0), set(isOfWorld, 102.0);
        model.change("Mute", [](Mix& mix) { mix.strips[1].isMuted = true; });
        undo.undo();
        set(isOfWorld, 103.0), set(isOfWorld, 104.0);
        EXPECT_EQ(undo.getUndoDescription(), name);
        undo.undo();
        EXPECT_EQ(undo.getRedoDescription(), name);
        EXPECT_EQ(isOfWorld ? model.world().scene().materials[0].frequencyHz : model.mix().strips[0].delayMs,
                  102.0);
    }
}

TEST_F(PlayingModel, BodiesComeGoAndChangeAndAllOfItCanBeUndone) {
    BodyDescription ball;
    ball.name = "?";
    ball.positionMetres = {3.0, 2.0};
    ball.fixtures.push_back({CircleShape{0.15}, {}, 0.0, 0, false, Voice::own});
    EXPECT_EQ(model.world().edit("Add", SpawnAction{ball, {}}), "");
    ASSERT_EQ(model.world().scene().inputs.size(), 1u);
    const auto added = std::get<SpawnAction>(model.world().scene().inputs[0].action).body.name;
    EXPECT_EQ(model.world().edit("Material", MaterialAction{added, everyFixture, 2}), "");
    EXPECT_EQ(std::get<SpawnAction>(model.world().scene().inputs[0].action).body.fixtures[0].material, 2);
    model.undoManager().undo();
    EXPECT_EQ(std::get<SpawnAction>(model.world().scene().inputs[0].action).body.fixtures[0].material, 0);
    model.undoManager().undo();
    ASSERT_TRUE(runUntil([&] {
        const auto moment = model.poll();
        return !moment.poses.empty() && !moment.poses.back().isPresent;
    }));
    EXPECT_NE(model.world().edit("Material", MaterialAction{"floor", everyFixture, 99}), "")
        << "what cannot be is told, not done";
    EXPECT_FALSE(model.undoManager().canUndo());
}

TEST_F(PlayingModel, AThousandEditsLaterEverythingCanBeUndone) {
    const Mix first = model.mix();
    for (int k = 0; k < 30; ++k) {
        model.attach(0.01 * k, 0.5);
        model.change("Law", [k](Mix& mix) { mix.law = static_cast<PanningLaw>(k % 4); });
        model.change("Mute", [k](Mix& mix) { nth(mix.strips, k % 4).isMuted = k % 2 == 0; });
        model.detach(k % model.mix().count());
    }
    while (model.undoManager().canUndo()) model.undoManager().undo();
    EXPECT_EQ(model.mix().strips, first.strips);
    EXPECT_EQ(model.mix().layout.actuators, first.layout.actuators);
}

TEST_F(PlayingModel, ARecordingHasAChannelPerEnchanterAndTheEventsOfIt) {
    TestFolder folder;
    bool isDone = false;
    model.recording().onEnd = [&](const juce::File&, const juce::String& error) {
        isDone = true;
        EXPECT_TRUE(error.isEmpty()) << error;
    };
    ASSERT_EQ(model.recording().start(folder("take.wav")), "");
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.recording().seconds() > 2.0; }));
    model.recording().stop();
    EXPECT_TRUE(runUntil([&] { return model.poll(), isDone; }));
    juce::AudioFormatManager formats;
    formats.registerBasicFormats();
    const std::unique_ptr<juce::AudioFormatReader> wav{formats.createReaderFor(folder("take.wav"))};
    ASSERT_NE(wav, nullptr);
    EXPECT_EQ(wav->numChannels, 4u);
    EXPECT_GT(wav->lengthInSamples, 2 * 48000 - 4800);
    const auto events = loadEventsCsv(pathOf(folder("take.csv")));
    ASSERT_TRUE(events) << events.error;
    ASSERT_FALSE(events.value.events.empty());
    EXPECT_EQ(events.value.field.widthMetres, model.world().scene().fieldWidthMetres);
    EXPECT_LT(events.value.events.back().timeNs,
              static_cast<std::int64_t>(1e9 * static_cast<double>(wav->lengthInSamples) / 48000.0));
    EXPECT_NE(model.recording().start(folder("no/such/folder/take.wav")), "");
}

TEST(MixerModel, ARecordingThatRunsWhenTheMixerIsClosedIsKept) {
    TestFolder folder;
    {
        MixerModel model{onlyNoDevice(), noDevice};
        ASSERT_EQ(model.recording().start(folder("take.wav")), "");
        EXPECT_TRUE(runUntil([&] { return model.poll(), model.recording().seconds() > 0.1; }));
    }
    EXPECT_GT(folder("take.wav").getSize(), 4 * 4 * 4800);
    EXPECT_TRUE(folder("take.csv").existsAsFile());
    EXPECT_FALSE(folder("take.wav.physvib.part").exists());
}

// The recorder's buffer has four seconds; what finds it full at once is missing.
TEST(MixerModel, WhatARecordingLacksIsToldAtItsEnd) {
    FakeInterface hands; // it asks for no block but those of play()
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    TestFolder folder;
    constexpr int room = 4 * 48000;
    const std::vector<float> samples(room + 1);
    const std::vector<const float*> channels(static_cast<std::size_t>(model.mix().count()), samples.data());
    struct Take {
        int frames, rateHz;
        const char* told;
    };
    for (const auto& [frames, rateHz, told] :
         {Take{480, 48000, ""}, Take{room + 1, 48000, "frames missing in the recording: 1"},
          Take{480, 44100, "the recording ends where the device changed its rate"}}) {
        std::optional<juce::String> end;
        model.recording().onEnd = [&](const juce::File&, const juce::String& error) { end = error; };
        ASSERT_EQ(model.recording().start(folder("take.wav")), "");
        model.session().sinks().onBlock({channels.data(), frames, 0, rateHz});
        model.recording().stop();
        for (int block = 0; block < 3; ++block) hands.play(hands.block); // the recorder is released
        model.poll();
        ASSERT_TRUE(end.has_value()) << told;
        EXPECT_EQ(*end, told);
    }
}

TEST(MixerModel, ADeviceThatVanishesIsToldAndTakenUpAgain) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    EXPECT_EQ(model.messageText(), "");
    hands.unplug(true);
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.messageText().contains("has stopped"); }))
        << model.messageText();
    EXPECT_FALSE(model.poll().device.isRunning);
    hands.isPlugged = true;
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.messageText().isEmpty(); })) << model.messageText();
    EXPECT_TRUE(model.poll().device.isRunning);
    EXPECT_NE(model.open({"Fake:feet", 0, 0}), "");
    EXPECT_TRUE(model.messageText().contains("feet")) << "never a silent failure";
}

TEST(MixerModel, TheMonitorIsHeardWhereNoEnchanterIsAndGivesWayToOne) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}),
                     {.name = "Fake:hands", .monitorOutputs = {2, 3}, .markerOutput = 1},
                     MixerModel::defaultMix(),
                     {.isPaused = true}};
    EXPECT_TRUE(model.messageText().isEmpty())
        << model.messageText() << ": an enchanter is there, and is felt";
    EXPECT_TRUE(model.device().listening().settings().contacts.empty());
    EXPECT_TRUE(model.device().listening().settings().marks.empty());
    EXPECT_EQ(model.device().listening().setMonitor({4, 3}, -20.0),
              "output 4 is an actuator's; expected another one to listen to");
    EXPECT_EQ(model.device().listening().setMarker(2),
              "output 3 is an actuator's; expected another one for marks");
    ASSERT_EQ(model.device().listening().setMonitor({4, 5}, -10.0), "");
    EXPECT_EQ(model.device().listening().setMarker(5),
              "output 6 is listened to; expected another one for marks");
    model.change("Output", [](Mix& mix) { mix.strips[1].output = 6; });
    EXPECT_EQ(model.device().listening().settings().marks, std::vector{1})
        << "it was wanted there, and may be now";
}

TEST(MixerModel, TheMonitorIsChosenHeardSavedWithTheDeviceAndUndoneForHands) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    ASSERT_EQ(model.device().listening().setMonitor({4, 5}, 0.0), "");
    ASSERT_EQ(model.device().listening().setMarker(7), "");
    EXPECT_EQ(model.device().choice().monitorOutputs, (std::vector{4, 5}));
    EXPECT_EQ(model.device().choice().markerOutput, 7);
    float heard = 0.0f, marked = 0.0f;
    EXPECT_TRUE(runUntil([&] {
        model.poll();
        const auto out = hands.play(64);
        for (const float x : out[4]) heard = std::max(heard, std::abs(x));
        for (const float x : out[7]) marked = std::max(marked, x);
        return heard > 0.01f && marked == 1.0f;
    }));
    model.change("Output", [](Mix& mix) { mix.strips[0].output = 5; });
    EXPECT_EQ(model.messageText(), "");
    EXPECT_TRUE(model.device().listening().settings().contacts.empty()) << "hands first";
    EXPECT_EQ(model.device().listening().settings().marks, std::vector{7});
    model.undoManager().undo();
    EXPECT_EQ(model.device().listening().settings().contacts, (std::vector{4, 5}));
    ListeningSettings noise;
    noise.noise = {4, 5};
    ASSERT_EQ(model.device().listening().beginStudy(noise), "");
    EXPECT_TRUE(model.device().listening().settings().contacts.empty()) << "a study's ears are told nothing";
    EXPECT_EQ(model.device().listening().settings().marks, std::vector{7});
    model.device().listening().endStudy();
    EXPECT_EQ(model.device().listening().settings().contacts, (std::vector{4, 5}));
    hands.outputs = 4; // another interface of the same name
    hands.unplug(true);
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.messageText().contains("has stopped"); }));
    hands.isPlugged = true;
    EXPECT_TRUE(runUntil([&] { return model.poll(), model.messageText().isEmpty(); })) << model.messageText();
    EXPECT_TRUE(model.device().listening().settings().contacts.empty());
    EXPECT_TRUE(model.poll().device.isRunning) << "what cannot be heard does not keep hands from feeling";
}

TEST(MixerModel, OnTwoOutputsOneListensInsteadOfFeeling) {
    FakeInterface speakers;
    speakers.outputs = 2;
    MixerModel model{fakeDrivers({&speakers}), {"Fake:hands", 0, 0}};
    EXPECT_EQ(model.device().listening().setMonitor({0, 1}, -20.0),
              "output 1 is an actuator's; expected another one to listen to");
    ASSERT_EQ(model.moveOutputsToMonitor({0, 1}, -20.0), "");
    EXPECT_EQ(model.mix().strips[0].output, -1);
    EXPECT_EQ(model.mix().strips[1].output, -1);
    EXPECT_EQ(model.device().listening().settings().contacts, (std::vector{0, 1}));
    model.undoManager().undo();
    EXPECT_EQ(model.mix().strips[1].output, 1);
    EXPECT_TRUE(model.device().listening().settings().contacts.empty()) << "never where an enchanter is";
}

TEST(MixerModel, WhatFindsNoRoomInTheSessionIsToldWhenThereIsRoom) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}}; // which calls for nothing yet
    const auto lastGain = [&] {
        float gain = 1.0f;
        for (const auto& c : model.savedSession().log.channels)
            if (c.kind == Kind::gain && c.channel == 1) gain = c.value;
        return gain;
    };
    for (int k = 1; k <= 400; ++k)
        model.change("Gain of B", [k](Mix& mix) { mix.strips[1].gainDb = -0.1 * k; });
    EXPECT_NE(lastGain(), channelGain(model.mix().strips[1]));
    EXPECT_TRUE(runUntil(
        [&] { return hands.play(64), model.poll(), lastGain() == channelGain(model.mix().strips[1]); }));
    const auto told = model.savedSession().log.channels.size();
    for (int k = 0; k < 10; ++k) model.poll();
    EXPECT_EQ(model.savedSession().log.channels.size(), told) << "once";
}

TEST(MixerModel, TwoHundredBodiesForAWhile) {
    Scene crowd = *findBuiltInScene("shake-the-box");
    for (int k = 0; k < 200; ++k) {
        BodyDescription ball;
        ball.name = "ball " + std::to_string(k);
        ball.positionMetres = {0.3 + 0.29 * (k % 20), 0.2 + 0.3 * (k / 20)};
        ball.fixtures.push_back({CircleShape{0.1}, {}, 0.0, k % 3, false, Voice::own});
        crowd.bodies.push_back(ball);
    }
    Mix mix = MixerModel::defaultMix();
    mix.scene = std::make_shared<const Scene>(crowd);
    MixerModel model{onlyNoDevice(), noDevice, mix};
    MixerView view{model};
    EXPECT_TRUE(
        runUntil([&] { return view.refresh(), model.poll().session.sessionNs > 3'000'000'000; }, 60.0));
    EXPECT_EQ(model.messageText(), "");
    EXPECT_EQ(view.createComponentSnapshot(view.getLocalBounds()).getWidth(), view.getWidth());
}

} // namespace physvib::mixer_model_test
