// SPDX-License-Identifier: MIT
// Inputs of a session at their limits: what does not fit is refused and counted, what is asked for twice
// acts once.
#include "FakeHost.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;
constexpr int rate = hostRate, block = 480;
using Kind = RenderControl::Kind;

void play(Session& session, int blocks) {
    static Block out;
    for (int i = 0; i < blocks; ++i) {
        session.advance();
        session.render(out.at.data(), block, RenderMode::realtime);
        drain(session);
    }
    session.advance();
}

/// The gain that the channel got last.
float lastGain(Session& session, SessionLog& log, int channel) {
    session.readLog(log);
    float gain = 1.0f;
    for (const ChannelChange& c : log.channels)
        if (c.kind == Kind::gain && c.channel == channel) gain = c.value;
    return gain;
}

TEST(SessionInputs, WhatTheRenderCallCannotQueueIsCounted) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    std::uint64_t refused = 0;
    for (int i = 0; i < 1500; ++i) {
        const CollisionEvent strike{.frequencyHz = 205, .decayPerSecond = 30, .amplitude = 0.001};
        if (!session.callback().strike(strike, 0)) ++refused;
        if (!session.callback().perform({.hold = {1.0, 0.0}}, 0)) ++refused;
    }
    EXPECT_GT(refused, 0u);
    play(session, 1);
    EXPECT_EQ(session.status().refused, refused);
}

TEST(SessionInputs, AGroupIsScaledAsItIsPerformed) {
    auto setup = shakeTheBoxSetup(0.02);
    BodyDescription note{"note", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 0, true}}, {3.0, 2.0}};
    note.velocityMetresPerSecond = {4.0, -2.0};
    setup.groups = {{SpawnAction{note, {}}, ImpulseAction{"large rubber ball", {6.0, 8.0}, {}}}};
    Session session{setup};
    session.prepare(rate, block);
    session.advance();
    session.callback().perform({.group = 0, .scale = 0.5}, 0);
    session.callback().perform({.group = 1}, 0); // there is none
    play(session, 2);
    SessionLog log;
    session.readLog(log);
    const auto& inputs = log.takes.at(0).inputs;
    ASSERT_EQ(inputs.size(), 2u);
    EXPECT_EQ(std::get<SpawnAction>(inputs[0].action).body.velocityMetresPerSecond, (Vector{2.0, -1.0}));
    EXPECT_EQ(std::get<ImpulseAction>(inputs[1].action).newtonSeconds, (Vector{3.0, 4.0}));
}

TEST(SessionInputs, AFaderThatIsSetBesideItsLaneHoldsWhileTheSceneStandsStill) {
    const auto setup = shakeTheBoxSetup(0.02);
    Mix mix;
    mix.layout = describeLayout("phone4", setup.panner.layout());
    mix.resizeStrips();
    mix.strips[1].lane = {{0.0, -20.0}};
    Session session{setup};
    session.prepare(rate, block);
    SessionLog log;
    ASSERT_TRUE(session.submit({Lanes{std::make_shared<const Mix>(mix)}}));
    session.world().setSlowness(0);
    play(session, 2);
    EXPECT_FLOAT_EQ(lastGain(session, log, 1), 0.1f);
    ASSERT_TRUE(session.submit({RenderControl{0, Kind::gain, 1, 0.5f, {}}}));
    play(session, 2);
    EXPECT_FLOAT_EQ(lastGain(session, log, 1), 0.5f);
    session.world().restart();
    play(session, 2);
    EXPECT_FLOAT_EQ(lastGain(session, log, 1), 0.1f) << "another run, though its time is the same";
    ASSERT_TRUE(session.submit({RenderControl{0, Kind::gain, 1, 0.5f, {}}}));
    session.world().setSlowness(1);
    play(session, 2);
    EXPECT_FLOAT_EQ(lastGain(session, log, 1), 0.1f) << "the scene goes on, and the lane with it";
}

