// SPDX-License-Identifier: GPL-3.0-or-later
// What the strips say of outputs is what the device plays, whatever is chosen, refused, saved and opened.
#include "CutTexts.h"
#include "Host/FakeAudioDevice.h"
#include "Live/Documents/SessionFile.h"
#include "Mixer/Model/MixerDevice.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Studies/StudyScreen.h"
#include "MixerTesting.h"
#include "Stimuli/SeededRandom.h"

namespace physvib::mixer_routing_test {

using namespace test;

/// A model of four strips on eight outputs, in a world that stands still.
struct RoutedModel {
    explicit RoutedModel(Mix mix = MixerModel::defaultMix())
        : model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}, std::move(mix), {.isPaused = true}} {
        for (int k = 0; k < 50; ++k) hands.play(64);
    }
    /// Where that strip's test is heard: the loudest output, if the others are silent.
    int heardOf(int strip) {
        const auto played = model.session().status().render.played;
        std::vector<float> peaks(static_cast<std::size_t>(hands.outputs));
        const auto hear = [&] {
            const auto block = hands.play(64);
            for (std::size_t o = 0; o < block.size(); ++o)
                for (const float x : block[o]) peaks[o] = std::max(peaks[o], std::abs(x));
        };
        model.eventPlayer().testPulse(strip);
        EXPECT_TRUE(runUntil([&] { return hear(), model.session().status().render.played > played; }));
        for (int k = 0; k < 60; ++k) hear();
        for (int k = 0; k < 400; ++k) hands.play(64); // it rings out
        if (noise >= 0) nth(peaks, noise) = 0.0f;
        const auto loudest = std::ranges::max_element(peaks);
        if (*loudest < 1e-3f) return -1;
        const auto sounds = std::ranges::count_if(peaks, [&](float p) { return p > 0.01f * *loudest; });
        EXPECT_EQ(sounds, 1) << "felt on its own output alone";
        return static_cast<int>(loudest - peaks.begin());
    }
    void give(std::size_t strip, int output) { // as the strip's list does
        model.change("Output", [&](Mix& mix) { assignOutput(mix.strips, strip, output); });
    }
    void expectAsShown(const std::string& after) {
        for (int j = 0; j < model.mix().count(); ++j) {
            const int shown = nth(model.mix().strips, j).output;
            EXPECT_EQ(heardOf(j), shown < hands.outputs ? shown : -1) << after << ": strip " << j;
        }
    }
    std::vector<int> outputs() const {
        std::vector<int> all;
        for (const Strip& strip : model.mix().strips) all.push_back(strip.output);
        return all;
    }

    int noise = -1; ///< an output that a study uses
    FakeInterface hands;
    MixerModel model;
};

struct RoutedOutputs : testing::Test, RoutedModel {};

void setOutputs(Mix& mix, const std::vector<int>& outputs) {
    for (std::size_t j = 0; j < mix.strips.size(); ++j) mix.strips[j].output = outputs[j];
}

/// As a file of any program may have it.
SavedSession opened(SavedSession session, const std::vector<int>& outputs) {
    setOutputs(*session.mix, outputs);
    auto read = readSession(sessionJson(session), "session");
    EXPECT_TRUE(read) << read.error;
    return std::move(read.value);
}

