// SPDX-License-Identifier: GPL-3.0-or-later
// Faders that are moved while the model records become lanes, which play and are taken back.
#include "Live/Documents/Mix.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;

float lastRecordedGain(MixerModel& model, int channel) {
    float gain = 1.0f;
    for (const auto& c : model.saved().log.channels)
        if (c.kind == RenderControl::Kind::gain && c.channel == channel) gain = c.value;
    return gain;
}

TEST(Lanes, FadersThatAreMovedWhileItRecordsAreWrittenAndPlayedAgain) {
    const TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};
    model.change("Group", [](Mix& mix) { addGroup(mix, "Left hand"); });
    model.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -6.0; });
    ASSERT_EQ(model.recording().start(folder("take.wav")), "");
    const auto wait = [&](double seconds) {
        const auto until = model.session().world().sceneNs() + static_cast<std::int64_t>(1e9 * seconds);
        return runUntil([&] { return model.look(), model.session().world().sceneNs() >= until; });
    };
    ASSERT_TRUE(wait(0.3));
    model.change("Gain", [](Mix& mix) { mix.strips[2].gainDb = -26.0, mix.groups[0].gainDb = -12.0; });
    ASSERT_TRUE(wait(0.3));
    model.recording().stop();
    ASSERT_TRUE(runUntil([&] { return model.look(), !model.mix().strips[2].lane.empty(); }))
        << model.trouble();
    EXPECT_EQ(model.mix().strips[2].gainDb, -6.0) << "back where it was";
    EXPECT_EQ(model.mix().groups[0].gainDb, 0.0);
    EXPECT_EQ(model.mix().strips[2].lane.front().db, 0.0);
    EXPECT_EQ(model.mix().strips[2].lane.back().db, -20.0);
    EXPECT_EQ(model.mix().groups[0].lane.back().db, -12.0);
    EXPECT_TRUE(model.mix().strips[0].lane.empty());
    EXPECT_NEAR(lastRecordedGain(model, 2), 0.0501, 1e-3) << "felt as when it was moved";
    model.restart(model.mix().seed);
    ASSERT_TRUE(runUntil([&] { return model.look(), std::abs(lastRecordedGain(model, 2) - 0.501f) < 1e-3f; }))
        << lastRecordedGain(model, 2);
    ASSERT_TRUE(runUntil([&] {
        return model.look(), std::abs(lastRecordedGain(model, 2) - 0.0501f) < 1e-3f;
    })) << "and falls again";
    model.undoManager().undo();
    EXPECT_TRUE(model.mix().strips[2].lane.empty());
    EXPECT_EQ(model.mix().strips[2].gainDb, -26.0);
}

TEST(Lanes, WithoutAPointTheFaderIsHeardAgain) {
    MixerModel model{onlyNoDevice(), noDevice};
    model.change("Lane", [](Mix& mix) { mix.strips[1].lane = {{0.0, -20.0}}; });
    ASSERT_TRUE(runUntil([&] { return std::abs(lastRecordedGain(model, 1) - 0.1f) < 1e-6f; }));
    model.undoManager().undo();
    EXPECT_EQ(lastRecordedGain(model, 1), 1.0f);
}

class RecordedLanes : public ::testing::Test {
protected:
    const TestFolder folder;
    MixerModel model{onlyNoDevice(), noDevice};

    bool wait(double seconds) {
        const auto until = model.session().world().sceneNs() + static_cast<std::int64_t>(1e9 * seconds);
        return runUntil([&] { return model.look(), model.session().world().sceneNs() >= until; });
    }
    void start() {
        ASSERT_EQ(model.recording().start(folder("take.wav")), "");
        ASSERT_TRUE(wait(0.1));
    }
    void stop() {
        ASSERT_TRUE(wait(0.1));
        model.recording().stop();
        model.look();
    }
    void setFaders(std::array<double, 3> db) {
        model.change("Gain", [&](Mix& mix) {
            for (std::size_t j = 0; j < db.size(); ++j) mix.strips[j].gainDb = db[j];
        });
    }
    const Strip& strip(std::size_t number) const { return model.mix().strips[number]; }
};

TEST_F(RecordedLanes, AreFeltAsTheFadersThatWereMoved) {
    setFaders({leastStripDb, -20.0, -6.0});
    start();
    setFaders({-10.0, 0.0, leastStripDb});
    stop();
    const double end = 1e9;
    EXPECT_EQ(strip(0).gainDb, -10.0) << "below a silent fader no lane would be felt";
    EXPECT_EQ(strip(1).gainDb, -6.0) << "a lane lifts by 6 dB at most";
    EXPECT_EQ(strip(2).gainDb, -6.0);
    EXPECT_EQ(gainDbAt(model.mix(), 0, 0.0), leastStripDb);
    EXPECT_EQ(gainDbAt(model.mix(), 0, end), -10.0);
    EXPECT_EQ(gainDbAt(model.mix(), 1, 0.0), -20.0);
    EXPECT_EQ(gainDbAt(model.mix(), 1, end), 0.0);
    EXPECT_EQ(gainDbAt(model.mix(), 2, 0.0), -6.0);
    EXPECT_EQ(strip(2).lane.back().db, leastStripDb) << "silence, wherever the fader is put later";
}

TEST_F(RecordedLanes, AreAddedToTheLaneThatPlays) {
    model.change("Lane", [](Mix& mix) { mix.strips[0].lane = {{0.0, -6.0}}; });
    start();
    setFaders({-10.0, 0.0, 0.0});
    stop();
    EXPECT_EQ(gainDbAt(model.mix(), 0, 0.0), -6.0);
    EXPECT_EQ(gainDbAt(model.mix(), 0, 1e9), -16.0);
}

TEST_F(RecordedLanes, AreOfTheGroupWhoseFaderWasMoved) {
    model.change("Groups", [](Mix& mix) {
        addGroup(mix, "Left hand");
        addGroup(mix, "Right hand");
    });
    start();
    model.change("Gain", [](Mix& mix) { mix.groups[1].gainDb = -12.0; });
    stop();
    EXPECT_TRUE(model.mix().groups[0].lane.empty());
    ASSERT_FALSE(model.mix().groups[1].lane.empty());
    EXPECT_EQ(model.mix().groups[1].lane.back().db, -12.0);
}

TEST_F(RecordedLanes, EndWithTheRunOfTheSceneAndBeginWithTheNext) {
    start();
    setFaders({-10.0, 0.0, 0.0});
    ASSERT_TRUE(wait(0.1));
    model.restart(model.mix().seed);
    ASSERT_TRUE(runUntil([&] { return model.look(), !strip(0).lane.empty(); }));
    EXPECT_TRUE(model.recording().isRunning());
    setFaders({0.0, -10.0, 0.0});
    stop();
    EXPECT_FALSE(strip(1).lane.empty());
}

TEST_F(RecordedLanes, EndWhereAGroupIsAddedAndBeginAgain) {
    start();
    setFaders({-10.0, 0.0, 0.0});
    ASSERT_TRUE(wait(0.1));
    model.change("Group", [](Mix& mix) { addGroup(mix, "Left hand"); });
    model.look();
    EXPECT_FALSE(strip(0).lane.empty());
    model.change("Gain", [](Mix& mix) { mix.groups[0].gainDb = -12.0; });
    stop();
    EXPECT_FALSE(model.mix().groups[0].lane.empty());
}

} // namespace
} // namespace physvib
