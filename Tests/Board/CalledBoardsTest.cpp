// SPDX-License-Identifier: GPL-3.0-or-later
// The program called with a board alone: what it heeds, what it refuses, and what the board is sent.
#include "CommandLine/Calls.h"
#include "FakeBoard.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr std::int64_t second = 1'000'000'000;

class CalledBoards : public test::CommandLine {
protected:
    CalledBoards() { board.count({.good = 1}); }
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

} // namespace
} // namespace physvib
