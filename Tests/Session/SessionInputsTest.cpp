// SPDX-License-Identifier: MIT
// Inputs of a session at their limits: what does not fit is refused and counted, what is asked for twice
// acts once.
#include "FakeHost.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/Session.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::session_inputs_test {

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
        if (!session.callback().postInput({.hold = {1.0, 0.0}}, 0)) ++refused;
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
    session.callback().postInput({.group = 0, .scale = 0.5}, 0);
    session.callback().postInput({.group = 1}, 0); // there is none
    play(session, 2);
    SessionLog log;
    session.readLog(log);
    const auto& inputs = log.runs.at(0).inputs;
    ASSERT_EQ(inputs.size(), 2u);
    EXPECT_EQ(std::get<SpawnAction>(inputs[0].action).body.velocityMetresPerSecond, (Vector{2.0, -1.0}));
    EXPECT_EQ(std::get<ImpulseAction>(inputs[1].action).impulseNewtonSeconds, (Vector{3.0, 4.0}));
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
    EXPECT_EQ(session.submit({Stop{}}).error, "") << "at once";
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
    EXPECT_FALSE(session.addClip(clip("long", 1'400'000))) << "24 times as many at 192 kHz";
    EXPECT_EQ(session.addClip(clip("short", 1'400)), 0);
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
        ASSERT_LE(session.status().minMarginFrames, margin);
        margin = session.status().minMarginFrames;
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
    auto setup = emptyBoxSetup(0.02);
    setup.direct = Direct::inputs; // a stop acts on a time that is past in the session
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
    ScheduledEvents waiting;
    for (const std::int64_t timeNs : {20, 10, 30}) EXPECT_TRUE(waiting.add(at(timeNs)));
    waiting.cancelFrom(20);
    EXPECT_EQ(waiting.size(), 1u) << "that of 20 ns has gone as well";
    EXPECT_FALSE(waiting.add(std::vector<CollisionEvent>(ScheduledEvents::maxEvents)));
    EXPECT_EQ(waiting.size(), 1u) << "nothing of what found no room was kept";
}

// A session that is prepared again is like a new one, whatever was pending; one that continues at another
// rate or latency loses nothing.

CollisionEvent knock() {
    return {.frequencyHz = 205, .decayPerSecond = 30, .amplitude = 0.5, .x = 3.2, .y = 1.8};
}

SessionSetup setupWithNotes() {
    auto setup = shakeTheBoxSetup(0.02);
    setup.groups = {{SpawnAction{
        {"note", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 0, true}}, {3.0, 2.0}}, {}}}};
    return setup;
}

void renderBlock(Session& session, Interleaved& signal) {
    static Block out;
    session.render(out.at.data(), block, RenderMode::realtime);
    append(signal, out.at.data(), block);
    drain(session);
}

/// Leaves a session with every kind of input that has not acted yet, and with a tight margin.
void leaveInTheMiddle(Session& session) {
    session.prepare(rate, block);
    Interleaved signal;
    for (int i = 0; i < 100; ++i) {
        if (i == 10) session.callback().postInput({.group = 0}, 0);
        if (i % 2 == 0) session.advance();
        renderBlock(session, signal);
    }
    for (int i = 0; i < 50; ++i) renderBlock(session, signal); // without a driver: the world waits
    session.lengthenLatency(block);
    session.advance();
    EXPECT_GT(session.world().stalledNs(), 0);
    const std::int64_t now = session.timeline().presentNs();
    const std::array strikes{knock()};
    EXPECT_TRUE(session.submit({Strikes{strikes, true}, now}));
    EXPECT_TRUE(session.submit({Stop{}, now + 300'000'000}));
    EXPECT_TRUE(session.submit({Strikes{strikes, true}, now + 400'000'000}));
    PhantomPanner other = session.panner();
    other = {other.layout(), PanningLaw::energy, 1.3, other.fieldWidthMetres(), other.fieldHeightMetres()};
    EXPECT_TRUE(session.submit({RenderControl{0, Kind::panner, 0, 0.0f, &other}}));
    EXPECT_TRUE(session.submit({RenderControl{0, Kind::gain, 2, 0.0f, {}}}));
    EXPECT_TRUE(session.callback().strike(knock(), 0));
    EXPECT_TRUE(session.callback().control({0, Kind::mute, 1, 1.0f, {}}, 0));
    EXPECT_TRUE(session.callback().postInput({.group = 0}, 0));
    session.world().setSlowness(3);
    session.world().stepOnce();
}

struct Played {
    Interleaved signal;
    SavedSession saved;
    std::int64_t sceneNs = 0, stalledNs = 0, minMarginFrames = 0;
};