TEST(SessionInputs, AsManyStopsWaitAsThereIsRoomFor) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    for (int i = 0; i < 256; ++i) ASSERT_TRUE(session.submit({Stop{}, 1'000'000'000 + i})) << i;
    EXPECT_EQ(session.submit({Stop{}, 2'000'000'000}).error, "too many stops wait");
}

TEST(SessionInputs, TheSameRecordingsAgainChangeNothing) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    const PlayedRecordings wood{{{205.0, rate, {0.1f, 0.2f}, {.frequencyHz = 205.0, .path = "wood.wav"}}}};
    ASSERT_TRUE(session.submit({wood}));
    ASSERT_TRUE(session.submit({wood}));
    SessionLog log;
    session.readLog(log);
    EXPECT_EQ(log.recordings.size(), 1u) << "what sounds was not faded out again";
}

TEST(SessionInputs, ClipsAreBoundedBySamplesAtTheSessionsRate) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(192'000, block);
    const auto clip = [](const char* path, std::size_t samples) {
        return std::array{
            ContactRecording{0.0, 8'000, std::vector<float>(samples), {.path = path, .hash = path}}};
    };
    EXPECT_FALSE(session.keepClip(clip("long", 1'400'000))) << "24 times as many at 192 kHz";
    EXPECT_EQ(session.keepClip(clip("short", 1'400)), 0);
}

TEST(SessionInputs, TheSmallestMarginNeverRises) {
    Session session{shakeTheBoxSetup(0.05)};
    session.prepare(rate, block);
    Block out;
    std::int64_t margin = noMargin;
    for (int i = 0; i < 1000; ++i) {
        if (i % 7 == 0 || i % 3 == 0) session.advance();
        session.render(out.at.data(), block, RenderMode::realtime);
        drain(session);
        ASSERT_LE(session.status().leastMarginFrames, margin);
        margin = session.status().leastMarginFrames;
    }
    EXPECT_LT(margin, noMargin) << "there were events";
}

TEST(SessionInputs, AStrikeThatCannotBeStoppedMustNotBeFarAhead) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    const std::array strikes{
        CollisionEvent{.timeNs = limits::maxTimeNs / 2, .frequencyHz = 205, .decayPerSecond = 30}};
    EXPECT_FALSE(session.submit({Strikes{strikes}}));
    EXPECT_TRUE(session.submit({Strikes{strikes, true}})) << "one that waits in the session can be";
}

TEST(SessionInputs, AStopLeavesWhatIsDueHoweverLateTheDriver) {
    auto setup = shakeTheBoxSetup(0.02);
    setup.scene.bodies.clear();
    setup.scene.joints.clear();
    setup.scene.script.clear();
    setup.direct = Direct::told; // a stop acts on a time that is past in the session
    const auto felt = [&](bool isDriverLate) {
        Session session{setup};
        session.prepare(rate, block);
        play(session, 100);
        const std::array strikes{CollisionEvent{.frequencyHz = 205, .decayPerSecond = 30, .amplitude = 0.5}};
        EXPECT_TRUE(session.submit({Strikes{strikes, true}, 1'005'000'000}));
        Block out;
        session.render(out.at.data(), block, RenderMode::realtime);
        if (!isDriverLate) session.advance();
        EXPECT_TRUE(session.submit({Stop{}}));
        for (int i = 0; i < 20; ++i) {
            session.advance();
            session.render(out.at.data(), block, RenderMode::realtime);
        }
        return drain(session);
    };
    EXPECT_EQ(felt(false).size(), 1u);
    EXPECT_EQ(felt(true), felt(false));
}

TEST(SessionInputs, ACeilingThatIsLoweredIsStillTheHighestThatWas) {
    auto setup = shakeTheBoxSetup(0.02);
    setup.ceilings.fill(0.2f);
    Session session{setup};
    session.prepare(rate, block);
    for (const float ceiling : {0.5f, 0.1f})
        ASSERT_TRUE(session.submit({RenderControl{0, Kind::ceiling, 1, ceiling, {}}}));
    EXPECT_EQ(session.rendered().ceiling(1), 0.5f);
    EXPECT_EQ(session.rendered().ceiling(0), 0.2f);
}

TEST(WaitingStrikes, AreForgottenFromATimeOnAndBounded) {
    const auto at = [](std::int64_t timeNs) { return std::array{CollisionEvent{.timeNs = timeNs}}; };
    WaitingStrikes waiting;
    for (const std::int64_t timeNs : {20, 10, 30}) EXPECT_TRUE(waiting.add(at(timeNs)));
    waiting.forget(20);
    EXPECT_EQ(waiting.size(), 1u) << "that of 20 ns has gone as well";
    EXPECT_FALSE(waiting.add(std::vector<CollisionEvent>(WaitingStrikes::most)));
    EXPECT_EQ(waiting.size(), 1u) << "nothing of what found no room was kept";
}

} // namespace
} // namespace physvib
