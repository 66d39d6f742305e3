// SPDX-License-Identifier: GPL-3.0-or-later
// Gain lanes in the mixer's window: points are added, moved and taken away by pointer and keys.
#include "Live/Documents/Mix.h"
#include "Mixer/Strips/LanesTab.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;
using juce::KeyPress;

class LanesByHand : public ::testing::Test {
protected:
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
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
        model.dispatchPendingMessages();
        view.refresh();
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
    EXPECT_EQ(lane()[0].db, mostStripDb) << "no louder than a fader";
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
    model.undoManager().undo();
    EXPECT_TRUE(lane().empty());
}

TEST_F(LanesByHand, APointStaysBetweenItsNeighbours) {
    setLane({{2.0, -10.0}, {5.0, -12.0}, {8.0, -10.0}});
    for (int i = 0; i < 2; ++i) row->keyPressed(KeyPress{KeyPress::rightKey}); // the first, the second
    nudge(KeyPress::leftKey, 2);
    EXPECT_NEAR(lane()[1].seconds, 4.9, 1e-9);
    nudge(KeyPress::leftKey, 100);
    EXPECT_EQ(lane()[1].seconds, 2.0);
    nudge(KeyPress::rightKey, 200);
    EXPECT_EQ(lane()[1].seconds, 8.0);
}

TEST_F(LanesByHand, ReturnAddsAPointWhereTheLaneIs) {
    setLane({{0.0, -20.0}});
    row->keyPressed(KeyPress{KeyPress::returnKey});
    ASSERT_EQ(lane().size(), 2u);
    EXPECT_EQ(lane()[1].db, -20.0);
}

TEST_F(LanesByHand, TheRightButtonTakesAwayThePointBelowIt) {
    press(at(0.2f, 0.5f));
    press(at(0.8f, 0.2f));
    row->mouseDown(mouseAt(*row, at(0.2f, 0.5f), juce::ModifierKeys::rightButtonModifier));
    ASSERT_EQ(lane().size(), 1u);
    EXPECT_NEAR(lane()[0].seconds, 8.0, 0.2) << "not the one that was chosen";
}

TEST_F(LanesByHand, APointThatWasUndoneIsNoLongerChosen) {
    press(at(0.3f, 0.5f));
    press(at(0.8f, 0.2f));
    EXPECT_TRUE(row->getDescription().contains(" dB at "));
    model.undoManager().undo();
    model.dispatchPendingMessages();
    EXPECT_EQ(row->getDescription(), "1 point");
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
    for (std::size_t i = 0; i < mostGainPoints; ++i)
        full.push_back({1e-3 * static_cast<double>(i), leastStripDb});
    setLane(full);
    press(at(0.5f, 0.1f));
    EXPECT_EQ(lane().size(), mostGainPoints);
    EXPECT_EQ(model.trouble(), "Gain lane of B: at most 2000 points");
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
        model.dispatchPendingMessages();
        view.refresh();
        row = dynamic_cast<LaneRow*>(find(view, "Gain lane of Right hand"));
        ASSERT_NE(row, nullptr);
        press(at(0.5f, 0.9f));
        EXPECT_TRUE(model.mix().groups[0].lane.empty());
        ASSERT_EQ(model.mix().groups[1].lane.size(), 2u);
        EXPECT_NEAR(model.mix().groups[1].lane[0].seconds, middleSeconds, 0.02 * middleSeconds);
    }
}

} // namespace
} // namespace physvib
