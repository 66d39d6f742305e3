// SPDX-License-Identifier: MIT
// Queues: order, refusal and counting when full, nothing torn between two threads, places of panners.
#include "Core/EventQueue.h"
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/ControlQueue.h"
#include "Core/Limits.h"
#include "Core/Storage.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace physvib::event_queue_test {

TEST(EventQueue, FullQueueRefusesCountsAndKeepsWhatItHas) {
    EventQueue<int, 4> queue;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(i));
    EXPECT_FALSE(queue.push(4));
    EXPECT_FALSE(queue.push(5));
    EXPECT_EQ(queue.overflows(), 2u);
    int item = -1;
    EXPECT_TRUE(queue.pop(item));
    EXPECT_EQ(item, 0);
    EXPECT_TRUE(queue.push(6));
    for (const int expected : {1, 2, 3, 6}) {
        ASSERT_TRUE(queue.pop(item));
        EXPECT_EQ(item, expected);
    }
}

// Each field of an event is derived from its number, so a torn or reordered read shows.
CollisionEvent numbered(std::int64_t n) {
    return {.timeNs = n,
            .frequencyHz = static_cast<double>(n) + 0.5,
            .durationNs = ~n,
            .source = {.massKg = static_cast<double>(3 * n)}};
}

template <class Queue>
void expectAllInOrderBetweenTwoThreads() {
    constexpr std::int64_t count = 300'000;
    Queue queue;
    std::thread producer{[&] {
        for (std::int64_t n = 0; n < count;)
            if (queue.push(numbered(n)))
                ++n;
            else
                std::this_thread::yield();
    }};
    CollisionEvent e;
    bool whole = true;
    for (std::int64_t n = 0; n < count;)
        if (queue.pop(e))
            whole = whole && e == numbered(n++);
        else
            std::this_thread::yield();
    producer.join();
    EXPECT_TRUE(whole);
    EXPECT_FALSE(queue.pop(e));
}

TEST(EventQueue, NothingIsTornLostOrReorderedBetweenTwoThreads) {
    expectAllInOrderBetweenTwoThreads<EventQueue<CollisionEvent, 64>>();
    expectAllInOrderBetweenTwoThreads<GrowingQueue<CollisionEvent, 16, 5>>();
}

TEST(GrowingQueue, UsesItsChunksAgainAndRefusesWhenAllAreFull) {
    GrowingQueue<int, 4, 3> queue;
    int item = -1, next = 0;
    for (int n = 0; n < 1000; ++n) { // never more than two chunks
        EXPECT_TRUE(queue.push(n));
        if (n % 3 != 2) continue;
        for (int k = 0; k < 3; ++k) {
            ASSERT_TRUE(queue.pop(item));
            ASSERT_EQ(item, next++);
        }
    }
    while (queue.pop(item)) ASSERT_EQ(item, next++);
    int pushed = 0;
    while (queue.push(1000 + pushed)) ++pushed;
    EXPECT_GE(pushed, 8);
    EXPECT_LE(pushed, 12);
    EXPECT_EQ(queue.overflows(), 1U);
    for (; queue.pop(item); --pushed) ASSERT_EQ(item, next++);
    EXPECT_EQ(pushed, 0);
}

RenderControl pannerControl(const PhantomPanner& panner) {
    return {.kind = RenderControl::Kind::panner, .panner = &panner};
}

// The sender's panner may be gone when the control is read; its copy stays until the reader is done.
template <class Queue>
void expectPlacesAreHandedBack(int places) {
    Queue queue;
    RenderControl control;
    for (int turn = 0; turn < 3; ++turn) {
        std::vector<RenderControl> read;
        for (int k = 0; k < places; ++k) {
            ASSERT_TRUE(
                queue.push(pannerControl({test::gridLayout(1 + k % 3, 1), PanningLaw::linear, 1, 1, 1})));
            ASSERT_TRUE(queue.pop(control));
            read.push_back(control);
        }
        EXPECT_FALSE(queue.push(pannerControl({}))) << "all places are in use";
        EXPECT_TRUE(queue.push({.kind = RenderControl::Kind::gain})) << "which needs none";
        EXPECT_TRUE(queue.pop(control));
        EXPECT_EQ(queue.overflows(), static_cast<std::size_t>(turn + 1));
        for (std::size_t k = 0; k < read.size(); ++k)
            EXPECT_EQ(read[k].panner->channels(), static_cast<int>(1 + k % 3));
        if (turn == 0)
            queue.clear();
        else
            for (const RenderControl& one : read) queue.done(one);
    }
}

TEST(ControlQueue, PannersHavePlacesUntilTheyAreHandedBack) {
    expectPlacesAreHandedBack<ControlQueue<8>>(8);
    expectPlacesAreHandedBack<ControlQueue<8, 3>>(3);
}

