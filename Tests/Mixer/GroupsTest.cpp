// SPDX-License-Identifier: GPL-3.0-or-later
// Groups and gain lanes at the desk and in its window: what they do to strips, how they are written, edited
// and taken back.
#include "Live/Documents/StripGroups.h"
#include "Mixer/Strips/LanesTab.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;
using Kind = RenderControl::Kind;

float lastGain(Desk& desk, int channel) {
    float gain = 1.0f;
    for (const auto& c : desk.saved().log.channels)
        if (c.kind == Kind::gain && c.channel == channel) gain = c.value;
    return gain;
}

void group(Desk& desk) {
    desk.change("Group",
                [](Mix& mix) { mix.strips[0].group = mix.strips[1].group = addGroup(mix, "Left hand"); });
}

TEST(Groups, AFaderAndAMuteOfAGroupReachTheSessionAndAreTakenBack) {
    Desk desk{onlyNoDevice(), noDevice};
    group(desk);
    desk.change("Gain", [](Mix& mix) { mix.groups[0].gainDb = -20.0; });
    EXPECT_FLOAT_EQ(lastGain(desk, 0), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(desk, 1), 0.1f);
    EXPECT_FLOAT_EQ(lastGain(desk, 2), 1.0f);
    desk.change("Mute", [](Mix& mix) { mix.groups[0].isMuted = true; });
    std::vector<int> muted;
    for (const auto& c : desk.saved().log.channels)
        if (c.kind == Kind::mute && c.value != 0.0f) muted.push_back(c.channel);
    EXPECT_EQ(muted, (std::vector<int>{0, 1}));
    desk.undoManager().undo();
    desk.undoManager().undo();
    EXPECT_FLOAT_EQ(lastGain(desk, 0), 1.0f);
    const auto again = readSession(sessionJson(desk.saved()), "s.json");
    ASSERT_TRUE(again) << again.error;
    EXPECT_EQ(mixOf(again.value).groups, desk.mix().groups);
    desk.detach(0);
    EXPECT_EQ(desk.mix().strips[0].group, 0) << "a strip takes its group along";
}

TEST(Groups, AreMadeRenamedMutedAndTakenApartInTheWindow) {
    Desk desk{onlyNoDevice(), noDevice};
    MixerView view{desk};
    group(desk);
    desk.dispatchPendingMessages();
    auto* mute = dynamic_cast<juce::Button*>(find(view, "Mute the group Left hand"));
    ASSERT_NE(mute, nullptr);
    mute->triggerClick();
    ASSERT_TRUE(runUntil([&] { return desk.mix().groups[0].isMuted; }));
    auto* name = dynamic_cast<juce::Label*>(find(view, "Name of Left hand"));
    ASSERT_NE(name, nullptr);
    name->setText("Palm", juce::sendNotificationSync);
    EXPECT_EQ(desk.mix().groups[0].name, "Palm");
    desk.dispatchPendingMessages();
    dynamic_cast<juce::Button*>(find(view, "Ungroup Palm"))->triggerClick();
    ASSERT_TRUE(runUntil([&] { return desk.mix().groups.empty(); }));
    EXPECT_TRUE(desk.mix().strips[1].isMuted) << "felt as before";
    desk.dispatchPendingMessages();
    EXPECT_EQ(find(view, "Ungroup Palm"), nullptr);
}

