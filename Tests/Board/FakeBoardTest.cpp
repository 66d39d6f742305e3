// SPDX-License-Identifier: GPL-3.0-or-later
// Boards that answer as none should, and one whose counter is over: what the link makes of them.
#include "FakeBoard.h"
#include <gtest/gtest.h>

namespace physvib::fake_board_test {

constexpr std::int64_t ms = 1'000'000;

TEST(BoardLinkWithAFakeBoard, OneThatIsNotOursIsRefusedAndTold) {
    struct {
        void (*change)(wire::HelloReply&);
        const char* told;
    } const cases[]{
        {[](wire::HelloReply& r) { r.version = 255; }, ": expected a board of protocol 1 to 2, found 255"},
        {[](wire::HelloReply& r) { r.channels = 0; },
         ": expected a board of 4 channels at 8000 Hz, found 0 at 8000 Hz"},
        {[](wire::HelloReply& r) { r.sampleRateHz = 0; },
         ": expected a board of 4 channels at 8000 Hz, found 4 at 0 Hz"},
        {[](wire::HelloReply& r) { r.watchdogMs = 65535; },
         ": expected a board that is silent 500 ms after its computer, and plays within a second"},
        {[](wire::HelloReply& r) { r.aheadFrames = limits::board::sampleRateHz + 1; },
         ": expected a board that is silent 500 ms after its computer, and plays within a second"},
    };
    for (const auto& one : cases) {
        auto reply = ours();
        one.change(reply);
        FakeBoard board{reply, 0};
        BoardLink link{board.port()};
        EXPECT_TRUE(test::comesTrue([&] { return link.status().error == board.port() + one.told; }))
            << link.status().error;
        EXPECT_EQ(link.status().connections, 0u);
    }
}

TEST(BoardLinkWithAFakeBoard, NeitherAWrongAnswerNorACounterThatIsOverMovesItsClock) {
    FakeBoard board{ours(), 4'294'967'295u - 8000u, true}; // over in a second, while the clock is learnt
    BoardLink link{board.port()};
    ASSERT_TRUE(test::comesTrue([&] { return link.status().state == BoardLinkStatus::State::ready; }));
    const std::int64_t onset = BoardLink::nowNs() + 100 * ms;
    link.push({onset, {0, 16 * 205, 16, 0, {1000, 0, 0, 0}}});
    ASSERT_TRUE(test::comesTrue([&] { return !board.strikes().empty(); }));
    const auto wanted = static_cast<std::uint32_t>(static_cast<std::uint64_t>(board.frameAt(onset)));
    EXPECT_LT(std::abs(static_cast<std::int32_t>(board.strikes()[0].event.frame - wanted)), 160)
        << "20 ms; a wrong answer is 50 or 100 off";
    EXPECT_EQ(link.status().connections, 1u);
    EXPECT_EQ(link.status().refused, 0u);
    EXPECT_LT(link.status().outputLatencyMs, 200.0);
}

TEST(BoardLinkWithAFakeBoard, WhatItNeedsAheadIsInItsLatencyAndTold) {
    auto slow = ours();
    slow.aheadFrames = limits::board::sampleRateHz; // a second, the most that is taken
    FakeBoard board{slow, 0};
    board.count({.good = 1});
    const SessionSetup setup = test::setupOfWalls();
    BoardOutput onBoard{board.port(), setup.panner, 0.3};
    ASSERT_TRUE(test::comesTrue([&] { return onBoard.state().isReady; }));
    EXPECT_GE(onBoard.status().outputLatencyMs, 1000.0) << "and the way there";
    EXPECT_LT(onBoard.status().outputLatencyMs, 2000.0) << "once";
    EXPECT_NE(onBoard.state().error.find("more than 300 ms before they are felt"), std::string::npos);
    EXPECT_EQ(onBoard.awaitReady([] { return true; }), "");
    EXPECT_GE(onBoard.latencySeconds(), 1.0) << "a session that waits for it gives it that time";
}

TEST(BoardLinkWithAFakeBoard, SilenceOfTheDeviceBesideItIsItsOwn) {
    FakeBoard board{ours(), 0};
    SessionSetup setup = test::setupOfWalls();
    setup.channels = 4;
    BoardOutput onBoard{board.port(), setup.panner, 0.05};
    Session session{setup};
    session.sinks().attach(onBoard);
    std::atomic<bool> interrupt{false};
    test::FakeInterface hands;
    AudioOutput output{session, test::fakeDrivers({&hands}), &interrupt};
    output.setLevel(0.5f);
    const ScopedFollow together{session.sinks(), output};
    const int half = limits::board::amplitudeUnit / 2;
    EXPECT_TRUE(test::comesTrue([&] { return board.gain() == half; }));
    output.setSilent(true);
    EXPECT_TRUE(test::comesTrue([&] { return board.gain() == 0; }));
    output.setSilent(false);
    EXPECT_TRUE(test::comesTrue([&] { return board.gain() == half; }));
    interrupt = true; // Ctrl-C
    EXPECT_TRUE(test::comesTrue([&] { return board.gain() == 0; }));
}

TEST(BoardLinkWithAFakeBoard, AChannelThatIsMutedHasNoGain) {
    FakeBoard board{ours(), 0};
    BesideDevice played{board};
    for (const float mute : {0.0f, 1.0f, 0.0f}) {
        EXPECT_TRUE(played.session->submit(
            {RenderControl{.kind = RenderControl::Kind::mute, .channel = 0, .value = mute, .panner = {}}}));
        const int gain = mute > 0.0f ? 0 : limits::board::amplitudeUnit / 2;
        EXPECT_TRUE(test::comesTrue([&] { return played.goOn(), board.gain() == gain; })) << mute;
    }
}

// They are due in a minute, so none ends meanwhile.
TEST(BoardLinkWithAFakeBoard, NoMoreSegmentsAreSentThanItHasRoomFor) {
    FakeBoard board{ours(), 0};
    BoardLink link{board.port()};
    std::atomic<bool> isDueNow{false};
    std::atomic<int> sent{0}, refusals{0}; // refusals: since the last that was sent
    link.setFeed([&, connections = std::uint64_t{0}]() mutable {
        if (link.status().connections != connections) connections = link.status().connections, sent = 0;
        const std::int64_t now = BoardLink::nowNs(), later = now + 60'000 * ms;
        if (!link.canSendSegment(isDueNow ? now : later)) return void(++refusals);
        const auto frame = static_cast<std::int64_t>(link.frameAt(later));
        link.sendSegment({.frame = static_cast<std::uint32_t>(frame), .frames = 320}, false);
        ++sent, refusals = 0;
    });
    for (const int room : {limits::board::maxSegments - 2, limits::board::maxSegments}) {
        EXPECT_TRUE(test::comesTrue([&] { return sent > 0 && refusals > 100; }));
        EXPECT_EQ(sent, room);
        isDueNow = true, refusals = 0; // what has to be sent now may take the places that were kept free
    }
    link.setFeed({});
}

/// From A to B to D in a second, on a session beside a fake device, until the board has been told to its end.
BoardLinkStatus playPath(FakeBoard& board) {
    BesideDevice played{board};
    CollisionEvent first{.frequencyHz = 205.0, .amplitude = 0.5, .y = 4.0};
    CollisionEvent second = first;
    first.durationNs = second.timeNs = 400 * ms;
    first.course = {4.0, 4.0, first.durationNs, 0};
    first.spread = Spread::equal;
    second.x = 4.0;
    second.durationNs = 600 * ms;
    second.course = {4.0, 0.0, second.durationNs, first.durationNs};
    second.spread = Spread::equal;
    EXPECT_TRUE(played.session->submit({Strikes{std::array{first, second}}}));
    EXPECT_TRUE(test::comesTrue([&] {
        played.goOn();
        return played.session->timeline().presentNs() > 2'000 * ms;
    }));
    const auto now = played.onBoard.status();
    EXPECT_EQ(board.segments().size(), now.segments);
    EXPECT_EQ(board.strikes().size(), now.sent);
    return now;
}

TEST(BoardLinkWithAFakeBoard, WhatMovesIsOneRowOfSegments) {
    FakeBoard board{ours(), 0};
    const auto link = playPath(board);
    const auto segments = board.segments();
    EXPECT_TRUE(board.strikes().empty());
    ASSERT_GE(segments.size() + link.refused, 24u);
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const BoardSegment &before = segments[i - 1], &segment = segments[i];
        if (link.refused > 0) break; // other programs held this one up
        EXPECT_EQ(segment.frame, before.frame + before.frames) << i;
        const auto phase = static_cast<std::uint16_t>(
            before.phase16 + (static_cast<std::uint64_t>(before.turn) * before.frames >> 16));
        EXPECT_LE(std::abs(static_cast<std::int16_t>(segment.phase16 - phase)), 2)
            << i << " goes on in the phase of the one before";
    }
}

TEST(BoardLinkWithAFakeBoard, OnAnOlderBoardWhatMovesIsStillBursts) {
    auto reply = ours();
    reply.version = 1;
    FakeBoard board{reply, 0};
    const auto link = playPath(board);
    EXPECT_TRUE(board.segments().empty());
    ASSERT_GE(board.strikes().size() + link.refused + link.thinned, 17u);
    for (const auto& strike : board.strikes()) EXPECT_LE(strike.event.durationMs, 60);
}

TEST(BoardLinkWithAFakeBoard, GainsThatTheLineLosesComeAgainSoon) {
    FakeBoard board{ours(), 0};
    BoardLink link{board.port()};
    link.setGains({1.0, 1.0, 1.0, 1.0});
    ASSERT_TRUE(test::comesTrue([&] { return board.gain() != 0; }));
    board.loseGains(4);
    link.setGains({});
    ASSERT_TRUE(test::comesTrue([&] { return board.gain() == 0; }));
    EXPECT_LE(board.secondsLate(), 1) << "the fifth message, not four seconds later";
}

// What a board is sent after a stop, and what is told of it after a call.

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

} // namespace physvib::fake_board_test