TEST(ControlQueue, AFullQueueKeepsNoPlace) {
    ControlQueue<2, 2> queue;
    for (int k = 0; k < 2; ++k) ASSERT_TRUE(queue.push({.kind = RenderControl::Kind::gain}));
    for (int k = 0; k < 5; ++k) ASSERT_FALSE(queue.push(pannerControl({})));
    EXPECT_EQ(queue.overflows(), 5U);
    RenderControl control;
    while (queue.pop(control)) {
    }
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(queue.push(pannerControl({})));
}

// FrameClock: exact frames and leads at every rate.

__extension__ using Int128 = __int128;

TEST(FrameClock, FrameIsTheFirstOneNotBeforeTheOnset) {
    std::mt19937 random{3};
    for (const int rate : {5000, 11025, 44100, 48000, 96000, 192000}) {
        const FrameClock clock{rate};
        for (int i = 0; i < 2000; ++i) {
            const std::int64_t ns = static_cast<std::int64_t>(random()) * 4096 + random() % 4096;
            const FramePosition p = clock.at(ns);
            const auto ahead = static_cast<double>(static_cast<Int128>(p.frame) * 1'000'000'000 -
                                                   static_cast<Int128>(ns) * rate);
            ASSERT_GE(ahead, 0.0);
            ASSERT_LT(ahead, 1e9);
            ASSERT_NEAR(p.leadFrames, ahead * 1e-9, 1e-15);
        }
    }
}

TEST(FrameClock, OnsetOnAFrameHasNoLeadUpToTheLastMoment) {
    EXPECT_EQ(FrameClock{44100}.at(0).frame, 0);
    EXPECT_EQ(FrameClock{44100}.at(100'000'000).frame, 4410);
    EXPECT_EQ(FrameClock{44100}.at(100'000'000).leadFrames, 0.0);
    EXPECT_EQ(FrameClock{192000}.at(limits::maxTimeNs).frame, 19'200'000'000'000);
}

// TimeOrdered: time order, arrival order among equals, refusal when full.

// Most come in order, some late, some far ahead; taken out in between.
TEST(TimeOrdered, IsTheSameAsASortedListWhateverComesAndGoes) {
    TimeOrdered<int, 64, true> store;
    EXPECT_TRUE(store.full()) << "it has no room before";
    for (const int capacity : {64, 5}) {
        ASSERT_TRUE(store.resize(capacity));
        std::set<std::pair<std::int64_t, int>> expected; // time, then arrival
        std::mt19937 random{11};
        std::int64_t now = 0;
        for (int i = 0; i < 20'000; ++i) {
            const auto what = random() % 10;
            const std::int64_t time = what == 0   ? now - static_cast<int>(random() % 50)
                                      : what == 1 ? now + 40
                                                  : now;
            ASSERT_EQ(store.push(time, i), static_cast<int>(expected.size()) < capacity);
            if (static_cast<int>(expected.size()) < capacity) expected.emplace(time, i);
            now += random() % 3;
            if (i % 1000 == 999) {
                std::set<std::pair<std::int64_t, int>> moved;
                for (const auto& [t, item] : expected) moved.emplace(t / 7, item);
                expected = std::move(moved);
                store.retime([](std::int64_t t, int) { return t / 7; });
                now /= 7;
            }
            while (!expected.empty() && random() % 5 < 2) {
                ASSERT_EQ(store.nextTime(), expected.begin()->first);
                ASSERT_EQ(store.next(), expected.begin()->second) << i;
                store.pop();
                expected.erase(expected.begin());
            }
            ASSERT_EQ(store.size(), static_cast<int>(expected.size()));
            ASSERT_EQ(store.full(), store.size() == capacity);
        }
    }
}

// LatestValue: the newest value, whole, never going back.

struct Wide {
    std::array<std::uint64_t, 32> words{};
};

TEST(LatestValue, IsDefaultThenSkipsToTheNewestAndKeepsIt) {
    LatestValue<int> value;
    EXPECT_EQ(value.read(), 0);
    for (int i = 1; i <= 5; ++i) value.write(i);
    EXPECT_EQ(value.read(), 5);
    EXPECT_EQ(value.read(), 5);
    value.write(6);
    EXPECT_EQ(value.read(), 6);
}

TEST(LatestValue, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
    constexpr std::uint64_t count = 300'000;
    LatestValue<Wide> value;
    std::thread writer{[&] {
        Wide wide;
        for (std::uint64_t n = 1; n <= count; ++n) {
            wide.words.fill(n);
            value.write(wide);
        }
    }};
    std::uint64_t last = 0;
    bool whole = true, forward = true;
    while (last < count && whole && forward) {
        const Wide wide = value.read();
        for (const auto word : wide.words) whole = whole && word == wide.words[0];
        forward = wide.words[0] >= last;
        last = wide.words[0];
    }
    writer.join();
    EXPECT_TRUE(whole);
    EXPECT_TRUE(forward);
    EXPECT_EQ(value.read().words[7], count);
}

} // namespace physvib::event_queue_test
