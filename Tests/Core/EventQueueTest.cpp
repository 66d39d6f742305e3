// SPDX-License-Identifier: MIT
// Queues: order, refusal and counting when full, nothing torn between two threads, places of panners.
#include "Core/EventQueue.h"
#include "Core/CollisionEvent.h"
#include "Core/ControlQueue.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace physvib {
namespace {

TEST(EventQueue, GivesItemsBackInOrder) {
    EventQueue<int, 8> queue;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(queue.push(i));
    int item = -1;
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(queue.pop(item));
        EXPECT_EQ(item, i);
    }
    EXPECT_FALSE(queue.pop(item));
}

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
    CollisionEvent e;
    e.timeNs = n;
    e.frequencyHz = static_cast<double>(n) + 0.5;
    e.durationNs = ~n;
    e.source.massKg = static_cast<double>(3 * n);
    return e;
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

} // namespace
} // namespace physvib
