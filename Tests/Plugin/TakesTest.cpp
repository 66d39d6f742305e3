// SPDX-License-Identifier: GPL-3.0-or-later
// What takes owe each other: nothing is cut, settings travel inside, ended ones return, none is in the way.
#include "PluginTesting.h"
#include "Session/FakeHost.h"
#include "Support/Growth.h"
#include "Support/RendererMemory.h"
#include "Support/SlowFigures.h"
#include <atomic>
#include <cmath>
#include <future>
#include <numeric>

namespace physvib::takes_test {

using namespace test;

PluginState onPlay() {
    auto state = shakenBox();
    state.transport = TransportMode::restartOnPlay;
    state.limiterEnabled = false;
    return state;
}

TEST(Takes, WhatIsOwedIsPlayedHoweverManyJumpsFollow) {
    constexpr int block = 64, before = 300 * block;
    for (const int apart : {2, 3, 10}) { // blocks between jumps; L is 24
        TestHost host{onPlay(), block};
        const int latency = host.plugin->getLatencySamples();
        Samples straight, jumping;
        host.playHead.isThere = host.playHead.isPlaying = true;
        const auto playStruck = [&](Samples& signal) { // shortly before the first jump
            host.play(before - 5 * block, signal);
            append(signal, host.block(block, oneNote(60)));
            host.play(4 * block, signal);
        };
        playStruck(straight);
        host.play(before, straight);
        host.prepare(48000, block);
        host.playHead.frame = 0;
        playStruck(jumping);
        for (int jump = 1; jump < 5; ++jump) {
            host.playHead.frame = 1'000'000 * jump;
            host.play(apart * block, jumping);
        }
        host.play(before, jumping);
        float owed = 0.0f;
        for (std::size_t c = 0; c < straight.size(); ++c)
            for (int n = latency; n < before + latency; ++n) {
                const auto at = static_cast<std::size_t>(n);
                ASSERT_EQ(jumping[c][at], straight[c][at]) << apart << ", frame " << n;
                if (n > before) owed = std::max(owed, std::abs(straight[c][at]));
            }
        EXPECT_GT(owed, 0.01f);
        EXPECT_EQ(host.plugin->runs().status().runNumber, 5);
        EXPECT_EQ(host.plugin->runs().status().delayedBlocks, 0u);
    }
}

// Each take's renderer guards what it plays, and begins anew: what follows every 100 ms adds up behind them.
TEST(Takes, WhatFollowsQuicklyDoesNotAddUpToDirectCurrent) {
    auto state = strikeAt(0, 1);
    state.transport = TransportMode::restartOnPlay;
    auto& slow = state.scene.materials[static_cast<std::size_t>(state.notes[0].material)];
    slow.frequencyHz = slow.decayPerSecond = 1.0;
    for (const int block : {480, 96}) {
        TestHost host{state};
        host.plugin->parameter(Parameter::strikeLevel).setValue(1.0f);
        host.prepare(48000, block);
        host.playHead.isThere = host.playHead.isPlaying = true;
        Samples left;
        for (int jump = 1; jump <= 40; ++jump) {
            append(left, host.block(block, oneNote(60)));
            host.play(4800 - block, left);
            host.playHead.frame = 1'000'000 * jump;
        }
        EXPECT_EQ(host.plugin->runs().status().runNumber, 40);
        EXPECT_GT(peakOf(left), 0.02f);
        for (const auto& channel : left) {
            const auto figures = slowFigures(channel, 48000);
            EXPECT_LE(figures.mean, limits::guardShare);
            EXPECT_LE(figures.rms, limits::guardShare);
        }
    }
}

// What a host plays between one preparation and the next adds up as well, at whichever block and rate.
TEST(Takes, PreparingAnewIsNoWayAroundTheGuard) {
    auto state = strikeAt(0, 1);
    auto& slow = state.scene.materials[static_cast<std::size_t>(state.notes[0].material)];
    slow.frequencyHz = slow.decayPerSecond = 1.0;
    for (const bool isReleased : {false, true}) {
        TestHost host{state};
        host.plugin->parameter(Parameter::strikeLevel).setValue(1.0f);
        std::vector<std::vector<float>> left(4); // at 8 kHz: means
        for (int k = 0; k < 40; ++k) {
            const int rate = k % 2 == 0 ? 48000 : 96000, block = k % 3 == 0 ? 96 : 480;
            if (isReleased) host.plugin->releaseResources();
            host.prepare(rate, block, false);
            auto midi = oneNote(60);
            for (int done = 0; done < rate / 10; done += block, midi.clear()) {
                const auto& out = host.block(block, midi);
                for (int c = 0; c < std::min(out.getNumChannels(), 4); ++c)
                    for (int n = 0; n < block; n += rate / 8000) {
                        const float* const at = out.getReadPointer(c) + n;
                        left[static_cast<std::size_t>(c)].push_back(
                            std::accumulate(at, at + rate / 8000, 0.0f) / static_cast<float>(rate / 8000));
                    }
            }
        }
        EXPECT_GT(peakOf(left), 0.02f);
        SlowFigures worst;
        for (const auto& channel : left) worst.join(slowFigures(channel, 8000));
        EXPECT_LE(worst.mean, limits::guardShare);
        EXPECT_LE(worst.rms, limits::guardShare);
        Samples once, again; // an export begins at rest
        for (Samples* export_ : {&once, &again}) {
            host.prepare(48000, 480);
            host.block(480, oneNote(60));
            host.play(48000, *export_);
        }
        EXPECT_EQ(once, again);
    }
}

TEST(Takes, ATakeIsPlayedByItsOwnSettings) {
    auto two = strikeAt(0, 2), four = strikeAt(0, 4);
    two.notes[0].material = 1;
    const auto frequencyOf = [](const PluginState& s) {
        return s.scene.materials[static_cast<std::size_t>(s.notes[0].material)].frequencyHz;
    };
    ASSERT_NE(frequencyOf(two), frequencyOf(four));
    TestHost host{two, 64};
    std::atomic<bool> isDone{false};
    std::atomic<std::size_t> seen{0};
    std::thread message{[&] { // as many as make eleven, however the processor is shared
        for (int i = 0; i < 60 || (seen < 11 && i < 100'000); ++i) host.plugin->apply(i % 2 ? two : four);
        isDone = true;
    }};
    std::vector<int> channels{0}; // of each take
    while (!isDone) {
        host.block(64, oneNote(60));
        if (host.plugin->runs().status().runNumber == static_cast<int>(channels.size()))
            channels.push_back(host.plugin->runs().session()->channels());
        seen = channels.size();
    }
    message.join();
    EXPECT_GT(channels.size(), 10u);
    host.plugin->releaseResources();
    int others = 0;
    for (const auto& e : host.plugin->runs().drainLog())
        others += e.played.event.frequencyHz !=
                  frequencyOf(channels[static_cast<std::size_t>(e.runNumber)] == 2 ? two : four);
    EXPECT_EQ(others, 0) << "struck by another take's notes";
}

TEST(Takes, ALoopUsesThoseThatHaveEndedAndIsTheSameEachTime) {
    TestHost host{onPlay()};
    Samples signal;
    host.plugin->runs().useManualStepping();
    host.prepare(48000, 480, false);
    host.playHead.isThere = host.playHead.isPlaying = true;
    for (int b = 0; b < 600; ++b) {
        if (b % 30 == 0) host.playHead.frame = 0;
        append(signal, host.block(480));
        for (int t = 0; t < 2; ++t) host.plugin->runs().tick();
    }
    EXPECT_EQ(host.plugin->runs().status().runNumber, 20);
    EXPECT_EQ(host.plugin->runs().status().delayedBlocks, 0u);
    EXPECT_EQ(host.plugin->runs().status().stalledNs, 0);
    EXPECT_EQ(host.plugin->runs().builtRuns(), 2u) << "one to be next, one to be spare";
    for (const auto& c : signal)
        EXPECT_TRUE(std::equal(c.begin() + 3 * 14400, c.end() - 14400, c.begin() + 4 * 14400));
    EXPECT_GT(peakOf(signal), 0.01f);
}

// The next one is made as long as this lasts: until the test lets it, or two seconds have passed.
std::promise<void>* letMake = nullptr;
std::atomic<bool> isMaking{false}, hasWaitedInVain{false};
constexpr std::size_t largeBytes = 100'000; // less than a renderer takes at once

TEST(Takes, WhatPlaysIsSteppedWhileAnotherIsMade) {
    if (!ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    TestHost host{onPlay(), 480, false};
    host.playHead.isThere = host.playHead.isPlaying = true;
    std::promise<void> let;
    letMake = &let;
    isMaking = hasWaitedInVain = false;
    beforeMemory = [](std::size_t bytes) {
        if (bytes <= largeBytes) return true;
        beforeMemory = nullptr;
        auto may = letMake->get_future();
        isMaking = true;
        hasWaitedInVain = may.wait_for(std::chrono::seconds{2}) != std::future_status::ready;
        return true;
    };
    while (!isMaking) {
        host.block(480);
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    std::vector<BodyPose> poses;
    const auto before = host.plugin->runs().readPoses(poses);
    for (int b = 0; b < 4; ++b) host.block(480);
    for (int i = 0; i < 100 && host.plugin->runs().readPoses(poses) == before; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    EXPECT_GT(host.plugin->runs().readPoses(poses), before);
    let.set_value();
    host.plugin->releaseResources();
    EXPECT_FALSE(hasWaitedInVain) << "the world stood still for as long as the other was made";
}

/// The processor time of a tick that owes half a second of the heap's world, released after so much of it.
double tickMicroseconds(double releasedAfter = HUGE_VAL) {
    TestHost host{heap(200)};
    host.plugin->runs().useManualStepping();
    host.prepare(48000, 480, false);
    for (int b = 0; b < 50; ++b) host.block(480);
    clockid_t mine{};
    pthread_getcpuclockid(pthread_self(), &mine);
    const double before = microsecondsOf(mine);
    std::atomic<bool> isOver{false};
    std::jthread other{[&] {
        // Asleep, since the system lets one who wakes run before those who have used up their share.
        while (!isOver && microsecondsOf(mine) - before < releasedAfter)
            std::this_thread::sleep_for(std::chrono::microseconds{50});
        host.plugin->releaseResources();
    }};
    host.plugin->runs().tick();
    const double took = microsecondsOf(mine) - before;
    isOver = true;
    return took;
}

TEST(Takes, ReleaseWaitsForOneStepOfAHeavyWorldNotForAllThatAreOwed) {
    const double whole = tickMicroseconds();
    double least = whole;
    // A release may come late on a busy machine, not always; who does not listen takes the whole each time.
    for (int attempt = 0; attempt < 200 && least > 0.75 * whole; ++attempt)
        least = std::min(least, tickMicroseconds(0.1 * whole));
    EXPECT_LT(least, 0.75 * whole) << "of " << whole << " us";
}

double applyMicroseconds(int discs) {
    TestHost host;
    const PluginState state = heap(discs);
    const double before = microsecondsOf(CLOCK_THREAD_CPUTIME_ID);
    EXPECT_TRUE(host.plugin->apply(state)) << host.plugin->errorText();
    return microsecondsOf(CLOCK_THREAD_CPUTIME_ID) - before;
}

TEST(Takes, AStateOfManyBodiesIsTakenInATimeThatGrowsAsTheyDo) {
    // A busy machine shares its caches, which makes both slower, but not always.
    double few = HUGE_VAL, many = HUGE_VAL;
    for (int attempt = 0; attempt < 3 || (attempt < 20 && !(many < 24.0 * few)); ++attempt)
        few = std::min(few, applyMicroseconds(100)), many = std::min(many, applyMicroseconds(800));
    EXPECT_LT(many, 24.0 * few) << "eight times the bodies; by their square it would be 64 times";
}

TEST(Takes, WithoutMemoryForAnotherTheHostPlaysOnAndItIsSaid) {
    if (!ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    TestHost host{onPlay()};
    beforeMemory = nullptr;
    host.prepare(48000, 480, false);
    beforeMemory = [](std::size_t bytes) { return bytes <= largeBytes; };
    host.playHead.isThere = host.playHead.isPlaying = true;
    for (int b = 0; b < 1000 && host.plugin->errorText().isEmpty(); ++b) {
        host.block(480);
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    beforeMemory = nullptr;
    EXPECT_TRUE(host.plugin->errorText().startsWith("no scene run could be made: "))
        << host.plugin->errorText();
    EXPECT_TRUE(host.plugin->apply(onPlay()));
    EXPECT_EQ(host.plugin->errorText(), "");
    for (int b = 0; b < 10; ++b) host.block(480);
    EXPECT_EQ(host.plugin->runs().status().runNumber, 2);
}

// It has more contacts in its first step than it has taken memory for.
TEST(Takes, AWorldWithoutMemoryStandsStillUntilTheNextTakeAndItIsSaid) {
    if (!ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    for (const std::string_view stepper : {"its thread", "the render call", "a bounce"}) {
        SCOPED_TRACE(stepper);
        auto state = heap(40);
        state.transport = TransportMode::restartOnPlay;
        TestHost host{state};
        auto& runs = host.plugin->runs();
        runs.useManualStepping();
        host.set(Parameter::timing, stepper == "the render call" ? 1.0 : 0.0);
        host.prepare(48000, 480, stepper == "a bounce");
        host.playHead.isThere = host.playHead.isPlaying = true;
        const auto places = [&runs] {
            std::vector<BodyPose> poses;
            runs.readPoses(poses);
            std::vector<double> places;
            for (const auto& pose : poses) places.insert(places.end(), {pose.xMetres, pose.yMetres});
            return places;
        };
        const auto play = [&](bool isStepped) {
            for (int b = 0; b < 40; ++b) {
                host.block(480);
                if (isStepped) runs.tick();
            }
            return places();
        };
        const auto lack = [] {
            beforeMemory = [](std::size_t) {
                beforeMemory = nullptr;
                return false;
            };
        };
        if (stepper != "its thread") lack();
        host.block(480);
        if (stepper == "its thread") lack();
        runs.tick();
        EXPECT_TRUE(beforeMemory == nullptr);
        const auto still = places();
        EXPECT_EQ(play(false), still) << "the render call does not step it either";
        EXPECT_EQ(play(true), still);
        EXPECT_EQ(host.plugin->errorText(), "the world stands still: a step of it failed");
        for (int take = 0; take < 4; ++take) { // of the same memory, too
            host.playHead.frame += 48000;
            EXPECT_NE(play(true), still);
            EXPECT_EQ(host.plugin->errorText(), "") << "another moves";
        }
    }
}

TEST(Takes, ASessionWithoutMemoryForItsRendererIsNoSilentOne) {
    if (!ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    Session session{shakeTheBoxSetup(0.02)};
    beforeMemory = [](std::size_t) { return false; };
    EXPECT_THROW(session.prepare(48000, 480), std::bad_alloc);
    beforeMemory = nullptr;
    session.prepare(48000, 480);
}

} // namespace physvib::takes_test