Played playTwoSeconds(Session& session, const SessionSetup& setup) {
    session.prepare(rate, block);
    Played played;
    for (int i = 0; i < 200; ++i) {
        session.advance();
        if (i == 50) EXPECT_TRUE(session.callback().postInput({.group = 0}, 0));
        if (i == 100) EXPECT_TRUE(session.submit({RenderControl{0, Kind::mute, 3, 1.0f, {}}}));
        if (i == 150) session.world().setSlowness(0);
        renderBlock(session, played.signal);
    }
    played.saved = {setup.run(), session.panner(), hostChannels, true, setup.ceilings, 2'000'000'000, {}, {}};
    session.readLog(played.saved.log);
    played.sceneNs = session.world().sceneNs();
    played.stalledNs = session.world().stalledNs();
    played.minMarginFrames = session.status().minMarginFrames;
    return played;
}

TEST(SessionStart, PreparedAgainASessionPlaysAsANewOne) {
    const auto setup = setupWithNotes();
    Session fresh{setup}, used{setup};
    leaveInTheMiddle(used);
    const Played expected = playTwoSeconds(fresh, setup), again = playTwoSeconds(used, setup);
    EXPECT_TRUE(again.signal == expected.signal);
    EXPECT_EQ(sessionJson(again.saved), sessionJson(expected.saved)) << "its log has nothing from before";
    EXPECT_EQ(again.sceneNs, expected.sceneNs);
    EXPECT_EQ(again.stalledNs, 0);
    EXPECT_EQ(used.timeline().latencyGrowthFrames(), 0);
    EXPECT_EQ(again.minMarginFrames, expected.minMarginFrames);
}

// A held level leaves room for what still sounds; of a run that is over nothing does.
TEST(SessionStart, AWorldStartedAgainHasTheSameHitsByEveryRenderingMethod) {
    const auto setup = shakeTheBoxSetup(0.02);
    const auto scene = std::make_shared<const Scene>(setup.scene);
    for (const char* method : {"AV-FV-DRV", "AF-FV-DRV", "AF-FV-DRF", "AF-FF-DRF"})
        for (const bool holdsLevel : {false, true}) {
            EventShaping shaping;
            ASSERT_TRUE(parseRenderingMethod(method, shaping.method));
            shaping.method.holdsLevel = holdsLevel;
            SessionWorld world{setup.run(), shaping};
            const auto hits = [&] {
                std::vector<CollisionEvent> events;
                for (int step = 0; step < 200; ++step) world.step(events);
                return events;
            };
            world.start(0, scene, setup.seed);
            const auto first = hits();
            ASSERT_FALSE(first.empty());
            world.reset();
            EXPECT_TRUE(hits() == first) << method << (holdsLevel ? " held" : " of each hit");
        }
}

TEST(SessionStart, AClipStaysKeptAndIsInTheNextLog) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    const std::array clip{ContactRecording{0.0, rate, {0.1f, 0.2f}, {.path = "a.wav", .hash = "00"}}};
    ASSERT_EQ(session.addClip(clip), 0);
    session.prepare(rate, block);
    SessionLog log;
    session.readLog(log);
    ASSERT_EQ(log.clips.size(), 1u);
    EXPECT_EQ(log.clips[0].file.path, "a.wav");
    EXPECT_EQ(session.addClip(clip), 0) << "the same number";
}

TEST(SessionStart, AnotherRatePlaysTheSameRecordings) {
    auto setup = emptyBoxSetup(0.02);
    std::vector<float> hum(static_cast<std::size_t>(rate));
    for (std::size_t n = 0; n < hum.size(); ++n)
        hum[n] = 0.3f * std::sin(2.0f * std::numbers::pi_v<float> * 100.0f * static_cast<float>(n) / rate);
    setup.recordings = {{205.0, rate, hum}};
    Session session{setup};
    session.prepare(rate, block);
    session.advance();
    session.resume(2 * rate, block);
    const std::array strikes{knock()};
    ASSERT_TRUE(session.submit({Strikes{strikes}}));
    Interleaved signal;
    for (int i = 0; i < 120; ++i) { // 0.6 s
        session.advance();
        renderBlock(session, signal);
    }
    const auto late = std::span{signal}.last(static_cast<std::size_t>(10 * block * hostChannels));
    EXPECT_GT(std::ranges::max(late), 0.01f) << "a mode would have decayed";
}

TEST(SessionStart, AShorterLatencyMakesNoStallOfALagThatWasAllowed) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, 8192);
    session.advance();
    Block out;
    session.render(out.at.data(), 8192, RenderMode::realtime);
    session.resume(rate, 64);
    session.advance();
    EXPECT_EQ(session.world().stalledNs(), 0);
}

TEST(SessionStart, AGrownLatencyIsGivenBackAndNoSampleIsLost) {
    auto setup = shakeTheBoxSetup(0.05);
    setup.contactSound.emplace();
    setup.marks = MarkedOnsets::all;
    const auto play = [&](bool grows) {
        Session session{setup};
        session.prepare(rate, block);
        const std::int64_t latency = session.timeline().outputLatencyFrames();
        std::vector<float> samples(static_cast<std::size_t>(session.rendered().count() * block));
        std::vector<float*> out;
        for (int j = 0; j < session.rendered().count(); ++j) out.push_back(samples.data() + j * block);
        std::vector<float> signal;
        for (int i = 0; i < 400; ++i) {
            session.advance();
            if (grows && i == 200) {
                session.lengthenLatency(block);
                EXPECT_EQ(session.timeline().outputLatencyFrames(), latency + block);
                session.advance();
            }
            if (grows && i == 300)
                session.shortenLatency(out.data(), block);
            else
                session.render(out.data(), block, RenderMode::realtime);
            signal.insert(signal.end(), samples.begin(), samples.end());
            drain(session);
        }
        EXPECT_EQ(session.timeline().outputLatencyFrames(), latency);
        EXPECT_EQ(session.timeline().latencyGrowthFrames(), 0);
        return signal;
    };
    EXPECT_TRUE(play(true) == play(false)) << "on the actuators, as audio of contacts and as marks";
}

} // namespace physvib::session_inputs_test
