// SPDX-License-Identifier: GPL-3.0-or-later
// Gain lanes in the mixer's window: points are added, moved and taken away by pointer and keys.
#include "Live/Documents/Mix.h"
#include "Mixer/Strips/LanesTab.h"
#include "MixerTesting.h"

namespace physvib::lanes_by_hand_test {

using namespace test;

struct LanesByHand : testing::Test, MixerInView {
    LaneRow* row = nullptr;
    void SetUp() override {
        view.scope().choose("Gain lanes");
        view.refresh();
        row = dynamic_cast<LaneRow*>(find(view, "Gain lane of B"));
        ASSERT_NE(row, nullptr);
    }
    const GainLane& lane() const { return model.mix().strips[1].lane; }
    juce::Point<float> at(float shareX, float shareY) const {
        return {shareX * static_cast<float>(row->getWidth()), shareY * static_cast<float>(row->getHeight())};
    }
    void press(juce::Point<float> place) { row->mouseDown(mouseAt(*row, place)); }
    void setLane(const GainLane& lane) {
        model.change("Lane", [&](Mix& mix) { mix.strips[1].lane = lane; });
        show();
    }
    void nudge(int key, int times) {
        for (int i = 0; i < times; ++i) row->keyPressed(KeyPress{key, juce::ModifierKeys::shiftModifier, 0});
    }
};

TEST_F(LanesByHand, APointIsAddedMovedAndTakenAwayByKeys) {
    press(at(0.5f, 0.5f));
    row->mouseUp(mouseAt(*row, at(0.5f, 0.5f)));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 5.0, 0.2);
    EXPECT_NEAR(lane()[0].db, -15.0, 2.0) << "the middle of a fader";
    press(at(0.8f, 0.2f));
    ASSERT_EQ(lane().size(), 2u);
    const double db = lane()[1].db;
    EXPECT_TRUE(row->keyPressed(KeyPress{KeyPress::downKey}));
    EXPECT_NEAR(lane()[1].db, db - 0.5, 1e-9);
    EXPECT_TRUE(row->keyPressed(KeyPress{KeyPress::leftKey}));
    EXPECT_TRUE(row->keyPressed(KeyPress{KeyPress::deleteKey}));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 8.0, 0.2) << "the first has gone";
    for (int k = 0; k < 40; ++k)
        row->keyPressed(KeyPress{KeyPress::upKey, juce::ModifierKeys::shiftModifier, 0});
    EXPECT_EQ(lane()[0].db, maxStripDb) << "no louder than a fader";
    EXPECT_TRUE(row->keyPressed(KeyPress{KeyPress::returnKey}));
    EXPECT_EQ(lane().size(), 2u);
    EXPECT_TRUE(row->keyPressed(KeyPress{KeyPress::deleteKey, juce::ModifierKeys::shiftModifier, 0}));
    EXPECT_TRUE(lane().empty());
    model.undoManager().undo();
    EXPECT_EQ(lane().size(), 2u);
}

TEST_F(LanesByHand, AStripThatGoesTakesItsLaneAlong) {
    press(at(0.5f, 0.5f));
    model.detach(1);
    view.refresh(); // before the window has been told
    model.dispatchPendingMessages();
    for (const Strip& strip : model.mix().strips) EXPECT_TRUE(strip.lane.empty());
    EXPECT_EQ(find(view, "Gain lane of B"), nullptr);
    model.undoManager().undo();
    EXPECT_EQ(lane().size(), 1u);
}

TEST_F(LanesByHand, ANewPointIsDraggedFromWhereItWasAddedAndUndoneWithIt) {
    press(at(0.5f, 0.5f));
    row->mouseDrag(mouseAt(*row, at(0.3f, 0.3f)));
    row->mouseUp(mouseAt(*row, at(0.3f, 0.3f)));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 3.0, 0.2);
    const GainLane dragged = lane();
    nudge(KeyPress::downKey, 3);
    const GainLane lowered = lane();
    press(at(0.8f, 0.2f));
    const GainLane second = lane();
    nudge(KeyPress::downKey, 2);
    const GainLane later = lane();
    runFor(1.1);
    nudge(KeyPress::downKey, 1);
    for (const GainLane& before : {later, second, lowered, dragged, GainLane{}}) {
        model.undoManager().undo();
        EXPECT_EQ(lane(), before) << "a run of keys is a step of its own";
    }
}

