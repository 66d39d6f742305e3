// SPDX-License-Identifier: GPL-3.0-or-later
// The link when the board goes away: it says so, comes back, and what was hit in between is not felt late.
#include "VirtualBoard.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib::board_link_test {

using State = BoardLinkStatus::State;
constexpr std::int64_t ms = 1'000'000;

class BoardLinkTest : public testing::Test {
protected:
    bool isReady() const { return link.status().state == State::ready; }

    /// A tone `seconds` long, to be felt in 75 ms: a board needs 20, programs beside this one may hold it up.
    void strike(double seconds) {
        CollisionEvent tone;
        tone.frequencyHz = 205;
        tone.decayPerSecond = 1;
        tone.amplitude = 0.5;
        tone.durationNs = static_cast<std::int64_t>(seconds * 1e9);
        EXPECT_TRUE(link.push({BoardLink::nowNs() + 75 * ms, toBoardEvent(tone, {1, 0.5, 0.5, 0.25})}));
        ++struck;
    }
    void strikeFor(double seconds) {
        for (const auto end = BoardLink::nowNs() + static_cast<std::int64_t>(seconds * 1e9);
             BoardLink::nowNs() < end;) {
            strike(0.02);
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    /// As the board told after all that was sent before.
    wire::Telemetry telemetry() const {
        // what is struck last is felt 75 ms later
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        const auto seen = link.status().telemetry.frame;
        EXPECT_TRUE(test::comesTrue([&] { return link.status().telemetry.frame != seen; }));
        return link.status().telemetry;
    }
    void expectEachStrikeIsCounted() const {
        const auto s = link.status();
        EXPECT_EQ(s.sent + s.thinned + s.refused, struck);
    }

    test::VirtualBoard board;
    BoardLink link{board.port()};
    std::uint64_t struck = 0;
};

TEST_F(BoardLinkTest, APulledPlugIsToldAndPlayGoesOnWhenItIsBack) {
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    strikeFor(0.5);
    const auto before = telemetry();
    EXPECT_EQ(before.played, struck);
    strike(30);
    ASSERT_TRUE(test::comesTrue([this] { return board.last("sound") > board.last("silence"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));

    board.movePlug();
    ASSERT_TRUE(test::comesTrue([this] { return link.status().state == State::searching; }));
    strikeFor(5);
    EXPECT_EQ(link.status().state, State::searching);
    EXPECT_NE(link.status().error, "");
    const double silentAfterMs = static_cast<double>(board.last("silence") - board.last("unplugged")) / ms;
    std::cout << "at mid-scale " << silentAfterMs << " ms after the plug was pulled\n";
    EXPECT_GT(silentAfterMs, 300) << "it was to ring on for half a minute";
    EXPECT_LT(silentAfterMs, wire::defaultWatchdogMs + 10)
        << "of the board's time; what was on the line came a little later";

    board.movePlug();
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    EXPECT_EQ(link.status().error, "");
    EXPECT_EQ(link.status().connections, 2u);
    EXPECT_EQ(link.status().board.resets, 0);
    const auto sentBefore = link.status().sent;
    strikeFor(0.5);
    const auto after = telemetry();
    const auto s = link.status();
    std::cout << struck << " strikes: " << s.sent << " sent, " << s.thinned << " thinned, " << s.refused
              << " refused\n";
    EXPECT_GE(s.sent, sentBefore + 5);
    EXPECT_EQ(after.played, s.sent);
    EXPECT_EQ(after.late + after.lost + after.dropped, 0u) << "what was hit meanwhile is not felt afterwards";
    EXPECT_GE(s.thinned + s.refused, 50u);
    expectEachStrikeIsCounted();
}

TEST_F(BoardLinkTest, ABoardThatSaysNothingIsConnectedAnew) {
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    board.halt(true);
    ASSERT_TRUE(test::comesTrue([this] { return link.status().error.ends_with("no answer"); }));
    board.halt(false);
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    EXPECT_EQ(link.status().connections, 2u)
        << "it was greeted many times meanwhile, and answers all of them";
    const auto before = telemetry().played;
    strikeFor(0.5);
    EXPECT_EQ(telemetry().played - before, struck);
    expectEachStrikeIsCounted();
}

TEST_F(BoardLinkTest, ABoardThatLostItsPowerIsGreetedAgainAndIsNoLouderThanBefore) {
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    strikeFor(0.3);
    EXPECT_TRUE(test::comesTrue([this] { return board.last("sound") > 0; }));
    link.setGains({0, 0, 0, 0});
    board.stop();
    ASSERT_TRUE(test::comesTrue([this] { return link.status().state == State::searching; }));
    board.start();
    ASSERT_TRUE(test::comesTrue([this] { return isReady() && link.status().connections == 2; }));
    const auto before = struck;
    strikeFor(0.5);
    const auto after = telemetry();
    EXPECT_EQ(after.played, struck - before);
    EXPECT_EQ(after.late + after.lost, 0u);
    EXPECT_EQ(board.last("sound"), 0) << "its log is a new one";
    expectEachStrikeIsCounted();
}

TEST_F(BoardLinkTest, ACrowdIsThinnedWeakestFirstAndCounted) {
    ASSERT_TRUE(test::comesTrue([this] { return isReady(); }));
    constexpr int crowd = 400; // due within 100 ms: the line carries 72
    const std::int64_t first = BoardLink::nowNs() + 200 * ms;
    for (int i = 0; i < crowd; ++i) {
        BoardEvent hit{0, static_cast<std::uint16_t>(16 * 100), 16 * 20, 0, {}};
        hit.amplitudes[0] = static_cast<std::int16_t>(10 + i * 7919 % 401);
        EXPECT_TRUE(link.push({first + i * ms / 4, hit}));
        ++struck;
    }
    const auto t = telemetry();
    EXPECT_EQ(t.played, link.status().sent);
    EXPECT_EQ(t.late + t.lost + t.dropped, 0u);
    EXPECT_GT(link.status().thinned, 0u);
    expectEachStrikeIsCounted();
}

} // namespace physvib::board_link_test
