// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as a start and a stop, and that takes of a loop are the same.
#include "PluginTesting.h"

namespace physvib {
namespace {

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
}

TEST(Transport, AHostWithoutOnePlays) {
    Transport t;
    EXPECT_EQ(t.follow({}, {}, 64), Change::started);
    EXPECT_EQ(t.follow({}, {}, 64), Change::none);
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

PluginState restarting() {
    PluginState s = shakenBox();
    s.transport = TransportMode::restartOnPlay;
    return s;
}

/// False if the machine was too busy to be live.
bool takesAreEqual(TestHost& host, bool offline, int takes, std::int64_t loopFrames) {
    EXPECT_TRUE(host.plugin->apply(restarting()));
    host.prepare(44100, 441, offline);
    host.playHead.isThere = true;
    Samples signal;
    host.play(44100 / 2 / 441 * 441, signal);
    EXPECT_EQ(peakOf(signal), 0.0f) << "silent while the transport stands";
    signal.clear();
    host.playHead.isPlaying = true;
    host.plugin->takes().drainLog();
    std::vector<TakeEvent> log;
    for (int k = 0; k < takes; ++k) {
        host.playHead.frame = 1000;
        for (std::int64_t done = 0; done < loopFrames; done += 441) {
            host.play(441, signal);
            if (!offline) std::this_thread::sleep_for(std::chrono::milliseconds{10});
        }
        for (auto& e : host.plugin->takes().drainLog()) log.push_back(e);
    }
    host.plugin->releaseResources();
    for (auto& e : host.plugin->takes().drainLog()) log.push_back(e);
    const auto status = host.plugin->takes().status();
    if (!offline && (status.late > 0 || status.slippedNs > 0 || status.delayedBlocks > 0)) return false;
    EXPECT_EQ(status.take, takes);
    EXPECT_EQ(status.delayedBlocks, 0u);

    std::vector<std::vector<CollisionEvent>> events(static_cast<std::size_t>(takes));
    // what is played while a take fades may differ
    const std::int64_t owedNs = loopFrames * 1'000'000'000 / 44100;
    for (const auto& e : log)
        if (e.played.event.timeNs < owedNs)
            events[static_cast<std::size_t>(e.take - 1)].push_back(e.played.event);
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
    return true;
}

TEST(Transport, TwentyTakesOfALoopHaveEqualEventsAndSamples) {
    TestHost host;
    takesAreEqual(host, true, 21, 44100);
}

TEST(Transport, LiveTakesOfALoopAreEqualToo) {
    TestHost host;
    for (int attempt = 0; attempt < 5; ++attempt)
        if (takesAreEqual(host, false, 4, 22050)) return;
    GTEST_SKIP() << "this machine is too busy to be live";
}

TEST(Transport, FreeRunningScenesIgnoreItButForAStop) {
    TestHost host;
    host.playHead.isThere = true;
    host.prepare(48000, 480);
    Samples standing;
    host.play(5 * 48000, standing);
    EXPECT_GT(peakOf(standing), 0.01f);
    host.playHead.isPlaying = true;
    host.prepare(48000, 480);
    Samples playing;
    host.play(5 * 48000, playing);
    EXPECT_TRUE(standing == playing);
    EXPECT_EQ(host.plugin->takes().status().take, 1);
}

} // namespace
} // namespace physvib