TEST_F(RoutedOutputs, EveryStripsTestOnEveryOutputIsHeardWhereTheStripSays) {
    for (std::size_t j = 0; j < 4; ++j)
        for (int output = 0; output < hands.outputs; ++output) {
            give(j, output);
            ASSERT_EQ(model.mix().strips[j].output, output);
            expectAsShown("strip " + std::to_string(j) + " to output " + std::to_string(output));
        }
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(RoutedOutputs, AnOutputThatAnotherHasIsExchanged) {
    give(1, 0);
    EXPECT_EQ(outputs(), (std::vector{1, 0, 2, 3}));
    give(1, 1);
    give(0, 2); // A, B for C, D
    give(1, 3);
    EXPECT_EQ(outputs(), (std::vector{2, 3, 0, 1}));
    expectAsShown("exchanged");
    model.undoManager().undo();
    EXPECT_EQ(outputs(), (std::vector{2, 1, 0, 3})) << "one act, one step back";
    give(2, -1);
    EXPECT_EQ(outputs(), (std::vector{2, 1, -1, 3}));
    give(2, 3);
    EXPECT_EQ(outputs(), (std::vector{2, 1, 3, -1})) << "who had none gives none";
    expectAsShown("taken");
    EXPECT_EQ(model.messageText(), "");
}

TEST_F(RoutedOutputs, ARefusedOutputIsNeitherShownNorSaved) {
    ListeningSettings ofStudy;
    ofStudy.noise = {noise = 6};
    ASSERT_EQ(model.device().listening().beginStudy(ofStudy), "");
    give(0, 6);
    EXPECT_TRUE(model.messageText().contains("output 7")) << model.messageText();
    EXPECT_EQ(outputs(), (std::vector{0, 1, 2, 3}));
    EXPECT_EQ(model.savedSession().mix->strips[0].output, 0);
    EXPECT_FALSE(model.undoManager().canUndo()) << "nothing to take back";
    EXPECT_EQ(model.editCount(), 0U) << "nothing to save";
    expectAsShown("refused");
    model.change("Output and level", [](Mix& mix) {
        assignOutput(mix.strips, 0, 6);
        mix.levelDb = -30.0;
    });
    EXPECT_EQ(model.undoManager().getUndoDescription(), "Output and level") << "half of it was done";
    EXPECT_EQ(model.mix().levelDb, -30.0);
    ASSERT_EQ(model.device().listening().beginStudy({}), ""); // the study ends
    give(0, 6);
    EXPECT_EQ(outputs(), (std::vector{6, 1, 2, 3}));
    model.undoManager().undo();
    ASSERT_EQ(model.device().listening().beginStudy(ofStudy), "");
    model.undoManager().redo();
    EXPECT_TRUE(model.undoManager().canUndo()) << "a redo that is refused forgets no step";
}

TEST(MixerRouting, ASessionWithAConflictPlaysWhatItCanAndHealsByOneClick) {
    RoutedModel first;
    const auto session = opened(first.model.savedSession(), {0, 0, 2, 2});
    RoutedModel routed{mixAtEnd(session)};
    EXPECT_TRUE(routed.model.poll().device.isRunning);
    EXPECT_EQ(routed.outputs(), (std::vector{0, -1, 2, -1}));
    routed.expectAsShown("opened");
    EXPECT_EQ(routed.model.messageText(), "B, D have no outputs: other actuators have them");
    MixerView view{routed.model};
    auto& button = the<juce::Button>(view, "Give free outputs");
    EXPECT_TRUE(button.isVisible());
    button.onClick();
    EXPECT_EQ(routed.outputs(), (std::vector{0, 1, 2, 3}));
    routed.expectAsShown("healed");
    routed.model.dispatchPendingMessages();
    EXPECT_EQ(routed.model.messageText(), "");
    EXPECT_FALSE(button.isVisible());
}

TEST(MixerRouting, AfterAStudyMutesSolosAndGainsOfTheMixerAreBack) {
    for (const bool isSolo : {false, true}) {
        RoutedModel mixer;
        mixer.model.change("Strips", [&](Mix& mix) {
            if (isSolo) mix.strips[2].isSolo = true;
            if (!isSolo) mix.strips[1].isMuted = true;
        });
        {
            StimulusPlayer study{mixer.model};
            EXPECT_EQ(mixer.heardOf(1), 1) << "a study has every strip";
            (void)mixer.model.session().submit(
                {RenderControl{.kind = RenderControl::Kind::gain, .channel = 2, .value = 0.0f}});
            study.stop();
            for (int k = 0; k < 50; ++k) mixer.hands.play(64); // the ramp of its mutes
            EXPECT_EQ(mixer.heardOf(0), -1) << "stopped";
        }
        for (int j = 0; j < 4; ++j)
            EXPECT_EQ(mixer.heardOf(j), mixer.model.mix().isSilent(j) ? -1 : j) << isSolo << j;
    }
}

TEST(MixerRouting, FreeOutputsAreNeitherTheMonitorsNorTheMarkers) {
    Mix mix = MixerModel::defaultMix();
    setOutputs(mix, {0, 0, 2, 2});
    FakeInterface hands;
    MixerModel model{
        fakeDrivers({&hands}), {.name = "Fake:hands", .monitorOutputs = {4}, .markerOutput = 1}, mix};
    const auto heal = model.messages().current().action.run;
    ASSERT_TRUE(heal);
    heal();
    EXPECT_EQ(model.mix().strips[1].output, 3);
    EXPECT_EQ(model.mix().strips[3].output, 5);
}

TEST(MixerRouting, WhereNoOutputIsFreeItSaysSo) {
    Mix mix = MixerModel::defaultMix();
    setOutputs(mix, {0, 0, 1, 1});
    FakeInterface two;
    two.outputs = 2;
    MixerModel model{fakeDrivers({&two}), {"Fake:hands", 0, 0}, mix};
    const auto heal = model.messages().current().action.run;
    ASSERT_TRUE(heal);
    heal();
    EXPECT_EQ(model.messageText(), "The device has no other free output");
}

TEST(MixerRouting, NewActuatorsAreNoLouderThanTheQuietest) {
    MixerModel model{onlyNoDevice(), noDevice};
    model.change("Gains", [](Mix& mix) {
        mix.strips[1].gainDb = -30.0;
        mix.strips[2].gainDb = minStripDb; // silence is no level
    });
    model.change("Preset", [](Mix& mix) { setLayout(mix, "vest16"); });
    ASSERT_TRUE(model.attach(0.5, 0.5));
    for (std::size_t j = 4; j < 17; ++j) EXPECT_EQ(model.mix().strips[j].gainDb, -30.0) << j;
    EXPECT_EQ(model.mix().strips[0].gainDb, 0.0);
}

TEST(MixerRouting, FortyRandomRoutingsAreSavedAndOpened) {
    SeededRandom random{59};
    RoutedModel first;
    const SavedSession saved = first.model.savedSession();
    for (int k = 0; k < 40; ++k) {
        std::vector<int> wanted(4);
        for (int& output : wanted) output = static_cast<int>(random.below(10)) - 1; // none, or one of nine
        RoutedModel routed{mixAtEnd(opened(saved, wanted))};
        std::vector<int> expected = wanted;
        for (std::size_t j = 1; j < wanted.size(); ++j)
            if (std::find(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(j), wanted[j]) !=
                wanted.begin() + static_cast<std::ptrdiff_t>(j))
                expected[j] = -1;
        ASSERT_EQ(routed.outputs(), expected) << k;
        const auto told = routed.model.messageText();
        ASSERT_EQ(told.contains(" no output: another") || told.contains(" no outputs: other"),
                  expected != wanted)
            << k << told;
        ASSERT_TRUE(routed.model.poll().device.isRunning) << k;
        const auto again = readSession(sessionJson(routed.model.savedSession()), "session");
        ASSERT_TRUE(again) << again.error;
        ASSERT_EQ(mixAtEnd(again.value).strips, routed.model.mix().strips) << k;
        if (k % 10 == 0) routed.expectAsShown("routing " + std::to_string(k));
    }
}

/// What the strip's list shows.
juce::String shownOutput(MixerView& view, MixerModel& model, const juce::String& label) {
    model.dispatchPendingMessages();
    view.refresh();
    const auto* list = dynamic_cast<juce::ComboBox*>(find(view, "Output of " + label));
    return list != nullptr ? list->getText() : juce::String{"no list"};
}

TEST(Headphones, TheStripsSayLAndRAndAThirdActuatorIsToldWhileTwoPlayOn) {
    RoutedModel routed{[] {
        Mix mix = MixerModel::defaultMix();
        setLayout(mix, "phone2");
        return mix;
    }()};
    MixerModel& model = routed.model;
    MixerView view{model};
    ASSERT_EQ(openHeadphones(model, {"Fake:hands", 0, 0}), "");
    EXPECT_EQ(routed.outputs(), (std::vector{0, 1}));
    EXPECT_EQ(shownOutput(view, model, "A"), "L");
    EXPECT_EQ(shownOutput(view, model, "B"), "R");
    EXPECT_EQ(model.messageText(), "");
    ASSERT_TRUE(model.attach(0.5, 0.5));
    EXPECT_EQ(routed.outputs(), (std::vector{0, 1, -1})) << "though the device has eight";
    EXPECT_EQ(model.messageText(), "C has no output: headphones have two, L and R");
    EXPECT_EQ(shownOutput(view, model, "C"), "none");
    CollisionEvent hit;
    hit.amplitude = 1.0, hit.frequencyHz = 200.0, hit.decayPerSecond = 30.0;
    hit.x = 0.5 * model.world().scene().fieldWidthMetres,
    hit.y = 0.5 * model.world().scene().fieldHeightMetres;
    EXPECT_NE(strongestActuatorFor(model, hit).actuator, 2) << "nothing of it is felt";
    EXPECT_EQ(reasonNotPlayed(model, hit), "C has no output");
    hit.x *= 0.5; // between A and C
    EXPECT_GT(strongestActuatorFor(model, hit).levelG, 0.0);
    model.change("Mute", [](Mix& mix) { mix.strips[0].isMuted = true; });
    EXPECT_EQ(strongestActuatorFor(model, hit).levelG, 0.0) << "who is muted plays nothing";
    CollisionEvent atA = hit;
    atA.x = 0.0;
    EXPECT_EQ(reasonNotPlayed(model, atA), "A is muted");
    model.undoManager().undo();
    model.change("Solo", [](Mix& mix) { mix.strips[1].isSolo = true; });
    EXPECT_EQ(reasonNotPlayed(model, atA), "A is not soloed");
    model.undoManager().undo();
    model.eventPlayer().testPulse(2);
    EXPECT_FALSE(runUntil([&] { return model.poll().meters.peaks[2] > 0.0f; }, 0.5));
    routed.expectAsShown("attached");
    model.report({});
    model.change("Preset", [](Mix& mix) { setLayout(mix, "phone4"); });
    EXPECT_EQ(routed.outputs(), (std::vector{0, 1, -1, -1}));
    EXPECT_EQ(model.output().channelMap(), (std::vector{0, 1, -1, -1}));
    EXPECT_EQ(model.messageText(), "D has no output: headphones have two, L and R");
    routed.give(2, 4); // whoever asks for it gets it
    EXPECT_EQ(shownOutput(view, model, "C"), "out 5");
    routed.expectAsShown("asked for");
    DeviceChoice actuators = model.device().choice();
    actuators.isHeadphones = false;
    ASSERT_EQ(model.open(actuators), "");
    EXPECT_EQ(routed.outputs(), (std::vector{0, 1, 4, 2})) << "D came on headphones: a free one";
    routed.expectAsShown("after them");
}

TEST_F(RoutedOutputs, ThoseOfAFourActuatorMixerAreToldAndTheLevelIsLow) {
    model.change("Loud", [](Mix& mix) { mix.levelDb = -3.0; });
    ASSERT_EQ(openHeadphones(model, {.name = "Fake:hands", .monitorOutputs = {4, 5}, .markerOutput = 1}), "");
    EXPECT_EQ(outputs(), (std::vector{0, 1, -1, -1}));
    EXPECT_EQ(model.messageText(), "C, D have no output: headphones have two, L and R");
    EXPECT_EQ(model.mix().levelDb, defaultContactDb);
    EXPECT_TRUE(model.device().choice().monitorOutputs.empty()) << "A and B are heard in its place";
    EXPECT_EQ(model.device().choice().markerOutput, -1);
    expectAsShown("headphones");
}

TEST(Headphones, ThatAreGoneAreHeardByNobodyAndWhoHasNoEarStaysStruckOut) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    MixerView view{model};
    view.setSize(1024, 700);
    view.tabs().choose("Output");
    const auto& facts = the<StatusTable>(view, "What follows from it");
    ASSERT_EQ(openHeadphones(model, model.device().choice()), "");
    const auto heard = [&] {
        view.refresh();
        for (const auto& fact : facts.rows())
            if (fact.name == "Heard") return fact.value;
        return juce::String{};
    };
    EXPECT_EQ(heard(), "left: A, right: B");
    EXPECT_GE(facts.getHeight(), facts.heightFor(facts.getWidth())) << "no row is cut";
    hands.unplug(true);
    ASSERT_TRUE(runUntil([&] { return model.poll(), model.messageText().contains("has stopped"); }));
    EXPECT_EQ(heard(), "by nobody: the device is not there");
    for (const auto& cut : readTexts(*find(view, "Transport and device")).cut) ADD_FAILURE() << cut.words;
    EXPECT_TRUE(model.device().isPlayed(1));
    EXPECT_FALSE(model.device().isPlayed(2));
}