TEST_F(LanesByHand, APointStaysBetweenItsNeighboursAndReturnAddsOneWhereTheLaneIs) {
    setLane({{2.0, -10.0}, {5.0, -12.0}, {8.0, -10.0}});
    for (int i = 0; i < 2; ++i) row->keyPressed(KeyPress{KeyPress::rightKey}); // the first, the second
    nudge(KeyPress::leftKey, 2);
    EXPECT_NEAR(lane()[1].seconds, 4.9, 1e-9);
    nudge(KeyPress::leftKey, 100);
    EXPECT_EQ(lane()[1].seconds, 2.0);
    nudge(KeyPress::rightKey, 200);
    EXPECT_EQ(lane()[1].seconds, 8.0);
    setLane({{0.0, -20.0}});
    row->keyPressed(KeyPress{KeyPress::returnKey});
    ASSERT_EQ(lane().size(), 2u);
    EXPECT_EQ(lane()[1].db, -20.0);
}

TEST_F(LanesByHand, APointThatWasUndoneIsNotChosenAndTheRightButtonTakesAwayTheOneBelowIt) {
    press(at(0.2f, 0.5f));
    press(at(0.8f, 0.2f));
    EXPECT_TRUE(row->getDescription().contains(" dB at "));
    model.undoManager().undo();
    model.dispatchPendingMessages();
    EXPECT_EQ(row->getDescription(), "1 point");
    press(at(0.8f, 0.2f));
    row->mouseDown(mouseAt(*row, at(0.2f, 0.5f), juce::ModifierKeys::rightButtonModifier));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 8.0, 0.2) << "not the one that was chosen";
}

TEST_F(LanesByHand, NearlyNoGainIsNone) {
    const auto share = 1.0f - static_cast<float>(LaneRow::scale().convertTo0to1(0.4));
    press({0.5f * static_cast<float>(row->getWidth()),
           5.0f + share * (static_cast<float>(row->getHeight()) - 10.0f)});
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_EQ(lane()[0].db, 0.0);
}

TEST_F(LanesByHand, HaveAsManyPointsAsAFileMayHold) {
    GainLane full;
    for (std::size_t i = 0; i < maxGainPoints; ++i)
        full.push_back({1e-3 * static_cast<double>(i), minStripDb});
    setLane(full);
    press(at(0.5f, 0.1f));
    EXPECT_EQ(lane().size(), maxGainPoints);
    EXPECT_EQ(model.messageText(), "Gain lane of B: at most 2000 points");
}

TEST_F(LanesByHand, OfASecondGroupAreItsOwnAndAllAreSeenToTheirEnds) {
    model.change("Groups", [](Mix& mix) {
        addGroup(mix, "Left hand");
        addGroup(mix, "Right hand");
        mix.groups[1].lane = {{12.0, -10.0}};
    });
    model.dispatchPendingMessages();
    for (const auto& [lastSeconds, middleSeconds] : {std::pair{12.0, 10.0}, {25.0, 15.0}, {100.0, 60.0}}) {
        model.change("Lane", [last = lastSeconds](Mix& mix) { mix.groups[1].lane = {{last, -10.0}}; });
        show();
        row = dynamic_cast<LaneRow*>(find(view, "Gain lane of Right hand"));
        ASSERT_NE(row, nullptr);
        press(at(0.5f, 0.9f));
        EXPECT_TRUE(model.mix().groups[0].lane.empty());
        ASSERT_EQ(model.mix().groups[1].lane.size(), 2u);
        EXPECT_NEAR(model.mix().groups[1].lane[0].seconds, middleSeconds, 0.02 * middleSeconds);
    }
}

// Faders that are moved while the model records become lanes, which play and are taken back.

struct RecordedLanes : testing::Test {
    const TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};

    bool wait(double seconds) {
        const auto until = model.session().world().sceneNs() + static_cast<std::int64_t>(1e9 * seconds);
        return runUntil([&] { return model.poll(), model.session().world().sceneNs() >= until; });
    }
    void start() {
        ASSERT_EQ(model.recording().start(folder("take.wav")), "");
        ASSERT_TRUE(wait(0.1));
    }
    void stop() {
        ASSERT_TRUE(wait(0.1));
        model.recording().stop();
        model.poll();
    }
    void setFaders(std::array<double, 3> db) {
        model.change("Gain", [&](Mix& mix) {
            for (std::size_t j = 0; j < db.size(); ++j) mix.strips[j].gainDb = db[j];
        });
    }
    /// As the session has it last.
    float lastGain(int channel) {
        float gain = 1.0f;
        for (const auto& c : model.savedSession().log.channels)
            if (c.kind == RenderControl::Kind::gain && c.channel == channel) gain = c.value;
        return gain;
    }
    const Strip& strip(std::size_t number) const { return model.mix().strips[number]; }
};

