// SPDX-License-Identifier: MIT
// SessionClock: calls that come late, a crystal that drifts, a device that pauses.
#include "Live/Session/OfflineRender.h"
#include "Live/Session/OutputClock.h"
#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#include <vector>

namespace physvib::session_clock_test {

constexpr double ms = 1e6;

/// A device whose calls come at random up to `latestMs` after their time; the worst error of the clock 100 ms
/// ahead.
double worstErrorMs(double drift, double latestMs, double seconds) {
    std::mt19937 random{3};
    SessionClock clock;
    double worst = 0;
    for (double t = 0; t < seconds; t += 512 / 48000.0) { // session time
        const double late = latestMs * ms * (random() / 4294967296.0);
        const auto steadyOf = [&](double s) { return 5e9 + s * 1e9 / (1 + drift); };
        clock.add({static_cast<std::int64_t>(t * 1e9), static_cast<std::int64_t>(steadyOf(t) + late)});
        const double felt = t + 0.1;
        if (t > 0.5)
            worst = std::max(
                worst, std::abs(static_cast<double>(clock.steadyAt(static_cast<std::int64_t>(felt * 1e9))) -
                                steadyOf(felt)) /
                           ms);
    }
    return worst;
}

TEST(SessionClock, FollowsACrystalAndOfCallsThatComeLateTheEarliestCounts) {
    EXPECT_LT(worstErrorMs(0, 8, 60), 2.5) << "their mean would be 4 ms off";
    EXPECT_LT(worstErrorMs(300e-6, 0, 60), 0.2);
    EXPECT_LT(worstErrorMs(-300e-6, 0, 60), 0.2);
    EXPECT_LT(worstErrorMs(300e-6, 2, 60), 0.7);
}

TEST(SessionClock, BeginsAnewAfterAPause) {
    SessionClock clock;
    EXPECT_FALSE(clock.isReady());
    clock.add({1000, 2000});
    EXPECT_TRUE(clock.isReady());
    EXPECT_EQ(clock.steadyAt(1500), 2500);
    const std::int64_t pause = 3 * SessionClock::halfWindowNs;
    clock.add({1010, 2010 + pause}); // session time stood still
    EXPECT_EQ(clock.steadyAt(1500), 2500 + pause);
}

TEST(SessionClock, TheSameMomentAgainChangesNothing) {
    SessionClock clock;
    for (int i = 0; i < 5; ++i) clock.add({1000, 2000});
    EXPECT_EQ(clock.steadyAt(0), 1000);
}

// What a device tells whoever follows it.

struct Device final : OutputClock {
    using OutputClock::OutputClock;
    using OutputClock::publish;
};

TEST(OutputClock, EachOfSeveralReadersSeesMomentsWholeAndInTheirOrder) {
    constexpr int moments = 20'000;
    Device device;
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; ++i)
        readers.emplace_back([&device] {
            for (std::int64_t last = 0; last < moments;) {
                const OutputMoment now = device.latestMoment();
                ASSERT_GE(now.sessionNs, last);
                ASSERT_EQ(now.steadyNs, now.sessionNs);
                ASSERT_EQ(now.lagNs, now.sessionNs);
                ASSERT_EQ(now.sampleRateHz, now.sessionNs);
                last = now.sessionNs;
            }
        });
    for (int n = 1; n <= moments; ++n) device.publish({n, n, n, n});
    for (std::thread& reader : readers) reader.join();
}

TEST(OutputClock, IsSilentWhileSomebodyAsksForItOrTheProgramEnds) {
    std::atomic<bool> isEnded{false};
    Device device{&isEnded};
    EXPECT_FALSE(device.isSilent());
    device.silence().request(MuteRequester::osc);
    EXPECT_TRUE(device.isSilent());
    device.setSilent(false);
    EXPECT_FALSE(device.isSilent());
    isEnded = true;
    EXPECT_TRUE(device.isSilent());
}

// What a world is given up for is the processor's time, not that of the day.

TEST(Patience, WaitingIsNoSlowWorld) {
    SimulationTimeLimit patience{0.05};
    std::this_thread::sleep_for(std::chrono::milliseconds{200}); // as on a machine where others work
    EXPECT_TRUE(patience(0));
    EXPECT_EQ(patience.error(), "");
}

TEST(Patience, WorkIsGivenUp) {
    SimulationTimeLimit patience{0.05};
    const double end = threadCpuSeconds() + 0.15;
    while (threadCpuSeconds() < end) {
    }
    EXPECT_TRUE(patience(1'000'000'000)) << "a second was simulated";
    EXPECT_FALSE(patience(10'000'000));
    EXPECT_TRUE(patience.error().starts_with(
        "expected a world that is simulated as fast as it lasts, found 0.01 s of it after 0."))
        << patience.error();
    EXPECT_TRUE(patience.error().ends_with(" s of processor time (--patience waits longer)"))
        << patience.error();
}

TEST(Patience, AnotherThreadsWorkIsNotCounted) {
    SimulationTimeLimit patience{0.05};
    std::thread{[] {
        const double end = threadCpuSeconds() + 0.15;
        while (threadCpuSeconds() < end) {
        }
    }}.join();
    EXPECT_TRUE(patience(0));
}

} // namespace physvib::session_clock_test
