// SPDX-License-Identifier: MIT
// A session that is prepared again is like a new one, whatever was pending; one that continues at another
// rate or latency loses nothing.
#include "FakeHost.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/Session.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

using namespace test;
constexpr int rate = hostRate, block = 480;
using Kind = RenderControl::Kind;

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
        if (i == 10) session.callback().perform({.group = 0}, 0);
        if (i % 2 == 0) session.advance();
        renderBlock(session, signal);
    }
    for (int i = 0; i < 50; ++i) renderBlock(session, signal); // without a driver: the world waits
    session.wait(block);
    session.advance();
    EXPECT_GT(session.world().slippedNs(), 0);
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
    EXPECT_TRUE(session.callback().perform({.group = 0}, 0));
    session.world().setSlowness(3);
    session.world().stepOnce();
}

struct Played {
    Interleaved signal;
    SavedSession saved;
    std::int64_t sceneNs = 0, slippedNs = 0, leastMarginFrames = 0;
};

Played playTwoSeconds(Session& session, const SessionSetup& setup) {
    session.prepare(rate, block);
    Played played;
    for (int i = 0; i < 200; ++i) {
        session.advance();
        if (i == 50) EXPECT_TRUE(session.callback().perform({.group = 0}, 0));
        if (i == 100) EXPECT_TRUE(session.submit({RenderControl{0, Kind::mute, 3, 1.0f, {}}}));
        if (i == 150) session.world().setSlowness(0);
        renderBlock(session, played.signal);
    }
    played.saved = {setup.run(), session.panner(), hostChannels, true, setup.ceilings, 2'000'000'000, {}, {}};
    session.readLog(played.saved.log);
    played.sceneNs = session.world().sceneNs();
    played.slippedNs = session.world().slippedNs();
    played.leastMarginFrames = session.status().leastMarginFrames;
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
    EXPECT_EQ(again.slippedNs, 0);
    EXPECT_EQ(used.timeline().framesGrown(), 0);
    EXPECT_EQ(again.leastMarginFrames, expected.leastMarginFrames);
}

TEST(SessionStart, AClipStaysKeptAndIsInTheNextLog) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, block);
    const std::array clip{ContactRecording{0.0, rate, {0.1f, 0.2f}, {.path = "a.wav", .hash = "00"}}};
    ASSERT_EQ(session.keepClip(clip), 0);
    session.prepare(rate, block);
    SessionLog log;
    session.readLog(log);
    ASSERT_EQ(log.clips.size(), 1u);
    EXPECT_EQ(log.clips[0].file.path, "a.wav");
    EXPECT_EQ(session.keepClip(clip), 0) << "the same number";
}

TEST(SessionStart, AnotherRatePlaysTheSameRecordings) {
    auto setup = shakeTheBoxSetup(0.02);
    setup.scene.bodies.clear();
    setup.scene.joints.clear();
    setup.scene.script.clear();
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
    EXPECT_EQ(session.world().slippedNs(), 0);
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
                session.wait(block);
                EXPECT_EQ(session.timeline().outputLatencyFrames(), latency + block);
                session.advance();
            }
            if (grows && i == 300)
                session.wait(out.data(), block);
            else
                session.render(out.data(), block, RenderMode::realtime);
            signal.insert(signal.end(), samples.begin(), samples.end());
            drain(session);
        }
        EXPECT_EQ(session.timeline().outputLatencyFrames(), latency);
        EXPECT_EQ(session.timeline().framesGrown(), 0);
        return signal;
    };
    EXPECT_TRUE(play(true) == play(false)) << "on the actuators, as audio of contacts and as marks";
}

} // namespace
} // namespace physvib