TEST(Lanes, FadersThatAreMovedWhileItRecordsAreWrittenAndPlayedAgain) {
    const TestFolder folder;
    Desk desk{onlyNoDevice(), noDevice};
    group(desk);
    desk.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -6.0; });
    ASSERT_EQ(desk.recording().start(folder("take.wav")), "");
    const auto wait = [&](double seconds) {
        const auto until = desk.session().world().sceneNs() + static_cast<std::int64_t>(1e9 * seconds);
        return runUntil([&] { return desk.look(), desk.session().world().sceneNs() >= until; });
    };
    ASSERT_TRUE(wait(0.3));
    desk.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -26.0, mix.groups[0].gainDb = -12.0; });
    ASSERT_TRUE(wait(0.3));
    desk.recording().stop();
    ASSERT_TRUE(runUntil([&] { return desk.look(), !desk.mix().strips[2].lane.empty(); })) << desk.trouble();
    EXPECT_EQ(desk.mix().strips[2].gainDb, -6.0) << "back where it was";
    EXPECT_EQ(desk.mix().groups[0].gainDb, 0.0);
    EXPECT_EQ(desk.mix().strips[2].lane.front().db, 0.0);
    EXPECT_EQ(desk.mix().strips[2].lane.back().db, -20.0);
    EXPECT_EQ(desk.mix().groups[0].lane.back().db, -12.0);
    EXPECT_TRUE(desk.mix().strips[0].lane.empty());
    EXPECT_NEAR(lastGain(desk, 2), 0.0501, 1e-3) << "felt as when it was moved";
    desk.restart(desk.mix().seed);
    ASSERT_TRUE(runUntil([&] { return desk.look(), std::abs(lastGain(desk, 2) - 0.501f) < 1e-3f; }))
        << lastGain(desk, 2);
    ASSERT_TRUE(runUntil([&] { return desk.look(), std::abs(lastGain(desk, 2) - 0.0501f) < 1e-3f; }))
        << "and falls again";
    desk.undoManager().undo();
    EXPECT_TRUE(desk.mix().strips[2].lane.empty());
    EXPECT_EQ(desk.mix().strips[2].gainDb, -26.0);
}

TEST(Lanes, WithoutAPointTheFaderIsHeardAgain) {
    Desk desk{onlyNoDevice(), noDevice};
    desk.change("Lane", [](Mix& mix) { mix.strips[1].lane = {{0.0, -20.0}}; });
    ASSERT_TRUE(runUntil([&] { return std::abs(lastGain(desk, 1) - 0.1f) < 1e-6f; }));
    desk.undoManager().undo();
    EXPECT_EQ(lastGain(desk, 1), 1.0f);
}

class LanesByHand : public ::testing::Test {
protected:
    Desk desk{onlyNoDevice(), noDevice};
    MixerView view{desk};
    LaneRow* row = nullptr;
    void SetUp() override {
        view.scope().choose("Gain lanes");
        view.refresh();
        row = dynamic_cast<LaneRow*>(find(view, "Gain lane of B"));
        ASSERT_NE(row, nullptr);
    }
    const GainLane& lane() const { return desk.mix().strips[1].lane; }
    juce::Point<float> at(float shareX, float shareY) const {
        return {shareX * static_cast<float>(row->getWidth()), shareY * static_cast<float>(row->getHeight())};
    }
    void press(juce::Point<float> place) { row->mouseDown(mouseAt(*row, place)); }
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
    EXPECT_TRUE(row->keyPressed(juce::KeyPress{juce::KeyPress::downKey}));
    EXPECT_NEAR(lane()[1].db, db - 0.5, 1e-9);
    EXPECT_TRUE(row->keyPressed(juce::KeyPress{juce::KeyPress::leftKey}));
    EXPECT_TRUE(row->keyPressed(juce::KeyPress{juce::KeyPress::deleteKey}));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 8.0, 0.2) << "the first has gone";
    for (int k = 0; k < 40; ++k)
        row->keyPressed(juce::KeyPress{juce::KeyPress::upKey, juce::ModifierKeys::shiftModifier, 0});
    EXPECT_EQ(lane()[0].db, mostStripDb) << "no louder than a fader";
    EXPECT_TRUE(row->keyPressed(juce::KeyPress{juce::KeyPress::returnKey}));
    EXPECT_EQ(lane().size(), 2u);
    EXPECT_TRUE(
        row->keyPressed(juce::KeyPress{juce::KeyPress::deleteKey, juce::ModifierKeys::shiftModifier, 0}));
    EXPECT_TRUE(lane().empty());
    desk.undoManager().undo();
    EXPECT_EQ(lane().size(), 2u);
}

TEST_F(LanesByHand, AStripThatGoesTakesItsLaneAlong) {
    press(at(0.5f, 0.5f));
    desk.detach(1);
    view.refresh(); // before the window has been told
    desk.dispatchPendingMessages();
    for (const Strip& strip : desk.mix().strips) EXPECT_TRUE(strip.lane.empty());
    EXPECT_EQ(find(view, "Gain lane of B"), nullptr);
    desk.undoManager().undo();
    EXPECT_EQ(lane().size(), 1u);
}

} // namespace
} // namespace physvib