TEST_F(RecordedLanes, FadersThatAreMovedWhileItRecordsAreWrittenAndPlayedAgain) {
    model.change("Group", [](Mix& mix) { addGroup(mix, "Left hand"); });
    model.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -6.0; });
    ASSERT_EQ(model.recording().start(folder("take.wav")), "");
    ASSERT_TRUE(wait(0.3));
    model.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -26.0, mix.groups[0].gainDb = -12.0; });
    ASSERT_TRUE(wait(0.3));
    model.recording().stop();
    ASSERT_TRUE(runUntil([&] { return model.poll(), !model.mix().strips[2].lane.empty(); }))
        << model.messageText();
    EXPECT_EQ(model.mix().strips[2].gainDb, -6.0) << "back where it was";
    EXPECT_EQ(model.mix().groups[0].gainDb, 0.0);
    EXPECT_EQ(model.mix().strips[2].lane.front().db, 0.0);
    EXPECT_EQ(model.mix().strips[2].lane.back().db, -20.0);
    EXPECT_EQ(model.mix().groups[0].lane.back().db, -12.0);
    EXPECT_TRUE(model.mix().strips[0].lane.empty());
    EXPECT_NEAR(lastGain(2), 0.0501, 1e-3) << "felt as when it was moved";
    model.restart(model.mix().seed);
    ASSERT_TRUE(runUntil([&] { return model.poll(), std::abs(lastGain(2) - 0.501f) < 1e-3f; }))
        << lastGain(2);
    ASSERT_TRUE(runUntil([&] { return model.poll(), std::abs(lastGain(2) - 0.0501f) < 1e-3f; }))
        << "and falls again";
    model.undoManager().undo();
    EXPECT_TRUE(model.mix().strips[2].lane.empty());
    EXPECT_EQ(model.mix().strips[2].gainDb, -26.0);
}

TEST_F(RecordedLanes, WithoutAPointTheFaderIsHeardAgain) {
    model.change("Lane", [](Mix& mix) { mix.strips[1].lane = {{0.0, -20.0}}; });
    ASSERT_TRUE(runUntil([&] { return std::abs(lastGain(1) - 0.1f) < 1e-6f; }));
    model.undoManager().undo();
    EXPECT_EQ(lastGain(1), 1.0f);
}

TEST_F(RecordedLanes, AreFeltAsTheFadersThatWereMoved) {
    setFaders({minStripDb, -20.0, -6.0});
    start();
    setFaders({-10.0, 0.0, minStripDb});
    stop();
    const double end = 1e9;
    EXPECT_EQ(strip(0).gainDb, -10.0) << "below a silent fader no lane would be felt";
    EXPECT_EQ(strip(1).gainDb, -6.0) << "a lane lifts by 6 dB at most";
    EXPECT_EQ(strip(2).gainDb, -6.0);
    EXPECT_EQ(gainDbAt(model.mix(), 0, 0.0), minStripDb);
    EXPECT_EQ(gainDbAt(model.mix(), 0, end), -10.0);
    EXPECT_EQ(gainDbAt(model.mix(), 1, 0.0), -20.0);
    EXPECT_EQ(gainDbAt(model.mix(), 1, end), 0.0);
    EXPECT_EQ(gainDbAt(model.mix(), 2, 0.0), -6.0);
    EXPECT_EQ(strip(2).lane.back().db, minStripDb) << "silence, wherever the fader is put later";
}

TEST_F(RecordedLanes, AreAddedToTheLaneThatPlays) {
    model.change("Lane", [](Mix& mix) { mix.strips[0].lane = {{0.0, -6.0}}; });
    start();
    setFaders({-10.0, 0.0, 0.0});
    stop();
    EXPECT_EQ(gainDbAt(model.mix(), 0, 0.0), -6.0);
    EXPECT_EQ(gainDbAt(model.mix(), 0, 1e9), -16.0);
}

TEST_F(RecordedLanes, EndWithTheRunOfTheSceneAndBeginWithTheNext) {
    start();
    setFaders({-10.0, 0.0, 0.0});
    ASSERT_TRUE(wait(0.1));
    model.restart(model.mix().seed);
    ASSERT_TRUE(runUntil([&] { return model.poll(), !strip(0).lane.empty(); }));
    EXPECT_TRUE(model.recording().isRunning());
    setFaders({0.0, -10.0, 0.0});
    stop();
    EXPECT_FALSE(strip(1).lane.empty());
}

