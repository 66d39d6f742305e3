// SPDX-License-Identifier: MIT
// EventQueue: order, refusal and counting when full, nothing torn between two threads.
#include "Core/EventQueue.h"
#include "Core/CollisionEvent.h"
#include <gtest/gtest.h>
#include <thread>

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

TEST(EventQueue, NothingIsTornLostOrReorderedBetweenTwoThreads) {
    constexpr std::int64_t count = 300'000;
    EventQueue<CollisionEvent, 64> queue;
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

} // namespace
} // namespace physvib
