// SPDX-License-Identifier: MIT
// The board's clock seen through delays of 10 to 30 ms and a drift of 300 ppm, for ten minutes.
#include "Wire/LinkClock.h"
#include "Wire/Messages.h"
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace physvib {
namespace {

struct Line {
    double drift = 300e-6, bootSeconds = 3.7, shortest = 0.010, longest = 0.030;
    std::mt19937 random{7};
    double boardSeconds(double host) const { return bootSeconds + host * (1.0 + drift); }
    double delay() { return shortest + (longest - shortest) * (random() / 4294967296.0); }
};

std::int64_t ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

void ping(LinkClock& clock, Line& line, double now) {
    const double there = now + line.delay();
    clock.add(ns(now), line.boardSeconds(there) * 8000, ns(there + line.delay()));
}

// The worst error of a played onset, in seconds, from `from` to `to`; pings as BoardLink sends them.
double worstError(LinkClock& clock, Line& line, double from, double to) {
    double worst = 0;
    for (double t = from; t < to;
         t += clock.isReady() ? 1.0 / wire::pingsPerSecond : 1.0 / wire::firstPingsPerSecond) {
        ping(clock, line, t);
        if (!clock.isReady()) continue;
        const double event = t + 0.1; // placed up to a ping ahead
        worst = std::max(worst, std::abs(clock.frameAt(ns(event)) / 8000 - line.boardSeconds(event)));
    }
    return worst;
}

TEST(LinkClock, HoldsOnsetsWithinTwoMillisecondsForTenMinutes) {
    for (const double drift : {300e-6, -300e-6, 0.0}) {
        Line line;
        line.drift = drift;
        LinkClock clock;
        const double first = worstError(clock, line, 0, 10), later = worstError(clock, line, 10, 600);
        std::cout << "drift " << drift * 1e6 << " ppm: worst onset error " << first * 1e3
                  << " ms in the first 10 s, " << later * 1e3 << " ms to 600 s, uncertainty "
                  << clock.uncertaintySeconds() * 1e3 << " ms\n";
        EXPECT_LT(later, 0.002);
        EXPECT_LT(first, 0.002);
        EXPECT_NEAR(clock.drift(), drift, 50e-6);
        EXPECT_GT(clock.worstDelaySeconds(), 0.028);
        EXPECT_LT(clock.worstDelaySeconds(), 0.032);
        EXPECT_LE(later, clock.uncertaintySeconds());
    }
}

TEST(LinkClock, FindsTheOnePercentOfAnInternalOscillator) {
    Line line;
    line.drift = 0.01;
    line.shortest = 0.001;
    line.longest = 0.004;
    LinkClock clock;
    worstError(clock, line, 0, 10);
    EXPECT_LT(worstError(clock, line, 10, 60), 0.0005);
}

TEST(LinkClock, GoesOnWhenTheBoardsCounterIsOver) {
    constexpr double over = 4294967296.0;
    Line line; // 6.2 days and a second before: it wraps while the clock is being learnt; and later
    for (const double wrapsAfter : {1.0, 30.0}) {
        LinkClock clock;
        line.bootSeconds = over / 8000 - wrapsAfter;
        double worst = 0.0;
        for (double t = 0; t < 60; t += clock.isReady() ? 0.1 : 0.02) {
            const double there = t + line.delay(), frames = line.boardSeconds(there) * 8000;
            const auto counted = static_cast<std::uint32_t>(static_cast<std::uint64_t>(frames));
            clock.add(
                ns(t),
                clock.unwrapped(counted, static_cast<std::uint8_t>((frames - std::floor(frames)) * 256.0)),
                ns(there + line.delay()));
            if (clock.isReady())
                worst =
                    std::max(worst, std::abs(clock.frameAt(ns(t + 0.1)) / 8000 - line.boardSeconds(t + 0.1)));
        }
        EXPECT_LT(worst, 0.002) << wrapsAfter;
        EXPECT_GT(clock.frameAt(ns(60)), over);
        EXPECT_LT(clock.worstDelaySeconds(), 0.035);
    }
}

TEST(LinkClock, IsNotReadyBeforeItKnows) {
    LinkClock clock;
    Line line;
    for (int i = 0; i < LinkClock::needed; ++i) {
        EXPECT_FALSE(clock.isReady());
        ping(clock, line, i * 0.1);
    }
    EXPECT_TRUE(clock.isReady());
    clock.clear();
    EXPECT_FALSE(clock.isReady());
}

} // namespace
} // namespace physvib