TEST_F(RecordedLanes, StayWithTheirStripAndGroupWhereOthersComeOrGoAndBeginAgain) {
    model.change("Groups", [](Mix& mix) { addGroup(mix, "Left hand"), addGroup(mix, "Right hand"); });
    start();
    setFaders({-10.0, -10.0, -12.0});
    model.change("Gain", [](Mix& mix) { mix.groups[1].gainDb = -6.0; });
    ASSERT_TRUE(wait(0.1));
    model.detach(1);
    model.change("Groups",
                 [](Mix& mix) { removeGroup(mix, 0), addGroup(mix, "Both"), addGroup(mix, "None"); });
    model.poll();
    for (const auto& [j, db] : {std::pair{0, -10.0}, {1, -12.0}, {2, 0.0}}) // A, C and D
        EXPECT_EQ(gainDbAt(model.mix(), j, 1e9), db) << labelOf(model.mix(), j);
    model.change("Gain", [](Mix& mix) { mix.groups[1].gainDb = -12.0; });
    stop();
    const auto& groups = model.mix().groups;
    ASSERT_FALSE(groups[0].lane.empty() || groups[1].lane.empty());
    EXPECT_EQ(groups[0].lane.back().db, -6.0);
    EXPECT_EQ(groups[1].lane.back().db, -12.0);
    EXPECT_TRUE(groups[2].lane.empty());
}

// Groups at the model and in its window: what they do to strips, how they are named, shown and taken back.

struct LeftHand : RecordedLanes {
    LeftHand() {
        model.change("Group", [](Mix& mix) {
            mix.strips[0].group = mix.strips[1].group = addGroup(mix, "Left hand");
        });
    }
};

TEST_F(LeftHand, AFaderAndAMuteOfAGroupReachTheSessionAndAreTakenBack) {
    model.change("Gain", [](Mix& mix) { mix.groups[0].gainDb = -20.0; });
    EXPECT_FLOAT_EQ(lastGain(0), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(1), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(2), 1.0f);
    model.change("Mute", [](Mix& mix) { mix.groups[0].isMuted = true; });
    std::vector<int> muted;
    for (const auto& c : model.savedSession().log.channels)
        if (c.kind == RenderControl::Kind::mute && c.value != 0.0f) muted.push_back(c.channel);
    EXPECT_EQ(muted, (std::vector<int>{0, 1}));
    model.undoManager().undo();
    model.undoManager().undo();
    EXPECT_FLOAT_EQ(lastGain(0), 1.0f);
    const auto again = readSession(sessionJson(model.savedSession()), "s.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(mixAtEnd(again.value).groups, model.mix().groups);
    model.detach(0);
    EXPECT_EQ(model.mix().strips[0].group, 0) << "a strip takes its group along";
}

TEST_F(LeftHand, NoOtherHasItsName) {
    model.change("Group", [](Mix& mix) { addGroup(mix, "Right hand"); });
    MixerView view{model};
    auto& name = the<juce::Label>(view, "Name of Right hand");
    name.setText("Left hand", juce::sendNotificationSync);
    EXPECT_EQ(model.mix().groups[1].name, "Right hand") << "else its recorded moves were written to the left";
    EXPECT_EQ(name.getText(), "Right hand");
}

TEST_F(LeftHand, AreMadeRenamedMutedAndTakenApartInTheWindow) {
    MixerView view{model};
    model.dispatchPendingMessages();
    auto* mute = dynamic_cast<juce::Button*>(find(view, "Mute the group Left hand"));
    ASSERT_NE(mute, nullptr);
    for (const bool isMuted : {true, false, true}) { // a mute is taken back by the next click
        mute->triggerClick();
        ASSERT_TRUE(runUntil([&] { return model.mix().groups[0].isMuted == isMuted; }));
    }
    juce::Slider* fader = nullptr;
    for (auto* child : the(view, "Group Left hand").getChildren())
        if (auto* slider = dynamic_cast<juce::Slider*>(child)) fader = slider;
    ASSERT_NE(fader, nullptr);
    fader->setValue(-12.0, juce::sendNotificationSync);
    EXPECT_EQ(model.mix().groups[0].gainDb, -12.0);
    model.undoManager().undo();
    model.dispatchPendingMessages();
    EXPECT_EQ(fader->getValue(), 0.0) << "after it was undone, too";
    auto& name = the<juce::Label>(view, "Name of Left hand");
    for (const auto& bad : {juce::String{"  "}, juce::String::repeatedString("x", 2000)}) {
        name.setText(bad, juce::sendNotificationSync);
        ASSERT_EQ(model.mix().groups[0].name, "Left hand");
        EXPECT_EQ(name.getText(), "Left hand");
    }
    name.setText("Palm", juce::sendNotificationSync);
    EXPECT_EQ(model.mix().groups[0].name, "Palm");
    model.dispatchPendingMessages();
    auto& ungroup = the<juce::Button>(view, "Ungroup Palm");
    ungroup.triggerClick();
    ASSERT_TRUE(runUntil([&] { return model.mix().groups.empty(); }));
    EXPECT_TRUE(model.mix().strips[1].isMuted) << "felt as before";
    model.dispatchPendingMessages();
    EXPECT_EQ(find(view, "Ungroup Palm"), nullptr);
}

} // namespace physvib::lanes_by_hand_test