TEST_F(RoutedOutputs, GiveTheOutputsOfBeforeBackAndTakeTheirMessageAlong) {
    give(0, 5);
    give(3, -1);
    const auto before = outputs();
    DeviceChoice choice = model.device().choice();
    ASSERT_EQ(openHeadphones(model, choice), "");
    ASSERT_EQ(openHeadphones(model, model.device().choice()), "") << "again";
    EXPECT_EQ(outputs(), (std::vector{0, 1, -1, -1}));
    EXPECT_TRUE(model.messageText().contains("headphones have two"));
    ASSERT_EQ(model.open(choice), "");
    EXPECT_EQ(outputs(), before);
    EXPECT_EQ(model.messageText(), "") << "no headphones are there";
    EXPECT_EQ(model.mix().levelDb, defaultContactDb) << "nothing is louder by itself";
    expectAsShown("back");
    ASSERT_EQ(openHeadphones(model, choice), "");
    give(2, 7); // a choice meanwhile stays
    ASSERT_EQ(model.open(choice), "");
    EXPECT_EQ(outputs(), (std::vector{5, 1, 7, -1}));
}

TEST(MixerRouting, ANewActuatorLeavesTheMonitorAndTheMarkerWhatTheyUse) {
    FakeInterface hands;
    Mix mix = MixerModel::defaultMix();
    setLayout(mix, "phone2");
    setOutputs(mix, {2, 3});
    MixerModel model{
        fakeDrivers({&hands}), {.name = "Fake:hands", .monitorOutputs = {0, 1}, .markerOutput = 4}, mix};
    MixerView view{model};
    ASSERT_TRUE(model.attach(0.5, 0.5));
    EXPECT_EQ(model.mix().strips[2].output, 5);
    EXPECT_EQ(model.device().listening().settings().contacts, (std::vector{0, 1})) << "both ears";
    EXPECT_EQ(model.device().listening().settings().marks, std::vector{4});
    model.dispatchPendingMessages();
    const auto& list = the<juce::ComboBox>(view, "Output of C");
    for (int k = 0; k < 8; ++k)
        EXPECT_EQ(list.isItemEnabled(k + 2), k != 0 && k != 1 && k != 4) << list.getItemText(k + 1);
    EXPECT_EQ(list.getItemText(1), "out 1 (monitor)");
}

