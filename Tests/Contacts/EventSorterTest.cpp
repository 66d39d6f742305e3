// SPDX-License-Identifier: MIT
// Order, release and overflow of events that wait for their turn.
#include "Contacts/EventSorter.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

CollisionEvent event(std::int64_t timeNs, std::int32_t fixture = 0, double amplitude = 0.0) {
    CollisionEvent e;
    e.timeNs = timeNs;
    e.source.fixture = fixture;
    e.amplitude = amplitude;
    return e;
}

TEST(EventSorter, ReleasesInOrderOfTimeThenFixtureThenArrival) {
    EventSorter sorter(8);
    const std::vector<CollisionEvent> expected{event(1), event(5, 1), event(5, 2, 0.9), event(5, 2, 0.1)};
    for (const std::size_t i : {2U, 3U, 0U, 1U}) sorter.push(expected[i]);
    std::vector<CollisionEvent> finished;
    sorter.release(6, finished);
    EXPECT_EQ(finished, expected);
}

TEST(EventSorter, KeepsEventsFromTheGivenTimeOn) {
    EventSorter sorter(8);
    sorter.push(event(10));
    sorter.push(event(9));
    std::vector<CollisionEvent> finished;
    sorter.release(10, finished);
    EXPECT_EQ(finished, std::vector{event(9)});
    sorter.release(11, finished);
    EXPECT_EQ(finished, (std::vector{event(9), event(10)}));
}

TEST(EventSorter, FullSorterCountsWhatItDrops) {
    EventSorter sorter(2);
    for (int i = 0; i < 5; ++i) sorter.push(event(i));
    std::vector<CollisionEvent> finished;
    sorter.release(100, finished);
    EXPECT_EQ(finished.size(), 2U);
    EXPECT_EQ(sorter.drops(), 3U);
}

TEST(EventSorter, WithdrawsEventsOfAFixtureAndOnDemandThoseItGave) {
    EventSorter sorter(8);
    CollisionEvent given = event(2, 1);
    given.source.other = 5;
    sorter.push(event(1, 5));
    sorter.push(given);
    sorter.push(event(3, 1));
    sorter.withdraw(5, false);
    std::vector<CollisionEvent> finished;
    sorter.release(3, finished);
    EXPECT_EQ(finished, std::vector{given});
    sorter.push(given);
    sorter.withdraw(5, true);
    finished.clear();
    sorter.release(10, finished);
    EXPECT_EQ(finished, std::vector{event(3, 1)});
}

} // namespace
} // namespace physvib
