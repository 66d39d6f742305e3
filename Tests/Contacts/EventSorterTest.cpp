// SPDX-License-Identifier: MIT
// Order, release and overflow of events that wait for their turn.
#include "Contacts/EventMaker.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/IndexMaps.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace physvib::event_sorter_test {

CollisionEvent event(std::int64_t timeNs, std::int32_t fixture = 0, double amplitude = 0.0) {
    return {.timeNs = timeNs, .amplitude = amplitude, .source = {.fixture = fixture}};
}

std::vector<CollisionEvent> released(EventSorter& sorter, std::int64_t beforeNs) {
    std::vector<CollisionEvent> events;
    sorter.release(beforeNs, events);
    return events;
}

TEST(EventSorter, ReleasesInOrderOfTimeThenFixtureThenArrival) {
    EventSorter sorter(8);
    const std::vector<CollisionEvent> expected{event(1), event(5, 1), event(5, 2, 0.9), event(5, 2, 0.1)};
    for (const std::size_t i : {2U, 3U, 0U, 1U}) sorter.push(expected[i]);
    EXPECT_EQ(released(sorter, 6), expected);
}

// Hundreds go by shares of the time, few by comparison: the same order.
TEST(EventSorter, ManyAreSortedAsFew) {
    std::mt19937 random{1};
    for (const std::int64_t range :
         {std::int64_t{1}, std::int64_t{40}, std::int64_t{10'000'000}, std::int64_t{60'000'000'000}}) {
        const std::int64_t start = range == 1 ? limits::maxTimeNs - 1 : 0; // one time, that late
        EventSorter sorter(1000);
        std::vector<CollisionEvent> all, finished, rest;
        for (int round = 0; round < 3; ++round) {
            for (int i = 0; i < 300; ++i) {
                all.push_back(event(start + static_cast<std::int64_t>(random()) % range,
                                    static_cast<std::int32_t>(random() % 4) - 1,
                                    1e-3 * static_cast<double>(all.size())));
                sorter.push(all.back());
            }
            if (round == 1) sorter.release(start + range / 2, finished);
        }
        sorter.flush(rest);
        const auto isBefore = [](const CollisionEvent& a, const CollisionEvent& b) {
            return a.timeNs != b.timeNs ? a.timeNs < b.timeNs : a.source.fixture < b.source.fixture;
        };
        std::vector<CollisionEvent> early, late;
        for (std::size_t i = 0; i < all.size(); ++i)
            (i < 600 && all[i].timeNs < start + range / 2 ? early : late).push_back(all[i]);
        std::ranges::stable_sort(early, isBefore);
        std::ranges::stable_sort(late, isBefore);
        EXPECT_EQ(finished, early) << range;
        EXPECT_EQ(rest, late) << range;
    }
}

TEST(EventSorter, KeepsEventsFromTheGivenTimeOn) {
    EventSorter sorter(8);
    for (const std::int64_t ns : {10, 9}) sorter.push(event(ns));
    EXPECT_EQ(released(sorter, 10), std::vector{event(9)});
    EXPECT_EQ(released(sorter, 11), std::vector{event(10)});
}

TEST(EventSorter, AFullOneKeepsTheStrongest) {
    EventSorter sorter(2);
    for (const double amplitude : {0.1, -0.2, 0.15, 0.05}) sorter.push(event(0, 0, amplitude));
    EXPECT_EQ(released(sorter, 100), (std::vector{event(0, 0, -0.2), event(0, 0, 0.15)}));
    EXPECT_EQ(sorter.drops(), 2U);
}

TEST(EventSorter, WithdrawsEventsOfAFixtureAndOnDemandThoseItGave) {
    EventSorter sorter(8);
    CollisionEvent given = event(2, 1);
    given.source.other = 5;
    sorter.push(event(1, 5));
    sorter.push(given);
    sorter.push(event(3, 1));
    sorter.removeEventsOf(5, false);
    EXPECT_EQ(released(sorter, 3), std::vector{given});
    sorter.push(given);
    sorter.removeEventsOf(5, true);
    EXPECT_EQ(released(sorter, 10), std::vector{event(3, 1)});
}

// The map against std::map, with keys that collide.

TEST(IntegerMap, EqualsAStandardMapThroughRandomEdits) {
    std::mt19937 random(1);
    IntegerMap map(4);
    std::map<std::uint64_t, std::int32_t> reference;
    for (int i = 0; i < 200'000; ++i) {
        const std::uint64_t key = (1 + random() % 200) << 40U;
        if (random() % 2 == 0) {
            map.set(key, i);
            reference[key] = i;
        } else {
            map.erase(key);
            reference.erase(key);
        }
        if (random() % 1000 == 0) {
            map.clear();
            reference.clear();
        }
        const std::uint64_t asked = (1 + random() % 200) << 40U;
        const auto found = reference.find(asked);
        ASSERT_EQ(map.find(asked), found == reference.end() ? IntegerMap::none : found->second);
        ASSERT_EQ(map.size(), reference.size());
    }
}

// A sketch of a set of names: no is certain, and yes is rare of what is not there.

std::uint64_t address(int i) { return 0x7F0000001000U + 16U * static_cast<std::uint64_t>(i); }

TEST(NameSketch, NeverDeniesWhatIsThere) {
    CountingFilter sketch;
    for (int i = 0; i < 50'000; ++i) sketch.add(address(i));
    for (int i = 100; i < 50'000; ++i) sketch.remove(address(i));
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(sketch.mayContain(address(i))) << i;
}

TEST(NameSketch, SeldomAffirmsWhatIsNot) {
    CountingFilter sketch;
    for (int i = 0; i < 100; ++i) sketch.add(address(i));
    int affirmed = 0;
    for (int i = 100; i < 10'100; ++i) affirmed += sketch.mayContain(address(i)) ? 1 : 0;
    EXPECT_LT(affirmed, 1000); // 100 of 2,048 places are taken: 1 in 20
}

TEST(NameSketch, OfCamerasFollowsTheTable) {
    FixtureTable table;
    const HapticFixture camera{.isCamera = true}, other{};
    const std::int32_t slot = table.findOrAdd(address(1), {});
    EXPECT_FALSE(table.mayBeSource(address(1)));
    for (int i = 0; i < 2; ++i) table.set(slot, camera, {});
    EXPECT_TRUE(table.mayBeSource(address(1)));
    table.set(slot, other, {});
    EXPECT_FALSE(table.mayBeSource(address(1)));
    table.set(slot, camera, {});
    table.removeValues(slot);
    EXPECT_FALSE(table.mayBeSource(address(1)));
    table.set(slot, camera, {});
    table.release(slot);
    EXPECT_FALSE(table.mayBeSource(address(1)));
}

} // namespace physvib::event_sorter_test
