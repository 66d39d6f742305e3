// SPDX-License-Identifier: GPL-3.0-or-later
// Lists for people: a ball that rolls is one contact, however many grains it passes.
#include "Mixer/Model/MixerRecording.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

CollisionEvent at(std::int64_t ms, ContactKind kind, double amplitude = 0.1, std::int32_t other = 2) {
    CollisionEvent e;
    e.timeNs = ms * 1'000'000;
    e.amplitude = amplitude;
    e.source = {1, other, 0.0, 0.0, kind};
    return e;
}

TEST(RecentContacts, WhatRollsIsOneHowManyGrainsItPasses) {
    RecentContacts recent;
    for (int i = 0; i < 500; ++i) recent.add(at(i, ContactKind::roll, i == 100 ? 0.5 : 0.1));
    recent.add(at(500, ContactKind::hit));
    recent.add(at(501, ContactKind::roll));
    ASSERT_EQ(recent.newestFirst().size(), 2U);
    EXPECT_EQ(recent.newestFirst()[0].event.source.kind, ContactKind::hit);
    const RecentContact& rolled = recent.newestFirst()[1];
    EXPECT_EQ(rolled.grains, 501);
    EXPECT_EQ(rolled.event.timeNs, 0);
    EXPECT_EQ(rolled.event.amplitude, 0.5);
}

TEST(RecentContacts, AnotherPairAnotherKindAndAPauseAreAnother) {
    RecentContacts recent;
    recent.add(at(0, ContactKind::roll));
    recent.add(at(1, ContactKind::slide));
    recent.add(at(2, ContactKind::roll, 0.1, 3));
    recent.add(at(300, ContactKind::roll));
    EXPECT_EQ(recent.newestFirst().size(), 4U);
    for (int i = 0; i < 200; ++i) recent.add(at(400 + i, ContactKind::hit));
    EXPECT_EQ(recent.newestFirst().size(), RecentContacts::most);
}

TEST(RecentContacts, EachContactHasItsOwnEventsAsFarAsTheyAreKept) {
    RecentContacts recent;
    recent.add(at(0, ContactKind::roll, 0.3));
    recent.add(at(1, ContactKind::slide));
    recent.add(at(2, ContactKind::roll, 0.2));
    recent.add(at(3, ContactKind::hit, 0.7));
    const auto eventsOf = [&](std::size_t row) {
        std::vector<CollisionEvent> events;
        recent.appendEvents(recent.newestFirst()[row], events);
        return events;
    };
    ASSERT_EQ(eventsOf(2).size(), 2U);
    EXPECT_EQ(eventsOf(2)[0].amplitude, 0.3);
    EXPECT_EQ(eventsOf(2)[1].amplitude, 0.2) << "each as it was";
    EXPECT_EQ(eventsOf(1).size(), 1U);
    EXPECT_EQ(eventsOf(0)[0].amplitude, 0.7);
    for (std::size_t i = 0; i < RecentContacts::maxGrains; ++i)
        recent.add(at(static_cast<std::int64_t>(i) / 100, ContactKind::roll, 0.1, 9));
    EXPECT_EQ(eventsOf(0).size(), RecentContacts::maxGrains);
    EXPECT_TRUE(eventsOf(3).empty()) << "grains are the oldest to go";
    EXPECT_EQ(eventsOf(1).size(), 1U) << "a hit never";
}

} // namespace
} // namespace physvib