TEST_F(RoutedOutputs, WhatIsChosenInAListIsWhatPlays) {
    MixerView view{model};
    model.dispatchPendingMessages();
    view.refresh();
    chooseIn(view, "Output of C", "out 7");
    EXPECT_EQ(outputs(), (std::vector{0, 1, 6, 3}));
    chooseIn(view, "Output of B", "none");
    EXPECT_EQ(outputs(), (std::vector{0, -1, 6, 3}));
    expectAsShown("chosen");
    view.tabs().choose("Output");
    view.refresh();
    chooseIn(view, "Marks", "output 6");
    EXPECT_EQ(model.device().choice().markerOutput, 5);
    chooseIn(view, "Marks", "none");
    EXPECT_EQ(model.device().choice().markerOutput, -1);
    EXPECT_EQ(model.messageText(), "");
}

TEST(MixerRouting, WhatTheOutputPageSaysOfMonitorAndOutputsIsWhatPlays) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    MixerView view{model};
    const auto monitor = [&] {
        model.dispatchPendingMessages();
        return the<juce::ComboBox>(view, "Monitor").getText();
    };
    const auto says = [&](const juce::String& words) {
        view.tabs().choose("Output");
        view.refresh();
        const auto facts = the(view, "What follows from it").getDescription();
        EXPECT_TRUE(facts.contains(words)) << facts;
    };
    says("Actuators: 4 of 4 have an output there");
    ASSERT_EQ(model.moveOutputsToMonitor({0, 1}, -20.0), "");
    EXPECT_EQ(monitor(), "1 and 2");
    chooseIn(view, "Level of the monitor", number(-30.0, 0));
    EXPECT_EQ(model.device().choice().monitorDb, -30.0);
    says("Actuators: 2 of 4 have an output there");
    says("Heard: left on 1, right on 2");
    model.undoManager().undo();
    EXPECT_EQ(monitor(), "off: outputs 1 and 2, which are of A B");
    EXPECT_FALSE(the(view, "Level of the monitor").isEnabled()) << "its choice would forget those outputs";
    says("Heard: not there: an actuator, or no output");
    model.undoManager().redo();
    EXPECT_EQ(monitor(), "1 and 2");
    ASSERT_EQ(openHeadphones(model, model.device().choice()), "");
    EXPECT_EQ(monitor(), "none");
    says("Heard: left: A, right: B");
    model.change("None", [](Mix& mix) { mix.strips[1].output = -1; });
    says("Heard: left: A, right: nobody");
    says("Actuators: 1 of 4 have an output there");
}

