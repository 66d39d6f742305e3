// SPDX-License-Identifier: MIT
// The board's clock seen through delays of 10 to 30 ms and a drift of 300 ppm, for ten minutes.
#include "Wire/LinkClock.h"
#include "Wire/FrameDecoder.h"
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <vector>

namespace physvib::link_clock_test {

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
            clock.add(ns(t),
                      clock.unwrappedFrame(counted,
                                           static_cast<std::uint8_t>((frames - std::floor(frames)) * 256.0)),
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
    for (int i = 0; i < LinkClock::minPings; ++i) {
        EXPECT_FALSE(clock.isReady());
        ping(clock, line, i * 0.1);
    }
    EXPECT_TRUE(clock.isReady());
    clock.clear();
    EXPECT_FALSE(clock.isReady());
}

// A board that is connected again has another clock.
TEST(LinkClock, KnowsNothingOfAFormerConnection) {
    for (const int pings : {1, LinkClock::minPings, LinkClock::window + 40}) {
        LinkClock again, fresh;
        Line former, line, same;
        line.drift = same.drift = -200e-6;
        for (int i = 0; i < pings; ++i) ping(again, former, i * 0.1);
        again.clear();
        for (int i = 0; i < LinkClock::window; ++i) {
            ASSERT_EQ(again.unwrappedFrame(3U << 30, 7), fresh.unwrappedFrame(3U << 30, 7));
            ping(again, line, 60 + i * 0.1);
            ping(fresh, same, 60 + i * 0.1);
            ASSERT_EQ(again.isReady(), fresh.isReady());
            ASSERT_EQ(again.frameAt(ns(99)), fresh.frameAt(ns(99))) << pings << " before, then " << i;
            ASSERT_EQ(again.worstDelaySeconds(), fresh.worstDelaySeconds());
        }
    }
}

// CRC-16 and COBS: published check values, round trips, broken frames.

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const Bytes& payload) {
    Bytes out(cobsMaxEncoded(payload.size()));
    out.resize(cobsEncode(payload, out));
    return out;
}

TEST(Crc16, HasTheCataloguedCheckValue) {
    constexpr std::array<std::uint8_t, 9> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(crc16(digits), 0x29B1);
}

TEST(Cobs, EncodesThePublishedExamples) {
    EXPECT_EQ(encoded({0}), (Bytes{1, 1}));
    EXPECT_EQ(encoded({0x11, 0x22, 0, 0x33}), (Bytes{3, 0x11, 0x22, 2, 0x33}));
}

TEST(Cobs, RoundTripsEverythingWithoutAZero) {
    std::mt19937 random{4};
    for (int i = 0; i < 3000; ++i) {
        Bytes payload(random() % 600);
        for (auto& b : payload) b = static_cast<std::uint8_t>(random() % (1 + random() % 256));
        const Bytes frame = encoded(payload);
        ASSERT_EQ(std::count(frame.begin(), frame.end(), 0), 0);
        Bytes back(payload.size());
        ASSERT_EQ(cobsDecode(frame, back), static_cast<int>(payload.size()));
        ASSERT_EQ(back, payload);
    }
}

TEST(Cobs, BrokenFramesAreRefused) {
    Bytes out(8);
    EXPECT_EQ(cobsDecode(Bytes{5, 1, 2}, out), -1); // group longer than the frame
    EXPECT_EQ(cobsDecode(Bytes{3, 0, 2}, out), -1); // a zero inside
    EXPECT_EQ(cobsDecode(Bytes{0}, out), -1);
    EXPECT_EQ(cobsDecode(encoded(Bytes(9, 7)), out), -1); // does not fit
}

TEST(Cobs, GarbageNeverWritesPastTheEnd) {
    std::mt19937 random{9};
    for (int i = 0; i < 20000; ++i) {
        Bytes frame(random() % 40), out(random() % 20);
        for (auto& b : frame) b = static_cast<std::uint8_t>(random() % 24);
        ASSERT_LE(cobsDecode(frame, out), static_cast<int>(out.size()));
    }
}

// What comes again is not played again; what was lost is counted, and what comes after is played.

struct Stream {
    wire::DuplicateFilter order;
    std::uint32_t frame = 4'294'960'000u; // the counter is over soon
    std::uint8_t sequence = 0xFF;
    /// The next strike, 60 ms before its onset.
    bool next() {
        frame += 11;
        return order.isNew(++sequence, frame, frame - 480);
    }
    /// That of `ago` strikes before, once more.
    bool again(int ago) {
        return order.isNew(static_cast<std::uint8_t>(sequence - ago),
                           frame - 11u * static_cast<std::uint32_t>(ago), frame - 480);
    }
};

TEST(StrikeOrder, NothingIsPlayedTwice) {
    Stream stream;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_TRUE(stream.next()) << i;
        for (const int ago : {0, 1, 2, 30, 127})
            if (ago <= i) ASSERT_FALSE(stream.again(ago)) << i << ' ' << ago;
    }
    for (int ago = 0; ago < 1000; ++ago)
        if (ago < 128 || ago * 11 - 480 > 2000) EXPECT_FALSE(stream.again(ago)) << ago;
    EXPECT_EQ(stream.order.lost(), 0u);
    EXPECT_TRUE(stream.next());
}

TEST(StrikeOrder, AnOnsetBeforeTheLastOneIsNoRepetition) {
    wire::DuplicateFilter order;
    EXPECT_TRUE(order.isNew(0, 1000, 500));
    EXPECT_TRUE(order.isNew(1, 900, 500));
    EXPECT_TRUE(order.isNew(2, 900, 500)) << "a chord";
    EXPECT_FALSE(order.isNew(1, 900, 500));
}

TEST(StrikeOrder, LostStrikesAreCountedAndNothingWaitsForThem) {
    for (const int lost : {1, 5, 126, 127, 200, 254, 255}) {
        Stream stream;
        for (int i = 0; i < 10; ++i) ASSERT_TRUE(stream.next());
        stream.sequence = static_cast<std::uint8_t>(stream.sequence + lost);
        stream.frame += 11u * static_cast<std::uint32_t>(lost);
        EXPECT_TRUE(stream.next()) << lost;
        EXPECT_EQ(stream.order.lost(), static_cast<std::uint32_t>(lost));
        EXPECT_TRUE(stream.next()) << lost;
    }
}

} // namespace physvib::link_clock_test
