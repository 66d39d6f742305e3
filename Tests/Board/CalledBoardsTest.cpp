// SPDX-License-Identifier: GPL-3.0-or-later
// The program called with a board alone: what it heeds, what it refuses, and what the board is sent.
#include "CommandLine/Calls.h"
#include "FakeBoard.h"
#include "Live/Session/BoardOutput.h"
#include "Scene/EventsCsv.h"
#include "Scene/LayoutFile.h"
#include "Session/WallsScene.h"
#include "VirtualBoard.h"
#include <future>
#include <gtest/gtest.h>

namespace physvib::called_boards_test {

constexpr std::int64_t second = 1'000'000'000;

class CalledBoards : public test::CommandLine {
protected:
    CalledBoards() { board.count({.good = 1}); }
    /// Plays the list; returns how long that took, s.
    double play(const std::vector<CollisionEvent>& events) {
        write("list.csv", eventsCsv(events, {0.12, 0.06}, {"test", {}}));
        const std::int64_t began = BoardLink::nowNs();
        const auto left = call("board " + board.port() + " play list.csv --level 0");
        EXPECT_EQ(left.exitCode, 0) << left.err;
        return 1e-9 * static_cast<double>(BoardLink::nowNs() - began);
    }
    static CollisionEvent tone(double fromSeconds, double seconds) {
        CollisionEvent e;
        e.timeNs = static_cast<std::int64_t>(fromSeconds * second);
        e.durationNs = static_cast<std::int64_t>(seconds * second);
        e.frequencyHz = 205.0;
        e.amplitude = 0.5;
        e.x = 0.02;
        e.y = 0.05;
        return e;
    }
    FakeBoard board{ours(), 0};
};

TEST_F(CalledBoards, ABoardAloneIsASessionWithItsFilesAndControls) {
    const auto left =
        call("play shake-the-box --seconds 2 --board " + board.port() + " --record a.wav --save a.json");
    EXPECT_EQ(left.exitCode, 0) << left.err;
    EXPECT_EQ(files().size(), 3U) << "the recording, the session and its events";
    EXPECT_GT(board.strikes().size(), 10U);
    const std::int64_t began = BoardLink::nowNs();
    EXPECT_EQ(call("play shake-the-box --seconds 60 --listen </dev/null --board " + board.port()).exitCode,
              0);
    EXPECT_LT(BoardLink::nowNs() - began, 20 * second) << "standard input has ended";
}

TEST_F(CalledBoards, WhatABoardAloneCannotHeedIsRefused) {
    const std::string alone = "play drop --seconds 1 --board " + board.port();
    for (const char* option : {"--map 1,2,3,4", "--on-off 1", "--threshold 0.1", "--noise 5",
                               "--noise-db -40", "--contact-sound 5", "--marker 8", "--beats 1"})
        refuses(alone + ' ' + option, 2,
                std::string{option}.substr(0, std::string{option}.find(' ')) + ": expected a --device");
    refuses(alone + " --ceiling -6", 2, "--ceiling: a board has none");
    refuses(alone + " --ceiling 3", 2, "--ceiling: expected one number of dB");
}

TEST_F(CalledBoards, AListIsPlayedToTheEndOfItsLastTone) {
    EXPECT_GT(play({tone(0.0, 9.0), tone(0.1, 0.05)}), 9.0) << "the longest is not the last";
}

TEST_F(CalledBoards, GrainsOfAListAreSpreadAsOnADevice) {
    CollisionEvent grain = tone(0.0, 0.1);
    grain.source.kind = ContactKind::roll;
    (void)play({grain});
    ASSERT_EQ(board.strikes().size(), 1U);
    const auto layout = resolveLayout("phone4");
    ASSERT_TRUE(layout);
    PhantomPanner::Gains gains{};
    PhantomPanner{layout.value.geometry, PanningLaw::automatic, 1.0, 0.12, 0.06}.gainsAt(grain, gains);
    for (std::size_t j = 0; j < 4; ++j)
        EXPECT_EQ(board.strikes()[0].event.amplitudes[j], boardAmplitude(0.5 * gains[j])) << j;
}

TEST_F(CalledBoards, ATestThatDoesNotComeToItsEndIsNotPassed) {
    const auto ended = [this](const std::string& port, auto act) {
        const std::string command = "cd '" + folder_.string() + "'; '" PHYSVIB_PROGRAM "' board " + port +
                                    " test >.out 2>.err & echo $! >.pid; wait $!";
        auto status = std::async(std::launch::async, [&] { return std::system(command.c_str()); });
        EXPECT_TRUE(test::comesTrue([&] { return has(read(".out"), "in turn"); })) << read(".err");
        act();
        EXPECT_EQ(WEXITSTATUS(status.get()), 1);
        return read(".err");
    };
    EXPECT_EQ(ended(board.port(), [&] { kill(std::stoi(read(".pid")), SIGINT); }),
              "physvib: ended before its time\n");
    write(".out", "");
    auto other = std::make_unique<FakeBoard>(ours(), 0);
    other->count({.good = 1});
    EXPECT_EQ(ended(other->port(), [&] { other.reset(); }), "physvib: the board is gone\n");
}

/// Begins now.
struct StillClock final : OutputClock {
    StillClock() {
        setLevel(1.0f);
        publish({0, BoardLink::nowNs(), 0, 48000});
    }
};

TEST_F(CalledBoards, ATonesSecondMinuteIsPlayedToo) {
    SessionSetup setup = test::setupOfWalls();
    BoardOutput output{board.port(), setup.panner, 0.3};
    ASSERT_EQ(output.awaitReady([] { return true; }), "");
    StillClock clock;
    output.follow(&clock);
    output.onCollision(tone(0.3, 65.535));
    output.onCollision(tone(0.3, 120.0));
    CollisionEvent decayed = tone(0.3, 120.0);
    decayed.decayPerSecond = 20.0;
    output.onCollision(decayed);
    ASSERT_TRUE(test::comesTrue([&] { return board.segments().size() > 20; }));
    output.follow(nullptr);
    EXPECT_EQ(board.strikes().size(), 2U) << "what a strike can hold is one";
    const auto segments = board.segments();
    for (std::size_t i = 1; i < segments.size(); ++i) {
        EXPECT_EQ(segments[i].frame, segments[i - 1].frame + segments[i - 1].frames) << "no gap";
        EXPECT_EQ(segments[i].start, segments[0].start) << "it stays where it is";
        EXPECT_EQ(segments[i].end, segments[0].start);
    }
    EXPECT_NE(segments[0].start[0], 0);
}

} // namespace physvib::called_boards_test
