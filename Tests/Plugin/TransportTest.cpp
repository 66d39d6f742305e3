// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as a start and a stop, that takes of a loop are the same, and worlds in the tempo of a host.
#include "PluginTesting.h"

namespace physvib::transport_test {

using namespace test;
using Change = Transport::Change;

TEST(Transport, StartsStopsAndJumps) {
    Transport t;
    EXPECT_EQ(t.follow(false, 0, 64), Change::none);
    EXPECT_EQ(t.follow(true, 0, 64), Change::started);
    EXPECT_EQ(t.follow(true, 64, 64), Change::none);
    EXPECT_EQ(t.follow(true, 0, 64), Change::started) << "a loop";
    EXPECT_EQ(t.follow(false, 64, 64), Change::stopped);
    EXPECT_EQ(t.follow(false, 1000, 64), Change::none) << "moved while it stands";
    EXPECT_EQ(t.follow(true, 1000, 64), Change::started);
    constexpr auto first = std::numeric_limits<std::int64_t>::min(), last = -1 - first;
    for (const auto at : {std::int64_t{1064}, first}) t.follow(true, at, 64), t.follow(true, at + 64, 64);
    EXPECT_EQ(t.follow(true, last, 128), Change::started) << "beyond what differences have room for";
}

TEST(Transport, AHostThatTellsChangesOnlyGoesOnAsBefore) {
    Transport t;
    EXPECT_EQ(t.follow(false, 0, 64), Change::none);
    EXPECT_EQ(t.follow({}, {}, 64), Change::none) << "it still stands";
    EXPECT_EQ(t.follow(true, 0, 64), Change::started);
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
    EXPECT_EQ(t.follow(true, 140, 64), Change::none) << "a change of tempo within the block";
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
    EXPECT_EQ(t.follow(true, 420, 64), Change::started) << "a jump, after what was not told";
    EXPECT_EQ(t.follow(false, 484, 64), Change::stopped);
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
}

TEST(Transport, AStartThatIsTheFirstThingToldIsAStart) {
    Transport t;
    EXPECT_EQ(t.follow({}, {}, 64), Change::started) << "perhaps a host without a transport";
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
    EXPECT_EQ(t.follow(true, 0, 64), Change::started);
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
}

/// Starts in ten minutes of blocks at the places that `place(block)` gives.
template <class Place>
int startsIn(int blocks, Place place, int frames = 512) {
    Transport t;
    int starts = 0;
    for (int b = 0; b < blocks; ++b)
        starts += t.follow(true, static_cast<std::int64_t>(place(b)), frames) == Change::started ? 1 : 0;
    return starts;
}
constexpr int tenMinutes = 56'250; // blocks of 512 at 48 kHz

TEST(Transport, ImperfectOnesMakeNoStarts) {
    EXPECT_EQ(startsIn(tenMinutes, [](int b) { return 512.0 * b - (b == 100 ? 1 : 0); }), 1)
        << "a frame backwards";
    for (const double speed : {0.5, 0.9, 0.99, 1.0001, 1.01, 1.5, 2.0})
        EXPECT_EQ(startsIn(tenMinutes, [=](int b) { return speed * 512 * b; }), 1) << speed;
    for (const double speed : {0.5, 1.0, 2.0}) {
        Random random{4};
        EXPECT_EQ(startsIn(tenMinutes, [&](int b) { return speed * 512 * b + random.below(512); }), 1)
            << "jitter of a block, at " << speed;
    }
    // half to one and a half times the speed, and back
    const auto tape = [](int b) { return 512.0 * (b + 100 * std::sin(0.005 * b)); };
    EXPECT_EQ(startsIn(tenMinutes, tape), 1);
}

TEST(Transport, AHandThatScrubsIsOneStartAndAnotherWhenItLetsGo) {
    const auto hand = [](int b) { return b < 100 || b >= 200 ? 512.0 * b : 512.0 * (100 - 5 * (b - 100)); };
    EXPECT_EQ(startsIn(300, hand), 1 + 2);
    const auto shuttle = [](int b) { return b < 100 ? 512.0 * b : 512.0 * 8 * b; };
    EXPECT_EQ(startsIn(1000, shuttle), 1 + 1) << "eight times the speed, for ever";
}

TEST(Transport, ALoopStartsEveryTime) {
    for (const int frames : {64, 512, 4096}) {
        const int length = 10; // blocks
        EXPECT_EQ(startsIn(
                      10 * length, [=](int b) { return static_cast<double>(frames) * (b % length); }, frames),
                  10)
            << frames;
    }
}

TEST(Transport, TwentyTakesOfALoopHaveEqualEventsAndSamples) {
    constexpr int takes = 21;
    constexpr std::int64_t loopFrames = 44100;
    auto state = shakenBox();
    state.transport = TransportMode::restartOnPlay;
    TestHost host{state};
    host.prepare(44100, 441);
    host.playHead.isThere = true;
    EXPECT_EQ(peakOf(host.played(22050)), 0.0f) << "silent while the transport stands";
    Samples signal;
    host.playHead.isPlaying = true;
    host.plugin->runs().drainLog();
    std::vector<RunEvent> log;
    for (int k = 0; k < takes; ++k) {
        host.playHead.frame = 1000;
        host.play(loopFrames, signal);
        for (auto& e : host.plugin->runs().drainLog()) log.push_back(e);
    }
    host.plugin->releaseResources();
    for (auto& e : host.plugin->runs().drainLog()) log.push_back(e);
    const auto status = host.plugin->runs().status();
    EXPECT_EQ(status.runNumber, takes);
    EXPECT_EQ(status.delayedBlocks, 0u);

    std::vector<std::vector<CollisionEvent>> events(static_cast<std::size_t>(takes));
    // what is played while a take fades may differ
    const std::int64_t owedNs = loopFrames * 1'000'000'000 / 44100;
    for (const auto& e : log)
        if (e.played.event.timeNs < owedNs)
            events[static_cast<std::size_t>(e.runNumber - 1)].push_back(e.played.event);
    const std::int64_t latency = host.plugin->getLatencySamples();
    const auto take = [&](int k) {
        Samples part;
        for (const auto& c : signal)
            part.emplace_back(c.begin() + latency + k * loopFrames,
                              c.begin() + latency + (k + 1) * loopFrames);
        return part;
    };
    EXPECT_GT(events[0].size(), 2u);
    for (int k = 1; k + 1 < takes; ++k) {
        EXPECT_TRUE(events[static_cast<std::size_t>(k)] == events[0]) << "take " << k + 1;
        EXPECT_TRUE(take(k) == take(1)) << "take " << k + 1;
    }
}

constexpr double rateHz = 48000;

/// Discs that rain on a floor, one every half second from 0.5 s on: at 120 a minute one on each beat.
PluginState rain() {
    PluginState s = emptyBox();
    s.transport = TransportMode::inTempo;
    s.stepsPerSecond = 1000;
    s.seed = 0;
    auto& scene = s.scene;
    scene.gravityMetresPerSecond2 = {};
    const auto bodyOf = [](std::string name, BodyType type, Shape shape, Vector place) {
        BodyDescription body;
        body.name = std::move(name);
        body.type = type;
        body.fixtures.push_back({std::move(shape), {}, 0.0, 3, true});
        body.positionMetres = place;
        body.massKg = 1.0;
        return body;
    };
    const double width = scene.fieldWidthMetres;
    scene.bodies.push_back(bodyOf("floor", BodyType::staticBody, BoxShape{width, 0.1}, {0.5 * width, 0.05}));
    SpawnAction drop{bodyOf("drop", BodyType::dynamicBody, CircleShape{0.01}, {0.05, 0.12}), {0.04, 0.0}};
    drop.body.velocityMetresPerSecond = {0.0, -2.0};
    scene.script.push_back({0.5, 8, 0.5, drop});
    return s;
}

struct Played {
    Samples samples;
    std::vector<double> seconds; // of the first collision of each drop
    std::uint64_t delayed = 0;   // blocks that waited for a take
};

/// Three seconds of a transport that starts at that beat; `change(host, block)` comes before each block.
Played playedBy(
    const PluginState& state, double perMinute, double quarter = 0.0, bool offline = true, int frames = 480,
    void (*change)(TestHost&, int) = [](TestHost&, int) {}) {
    TestHost host{state};
    host.prepare(rateHz, frames, offline);
    host.playHead.isThere = host.playHead.isPlaying = true;
    host.playHead.perMinute = perMinute;
    host.playHead.quarter = quarter;
    Played played;
    const int blocks = static_cast<int>(3.0 * rateHz) / frames;
    for (int b = 0; b < blocks; ++b) {
        change(host, b);
        host.play(frames, played.samples);
    }
    host.plugin->releaseResources();
    played.delayed = host.plugin->runs().status().delayedBlocks;
    for (const auto& e : host.plugin->runs().drainLog())
        if (const double at = static_cast<double>(e.played.event.timeNs) * 1e-9;
            played.seconds.empty() || at > played.seconds.back() + 0.05)
            played.seconds.push_back(at);
    return played;
}

void expectTimes(const Played& played, const std::vector<double>& seconds) {
    constexpr double falls = 0.005; // 1 cm at 2 m/s
    ASSERT_EQ(played.seconds.size(), seconds.size());
    for (std::size_t i = 0; i < seconds.size(); ++i)
        EXPECT_NEAR(played.seconds[i], seconds[i] + falls, 0.004) << "drop " << i;
}

TEST(Tempo, RainFallsOnTheBeats) {
    expectTimes(playedBy(rain(), 120.0), {0.5, 1.0, 1.5, 2.0, 2.5});
    expectTimes(playedBy(rain(), 180.0), {1 / 3., 2 / 3., 1.0, 4 / 3., 5 / 3., 2.0, 7 / 3., 8 / 3.});
    expectTimes(playedBy(rain(), 60.0), {1.0, 2.0});
    expectTimes(playedBy(rain(), 120.0, 7.5), {0.75, 1.25, 1.75, 2.25, 2.75}); // from the next beat on
}

TEST(Tempo, WithoutOneOrAtTheScenesAllIsAsWithRestartOnPlay) {
    for (const auto& scene : builtInScenes()) {
        PluginState restarting = shakenBox();
        setScene(restarting, scene);
        restarting.transport = TransportMode::restartOnPlay;
        PluginState inTempo = restarting;
        inTempo.transport = TransportMode::inTempo;
        const auto wanted = playedBy(restarting, 0.0);
        EXPECT_TRUE(playedBy(inTempo, 0.0).samples == wanted.samples) << scene.name;
        EXPECT_TRUE(playedBy(inTempo, 120.0, 16.0).samples == wanted.samples) << scene.name;
        for (const double none : {1e-9, 1e9, std::numeric_limits<double>::infinity()})
            EXPECT_TRUE(playedBy(inTempo, none).samples == wanted.samples) << scene.name << " " << none;
        const auto jumps = [](TestHost& host, int block) {
            if (block % 50 == 49) host.playHead.quarter += block % 100 == 49 ? 1e6 : -1e300;
        };
        EXPECT_TRUE(playedBy(inTempo, 120.0, 0.0, true, 480, jumps).samples == wanted.samples) << scene.name;
        EXPECT_FALSE(playedBy(inTempo, 400.0).samples == wanted.samples) << scene.name;
    }
}

TEST(Tempo, AChangeMovesTheDropsThatAreToCome) {
    const auto faster = [](TestHost& host, int block) {
        if (block == 110) host.playHead.perMinute = 240.0; // at 1.1 s, beat 2.2
    };
    expectTimes(playedBy(rain(), 120.0, 0.0, true, 480, faster), {0.5, 1.0, 1.3, 1.55, 1.8, 2.05, 2.3, 2.55});
}

TEST(TempoInRealTime, LiveIsTheBounceWithChangesAStopAndALoop) {
    const auto song = [](TestHost& host, int block) {
        auto& head = host.playHead;
        head.perMinute = block < 60 ? 120.0 : 120.0 + block; // then it rises in each block
        head.isPlaying = block < 130 || block >= 150;
        if (block != 150 && block != 220) return;
        head.frame = 9'600;
        head.quarter = 1.25;
        if (!host.plugin->isNonRealtime()) std::this_thread::sleep_for(std::chrono::milliseconds{300});
    };
    PluginState driven = shakenBox();
    setScene(driven, builtInScenes()[2]); // motors drive
    driven.transport = TransportMode::inTempo;
    for (const auto& state : {rain(), driven}) {
        const auto bounce = playedBy(state, 120.0, 0.0, true, 480, song);
        EXPECT_GT(peakOf(bounce.samples), 0.01f);
        EXPECT_TRUE(playedBy(state, 120.0, 0.0, true, 480, song).samples == bounce.samples);
        auto live = playedBy(state, 120.0, 0.0, false, 480, song);
        for (int again = 0; live.delayed > 0 && again < 5; ++again)
            live = playedBy(state, 120.0, 0.0, false, 480, song);
        if (live.delayed > 0) GTEST_SKIP() << "this machine is too busy to be live";
        EXPECT_TRUE(live.samples == bounce.samples);
    }
}

TEST(Tempo, ATempoThatStaysMakesTheSameOfEveryBlockSize) {
    const auto of = [](int frames) { return playedBy(rain(), 133.0, 2.9, true, frames).seconds; };
    EXPECT_EQ(of(480), of(96));
    EXPECT_EQ(of(480), of(1920));
}

} // namespace physvib::transport_test
