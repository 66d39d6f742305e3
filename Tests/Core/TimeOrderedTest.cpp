// SPDX-License-Identifier: MIT
// TimeOrdered and PendingEvents: time order, arrival order among equals, refusal when full.
#include "Core/PendingEvents.h"
#include <gtest/gtest.h>
#include <random>

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

} // namespace
} // namespace physvib
