// SPDX-License-Identifier: GPL-3.0-or-later
// What a board is sent after a stop, and what is told of it after a call.
#include "FakeBoard.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr std::int64_t ms = 1'000'000;

/// From each state in which something is on its way to the board: nothing follows the stop, until something
/// new is asked for.
TEST(StoppedBoards, GetNothingOfWhatWasBefore) {
    for (const int tones : {1, 4, 6}) { // more than four do not move as segments
        FakeBoard board{ours(), 0};
        BesideDevice played{board};
        Session& session = *played.session;
        const auto goOn = [&] { played.goOn(); };
        std::vector<CollisionEvent> events(static_cast<std::size_t>(tones));
        for (std::size_t i = 0; i < events.size(); ++i) {
            events[i].frequencyHz = 150.0 + 20.0 * static_cast<double>(i);
            events[i].amplitude = 0.2;
            events[i].durationNs = 20'000 * ms;
            events[i].course = {4.0, 4.0, events[i].durationNs, 0};
        }
        const auto submit = [&](Input input) { return session.submit(std::move(input)); };
        EXPECT_TRUE(submit({Strikes{events}}));
        const auto sent = [&] { return board.segments().size() + board.strikes().size(); };
        EXPECT_TRUE(test::comesTrue([&] { return goOn(), sent() > 10; }));
        Input stop{Stop{}};
        stop.timeNs = session.timeline().presentNs();
        EXPECT_TRUE(submit(std::move(stop)));
        EXPECT_TRUE(test::comesTrue([&] { return goOn(), board.stops() > 0; }));
        const std::int64_t until = session.timeline().presentNs() + 1500 * ms;
        EXPECT_TRUE(test::comesTrue([&] { return goOn(), session.timeline().presentNs() > until; }));
        EXPECT_EQ(board.sinceStop(), 0U) << tones << " tones that move";
        EXPECT_TRUE(submit({Strikes{std::span{events}.first(1)}}));
        EXPECT_TRUE(test::comesTrue([&] { return goOn(), board.sinceStop() > 0; }));
    }
}

/// A board counts from when it was switched on; a call is told of its own strikes.
TEST(StoppedBoards, TellOfThisCallAlone) {
    FakeBoard board{ours(), 0};
    board.count({.good = 1, .played = 100, .late = 50, .dropped = 30});
    const SessionSetup setup = test::setupOfWalls();
    BoardOutput onBoard{board.port(), setup.panner, 0.05};
    ASSERT_EQ(onBoard.awaitReady([] { return true; }), "");
    board.count({.frame = 1000, .good = 2, .played = 115, .late = 52, .dropped = 31});
    std::string told;
    EXPECT_TRUE(test::comesTrue([&] {
        told = onBoard.summary([] { return true; });
        return told.find("the board played 15, 2 late, 1 dropped") != std::string::npos;
    })) << told;
}

} // namespace
} // namespace physvib
