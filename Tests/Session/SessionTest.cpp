// SPDX-License-Identifier: MIT
// Session: live is the rendered file, L later, to the bit; and nothing is lost when hosts and timers
// misbehave.
#include "Live/Session/Session.h"
#include "FakeHost.h"
#include "Scene/EventsCsv.h"
#include "Scene/World/BodyLists.h"
#include <future>
#include <gtest/gtest.h>

namespace physvib::session_test {

using namespace test;
constexpr int rate = hostRate, channels = hostChannels;

/// What a render of the scene gives, L later.
Interleaved rendered(const SessionSetup& s, std::int64_t delayFrames, std::int64_t frames) {
    const auto made = simulateScene(s.scene, {s.seed, s.stepsPerSecond}, frames * 1'000'000'000 / rate);
    Interleaved signal(static_cast<std::size_t>(delayFrames * channels), 0.0f);
    renderOffline(made.events, {{rate, channels, s.panner, s.limiterEnabled}, frames - delayFrames, 256},
                  [&](const float* const* block, int n) {
                      append(signal, block, n);
                      return true;
                  });
    return signal;
}

TEST(Session, LiveIsTheRenderedFileLLaterToTheBit) {
    const auto s = shakeTheBoxSetup(0.05);
    Session session{s};
    std::vector<CollisionEvent> played;
    const auto signal = playLive(session, 20 * rate, 2048, 0.05, 1, played);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_EQ(session.status().render.unsent, 0u);
    EXPECT_GE(session.status().minMarginFrames, 0);
    EXPECT_LT(session.status().minMarginFrames, session.timeline().outputLatencyFrames());
    EXPECT_GT(played.size(), 300u);
    EXPECT_TRUE(signal == rendered(s, session.timeline().outputLatencyFrames(), 20 * rate));
}

/// Ten balls slide at 1 m/s each over a floor with a grain every millimetre.
SessionSetup setupOfSlides() {
    auto s = shakeTheBoxSetup(0.05);
    s.scene = {};
    s.scene.name = "slides";
    s.scene.fieldWidthMetres = 20.0;
    s.scene.fieldHeightMetres = 4.0;
    s.scene.gravityMetresPerSecond2 = {0.0, -9.8};
    s.scene.normalisation = {0.02, 1.0};
    Material stone{"stone", 10.0, 0.0, 0.0, 200.0, 60.0};
    stone.grainMetres = 0.001;
    s.scene.materials = {stone, {"glass", 10.0, 0.0, 0.0, 480.0, 60.0}};
    s.scene.bodies = {
        {"floor", BodyType::staticBody, {{BoxShape{20.0, 1.0}, {}, 0.0, 0, true}}, {10.0, 0.5}}};
    s.scene.bodies[0].massKg = 10.0;
    for (int i = 0; i < 10; ++i) {
        const FixtureDescription disc{CircleShape{0.2}, {}, 0.0, 1};
        s.scene.bodies.push_back(
            {"ball" + std::to_string(i), BodyType::dynamicBody, {disc}, {0.5 + i, 1.2 + 0.01}});
        s.scene.bodies.back().velocityMetresPerSecond = {1.0, 0.0};
    }
    s.panner = {s.panner.layout(), PanningLaw::linear, 1, 20.0, 4.0};
    return s;
}

TEST(Session, TenThousandGrainsASecondAreTheRenderedFileToo) {
    const auto s = setupOfSlides();
    Session session{s};
    std::vector<CollisionEvent> played;
    const auto signal = playLive(session, 4 * rate, 1024, 0.05, 3, played);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_EQ(session.world().drops(), 0u);
    EXPECT_GT(played.size(), 36'000u);
    EXPECT_TRUE(signal == rendered(s, session.timeline().outputLatencyFrames(), 4 * rate));
    const auto made = simulateScene(s.scene, {s.seed, s.stepsPerSecond}, 4'000'000'000).events;
    const auto list = readEventsCsv(eventsCsv(made, {}, {}, SoundNames{s.scene.materials}), "list");
    ASSERT_EQ(list.error, "");
    EXPECT_TRUE(list.value.events == made);
}

TEST(Session, HitsThatAreLostAreCountedOverAllRunsOfItsScene) {
    auto s = setupOfSlides();
    BodyDescription ball = s.scene.bodies[1];
    s.scene.bodies.resize(1);
    s.scene.bodies[0].fixtures[0].shape = BoxShape{95.0, 1.0};
    ball.fixtures[0].shape = CircleShape{0.03};
    ball.velocityMetresPerSecond = {0.0, -1.0};
    for (int i = 0; i < 1100; ++i) { // more than a step has room for
        ball.name = "ball " + std::to_string(i);
        ball.positionMetres = {-35.0 + 0.08 * i, 1.05};
        s.scene.bodies.push_back(ball);
    }
    Session session{s};
    session.prepare(rate, 4800);
    Block block;
    std::uint64_t once = 0;
    for (std::uint64_t run = 1; run <= 3; ++run) {
        session.render(block.at.data(), 4800, RenderMode::offline);
        if (run == 1) once = session.world().drops();
        EXPECT_EQ(session.world().drops(), run * once);
        session.world().restart();
    }
    EXPECT_GT(once, 0U);
    session.prepare(rate, 4800);
    EXPECT_EQ(session.world().drops(), 0U) << "a session that begins anew";
}

TEST(Session, ADriverThatShallEndIsHeardAfterEachStep) {
    const auto s = shakeTheBoxSetup(0.5);
    Session session{s};
    session.prepare(rate, 4800);
    session.advance();
    Block block;
    for (int i = 0; i < 4; ++i) session.render(block.at.data(), 4800, RenderMode::realtime);
    EXPECT_EQ(session.advance([](std::int64_t) { return false; }), 1);
    EXPECT_EQ(session.advance(), 39) << "the rest, if it goes on after all";
}

/// Keeps what it is given.
struct Keeper final : Sink {
    explicit Keeper(double latencySeconds)
        : latencySeconds_{latencySeconds} {}
    double latencySeconds() const noexcept override { return latencySeconds_; }
    void onCollision(const CollisionEvent& event) noexcept override { events.push_back(event); }
    void onControl(const RenderControl& control) noexcept override { controls.push_back(control); }
    std::vector<CollisionEvent> events;
    std::vector<RenderControl> controls;

private:
    const double latencySeconds_;
};

TEST(Session, ASinkBesideItGetsTheSameEventsAndLCoversIt) {
    const auto s = shakeTheBoxSetup(0.02);
    Session alone{s};
    alone.prepare(rate, 512);
    Keeper sink{0.030}, sooner{0.010};
    Session session{s};
    session.sinks().attach(sink);
    session.sinks().attach(sooner);
    std::vector<CollisionEvent> played;
    const auto signal = playLive(session, 5 * rate, 512, 0.02, 9, played);
    EXPECT_EQ(session.timeline().outputLatencyFrames() - alone.timeline().outputLatencyFrames(),
              0.030 * rate - HapticRenderer::latencyFramesAt(rate));
    EXPECT_TRUE(signal == rendered(s, session.timeline().outputLatencyFrames(), 5 * rate));
    auto& told = sink.events;
    EXPECT_TRUE(sooner.events == told);
    ASSERT_GT(played.size(), 50u);
    ASSERT_GE(told.size(), played.size()) << "those of the last L are not played yet";
    told.resize(played.size());
    EXPECT_TRUE(told == played);
    const auto at =
        session.submit({RenderControl{.kind = RenderControl::Kind::mute, .channel = 2, .value = 1.0f}}).value;
    ASSERT_EQ(sink.controls.size(), 1u);
    EXPECT_EQ(sink.controls[0].timeNs, at);
    EXPECT_EQ(sink.controls[0].channel, 2);
    session.sinks().detach(sink);
    session.submit({RenderControl{.kind = RenderControl::Kind::mute, .channel = 2, .value = 0.0f}});
    EXPECT_EQ(sink.controls.size(), 1u);
    EXPECT_EQ(sooner.controls.size(), 2u);
}

TEST(Session, AThousandStepsPerSecondAndSmallBlocksStayBelowSixMilliseconds) {
    const auto s = shakeTheBoxSetup(driverThreadGapSeconds, 1000);
    Session session{s};
    session.prepare(rate, 64);
    EXPECT_LE(static_cast<double>(session.timeline().outputLatencyFrames()) / rate, 0.006);
    std::vector<CollisionEvent> played;
    const auto signal = playLive(session, 5 * rate, 40, driverThreadGapSeconds, 2, played);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_TRUE(signal == rendered(s, session.timeline().outputLatencyFrames(), 5 * rate));
}

TEST(Session, ADriverThatIsSlowerThanPromisedMakesTheWorldWaitAndNoEventLate) {
    Session session{shakeTheBoxSetup(0.01)};
    std::vector<CollisionEvent> played;
    playLive(session, 20 * rate, 64, 0.05, 3, played);
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_GT(session.world().stalledNs(), 1'000'000'000);
    EXPECT_GT(played.size(), 100u);
}

TEST(Session, AHostThatFlipsBetweenLiveAndOfflineLosesAndRepeatsNoEvent) {
    // this host is a thousand times faster than time; no stall is meant here
    const auto s = shakeTheBoxSetup(0.6);
    Session session{s};
    session.prepare(rate, 8192);
    std::atomic<bool> stop{false};
    std::atomic<int> ticks{0};
    std::thread driver{[&] {
        while (!stop) {
            session.advance();
            ++ticks;
            std::this_thread::sleep_for(std::chrono::microseconds{200});
        }
    }};
    test::Random random{4};
    Block block;
    std::vector<CollisionEvent> played;
    std::int64_t done = 0, atLastTick = 0;
    RenderMode mode = RenderMode::realtime;
    for (int left = 0; done < 60 * rate; --left) {
        if (left <= 0) {
            left = 1 + random.below(50);
            mode = mode == RenderMode::realtime ? RenderMode::offline : RenderMode::realtime;
        }
        const int size = 1 + random.below(mode == RenderMode::offline ? 8192 : 512);
        if (done - atLastTick > rate / 4) {
            for (const int before = ticks; ticks < before + 2;) std::this_thread::yield();
            atLastTick = done;
        }
        session.render(block.at.data(), size, mode);
        done += size;
        for (const auto& e : drain(session)) played.push_back(e);
    }
    stop = true;
    driver.join();
    session.render(block.at.data(), 8192, RenderMode::offline); // whatever is still under way
    for (const auto& e : drain(session)) played.push_back(e);
    ASSERT_EQ(session.world().stalledNs(), 0);
    std::stable_sort(played.begin(), played.end(),
                     [](const auto& a, const auto& b) { return a.timeNs < b.timeNs; });
    const auto made = simulateScene(s.scene, {s.seed, s.stepsPerSecond}, played.back().timeNs + 1);
    ASSERT_EQ(played.size(), made.events.size());
    EXPECT_TRUE(played == made.events);
}

TEST(Session, ABlockThatStepsTheWorldItselfIsNoStallToADriverThatComesFirst) {
    Session session{shakeTheBoxSetup(0.05)};
    session.prepare(rate, 8192);
    session.advance();
    Block block, ahead;
    for (int i = 0; i < 20; ++i) {
        for (int n = 0; n < 4; ++n)
            session.render(block.at.data(), 2640, RenderMode::realtime); // 220 of 230 ms
        std::thread host;
        session.advance([&](std::int64_t) {
            const auto before = session.timeline().framesRendered();
            host = std::thread{[&] { session.render(ahead.at.data(), 8192, RenderMode::offline); }};
            while (session.timeline().framesRendered() == before) std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::milliseconds{2}); // it waits for the world
            return false;
        });
        session.advance();
        host.join();
        ASSERT_EQ(session.world().stalledNs(), 0) << i;
    }
}

TEST(Session, AnotherRateAndBlockLoseNoEventAndNoSound) {
    const auto s = shakeTheBoxSetup(0.02);
    Session session{s};
    Block block;
    std::vector<CollisionEvent> played;
    float loudest = 0;
    session.prepare(44100, 32);
    for (const auto& [newRate, size] : {std::pair{44100, 32}, {96000, 2048}, {48000, 64}, {192000, 512}}) {
        session.resume(newRate, size);
        for (int done = 0; done < 5 * newRate; done += size) {
            session.advance();
            session.render(block.at.data(), size, RenderMode::realtime);
            for (const auto& e : drain(session)) played.push_back(e);
            for (int n = 0; n < size; ++n) loudest = std::max(loudest, std::abs(block.at[0][n]));
        }
    }
    EXPECT_LE(loudest, 1.0f);
    EXPECT_EQ(session.status().render.rejected, 0u);
    const auto made = simulateScene(s.scene, {s.seed, s.stepsPerSecond}, played.back().timeNs + 1);
    EXPECT_TRUE(played == made.events);
}

TEST(Session, ControlsThatComeWithAChangeOfRateNeverGoBackInTime) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(44100, 64);
    session.advance();
    std::atomic<bool> stop{false};
    std::vector<std::int64_t> times;
    std::thread hand{[&] {
        while (!stop)
            if (const auto time =
                    session.submit({RenderControl{.kind = RenderControl::Kind::gain, .value = 0.5f}});
                time)
                times.push_back(time.value);
            else
                std::this_thread::yield();
    }};
    Block block;
    for (int i = 0; i < 1000; ++i) {
        session.resume(i % 2 == 0 ? 192000 : 8000, 64);
        for (int k = 0; k < 20; ++k) session.render(block.at.data(), 64, RenderMode::realtime);
        session.advance();
        drain(session);
    }
    stop = true;
    hand.join();
    ASSERT_GT(times.size(), 300u);
    EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST(Session, ARestartThatWaitsKeepsItsTimeAtAnotherRate) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(48000, 480);
    session.advance();
    Block block;
    for (int i = 0; i < 100; ++i) {
        session.render(block.at.data(), 480, RenderMode::realtime);
        session.advance();
    }
    session.world().restart(240); // at 1.005 s
    session.resume(96000, 960);
    session.advance();
    SessionLog log;
    session.readLog(log);
    ASSERT_EQ(log.runs.size(), 2u);
    EXPECT_EQ(log.runs[1].startNs, 1'005'000'000);
}

// As a host with automation and notes, and nobody who reads a log.
TEST(Session, HoldsNoMoreBodiesAndInputsTheLongerItPlays) {
    auto setup = shakeTheBoxSetup(0.02);
    const BodyDescription note{
        "note", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 0, true}}, {3.0, 2.0}};
    setup.groups = {{SpawnAction{note, {}}}};
    for (const auto use : {LogUse::none, LogUse::stream}) {
        setup.log = use;
        Session session{setup};
        session.prepare(rate, 480);
        Block block;
        SessionLog log;
        std::size_t mostBodies = 0, mostInputs = 0, notes = 0;
        for (int i = 0; i < 3000; ++i) { // half a minute
            session.callback().postInput({.hold = {1.0, 0.001 * (i % 500)}}, i % 480);
            if (i % 7 == 0 && session.callback().postInput({.group = 0}, 0)) ++notes;
            session.render(block.at.data(), 480, RenderMode::offline);
            drain(session);
            if (i % 100 == 0) session.readLog(log);
            const auto size = session.world().size();
            mostBodies = std::max(mostBodies, size.bodies);
            mostInputs = std::max(mostInputs, size.inputs);
        }
        ASSERT_GT(notes, 400u);
        EXPECT_LE(mostBodies, setup.scene.bodies.size() + 64 + 8)
            << "the newest notes, and those of the last half second";
        EXPECT_LE(mostInputs, use == LogUse::none ? 8u : 140u);
        session.readLog(log);
        EXPECT_EQ(log.runs.size(), use == LogUse::none ? 0u : 1u);
        if (use == LogUse::stream) EXPECT_EQ(log.runs[0].inputs.size(), 3000u + 2 * notes - 64);
    }
}

TEST(Session, AfterAStallTheWorldGoesOnWithoutASpiral) {
    Session session{shakeTheBoxSetup(0.02)};
    session.prepare(rate, 480);
    Block block;
    // time has not begun
    for (int i = 0; i < 100; ++i) session.render(block.at.data(), 480, RenderMode::realtime);
    session.advance();
    // 5 s without a driver
    for (int i = 0; i < 500; ++i) session.render(block.at.data(), 480, RenderMode::realtime);
    EXPECT_LE(session.advance(), 4);
    EXPECT_NEAR(static_cast<double>(session.world().stalledNs()) * 1e-9, 4.97, 0.001);
    session.render(block.at.data(), 480, RenderMode::realtime);
    EXPECT_LE(session.advance(), 2) << "caught up";
    for (int i = 0; i < 500; ++i) {
        session.render(block.at.data(), 480, RenderMode::realtime);
        session.advance();
    }
    EXPECT_EQ(session.status().render.late, 0u);
    EXPECT_EQ(session.status().render.rejected, 0u);
}

TEST(Session, StrikesOfTheRenderCallAreFeltLLaterAtTheirFrame) {
    auto setup = emptyBoxSetup(0.02);
    setup.limiterEnabled = false;
    for (const auto mode : {RenderMode::realtime, RenderMode::offline}) {
        Session session{setup};
        session.prepare(44100, 512);
        session.advance(); // time begins
        Block block;
        Interleaved signal;
        for (int done = 0; done < 44100; done += 512) {
            if (done == 5120)
                session.callback().strike(
                    {.frequencyHz = 11025, .decayPerSecond = 10, .amplitude = 0.5, .y = 3.6}, 77);
            session.render(block.at.data(), 512, mode);
            append(signal, block.at.data(), 512);
        }
        const auto onset = static_cast<std::size_t>(5120 + 77 + session.timeline().outputLatencyFrames());
        // sin 0 at the onset
        for (std::size_t n = 0; n <= onset; ++n) ASSERT_NEAR(signal[n * channels], 0.0f, 1e-3f) << n;
        EXPECT_NEAR(signal[(onset + 1) * channels], 0.5f, 1e-3f); // a quarter period later
        const auto played = drain(session);
        ASSERT_EQ(played.size(), 1u);
        EXPECT_EQ(FrameClock{44100}.at(played[0].timeNs).frame, 5120 + 77);
    }
}

TEST(Session, AControlOfTheRenderCallMutesTheWorldAtItsFrame) {
    const auto setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    session.prepare(rate, 480);
    Block block;
    for (int done = 0; done < 10 * rate; done += 480) {
        if (done == 5 * rate)
            for (int j = 0; j < channels; ++j)
                session.callback().control({.kind = RenderControl::Kind::mute, .channel = j, .value = 1.0f},
                                           0);
        session.render(block.at.data(), 480, RenderMode::offline);
        const std::int64_t silentFrom = 5 * rate + session.timeline().outputLatencyFrames() + rate / 100;
        const bool silent = std::all_of(block.at[0], block.at[0] + 480, [](float x) { return x == 0.0f; });
        if (done >= silentFrom) EXPECT_TRUE(silent) << done;
    }
    EXPECT_EQ(session.status().refused, 0u);
}

TEST(Session, PosesAreThoseOfTheSceneAtTheirTime) {
    const auto setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    session.prepare(rate, 480);
    Block block;
    std::vector<BodyPose> poses;
    for (int i = 0; i < 150; ++i) session.render(block.at.data(), 480, RenderMode::offline);
    const auto time = session.world().readPoses(poses);
    EXPECT_EQ(time, 1'500'000'000);
    const auto expected = posesAt(setup.scene, {setup.seed, setup.stepsPerSecond}, time).bodies;
    ASSERT_EQ(poses.size(), expected.size());
    for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].xMetres, expected[i].xMetres) << i;
}

TEST(Session, AStepThatTakesLongIsNotWaitedForByWhoeverDrawsTheWorld) {
    Session session{shakeTheBoxSetup(0.05)};
    session.prepare(rate, 480);
    Block block;
    std::vector<BodyPose> poses;
    std::vector<std::int64_t> times;
    std::vector<std::future<std::int64_t>> reads; // outlive the steps: they may wait for them
    const auto readInAStep = [&](std::int64_t) {
        reads.push_back(std::async(std::launch::async, [&] { return session.world().readPoses(poses); }));
        if (reads.back().wait_for(std::chrono::seconds{5}) == std::future_status::ready)
            times.push_back(reads.back().get());
        return false;
    };
    session.advance();
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) session.render(block.at.data(), 480, RenderMode::realtime);
        session.advance(readInAStep); // asked after the first of its steps, which is the last then
    }
    ASSERT_EQ(times.size(), 3U) << "it waited";
    EXPECT_EQ(times[0], 0) << "nobody had asked before";
    EXPECT_EQ(times[2], 20'000'000) << "the last whole step";
    EXPECT_EQ(poses.size(), allBodies(*session.world().state().scene).size());
    EXPECT_EQ(session.world().readPoses(poses), 30'000'000) << "between steps they are those of now";
}

} // namespace physvib::session_test
