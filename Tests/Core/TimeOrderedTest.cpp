// SPDX-License-Identifier: MIT
// TimeOrdered: time order, arrival order among equals, refusal when full.
#include "Core/Storage.h"
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <utility>

namespace physvib {
namespace {

TEST(TimeOrdered, GivesItemsInTimeOrderAndEqualTimesInOrderOfArrival) {
    TimeOrdered<int, 512> store;
    std::mt19937 random{7};
    for (int i = 0; i < 512; ++i) ASSERT_TRUE(store.push(random() % 20, i));
    std::int64_t lastTime = -1;
    int lastArrival = -1;
    while (!store.empty()) {
        ASSERT_GE(store.nextTime(), lastTime);
        if (store.nextTime() == lastTime) ASSERT_GT(store.next(), lastArrival);
        lastTime = store.nextTime();
        lastArrival = store.next();
        store.pop();
    }
}

TEST(TimeOrdered, FullStoreRefusesAndLosesNothing) {
    TimeOrdered<int, 2> store;
    EXPECT_TRUE(store.push(5, 1));
    EXPECT_TRUE(store.push(3, 2));
    EXPECT_TRUE(store.full());
    EXPECT_FALSE(store.push(1, 3));
    EXPECT_EQ(store.next(), 2);
    store.pop();
    EXPECT_EQ(store.next(), 1);
}

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
        }
    }
}

} // namespace
} // namespace physvib