TEST(MixerRouting, WithoutADeviceNoOutputIsMissedAndNoneIsSaidToBeThere) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    model.change("None", [](Mix& mix) { mix.strips[1].output = -1; });
    for (int k = 0; k < 3; ++k) EXPECT_EQ(model.rig().output().maintain(), "");
    view.tabs().choose("Output");
    view.refresh();
    const auto facts = the(view, "What follows from it").getDescription();
    EXPECT_TRUE(facts.contains("Actuators: without a device none has an output")) << facts;
    EXPECT_TRUE(facts.contains("Felt: by nobody")) << facts;
    EXPECT_FALSE(the(view, "Device state").getDescription().contains(" ms")) << "nothing is felt";
    EXPECT_EQ(the<juce::ComboBox>(view, "Device").getText(), "No device: seen, not felt");
}

TEST(Headphones, AreInTheListAgainAfterNoDevice) {
    FakeInterface hands;
    MixerModel model{withNullDevice(fakeDrivers({&hands})), {"Fake:hands", 0, 0}};
    MixerView view{model};
    view.tabs().choose("Output");
    auto& list = the<juce::ComboBox>(view, "Device");
    const auto choose = [&](const juce::String& words) {
        return chooseIn(view, "Device", words), list.getText();
    };
    for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(choose("Headphones"), "Headphones: Fake:hands (L and R)");
        EXPECT_TRUE(model.device().choice().isHeadphones);
        EXPECT_EQ(model.device().choice().name, "Fake:hands");
        EXPECT_EQ(choose("No device"), "No device: seen, not felt");
        EXPECT_FALSE(model.device().choice().isHeadphones);
    }
    EXPECT_EQ(model.mix().strips[2].output, 2) << "as before";
    for (int k = 0; k < 4; ++k) { // there and back, twice
        const int shown = model.mix().strips[2].output;
        EXPECT_TRUE(model.undoManager().undo());
        EXPECT_NE(model.mix().strips[2].output, shown) << "no step shows nothing";
    }
    EXPECT_FALSE(model.undoManager().canUndo());
}

TEST(MixerRouting, AnOutputThatIsDisconnectedIsNeitherCountedNorShownAsThere) {
    FakeInterface hands;
    MixerModel model{fakeDrivers({&hands}), {"Fake:hands", 0, 0}};
    MixerView view{model};
    for (int j = 0; j < 4; ++j) EXPECT_TRUE(model.output().hasOutput(j)) << j;
    EXPECT_EQ(shownOutput(view, model, "D"), "out 4");
    hands.outputs = 3;
    hands.unplug(true);
    ASSERT_TRUE(runUntil([&] { return model.poll(), model.messageText().contains("has stopped"); }));
    EXPECT_EQ(shownOutput(view, model, "A"), "out 1 (not there)");
    hands.isPlugged = true;
    ASSERT_TRUE(runUntil([&] { return model.poll(), model.output().hasOutput(0); }));
    EXPECT_FALSE(model.output().hasOutput(3));
    EXPECT_EQ(model.messageText(), "Fake:hands: 1 of 4 actuators have no output there") << "and no more";
    EXPECT_EQ(shownOutput(view, model, "A"), "out 1");
    EXPECT_EQ(shownOutput(view, model, "D"), "out 4 (not there)");
}

} // namespace physvib::mixer_routing_test
