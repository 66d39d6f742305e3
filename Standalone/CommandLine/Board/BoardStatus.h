// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for a board, and prints its status.
#pragma once
#include "Live/Session/BoardLink.h"
#include "System/Interrupt.h"
#include <chrono>
#include <string>
#include <thread>

namespace physvib {

/// Waits for a condition. False on time-out or interruption by the user.
template <class Condition>
bool waitFor(Condition isTrue, int milliseconds) {
    for (const std::int64_t end = BoardLink::nowNs() + milliseconds * std::int64_t{1'000'000}; !isTrue();
         std::this_thread::sleep_for(std::chrono::milliseconds(5)))
        if (interrupted || BoardLink::nowNs() > end) return false;
    return true;
}

/// BoardLink::awaitReady, cancelled by the user's interrupt.
std::string connectBoard(const BoardLink& link);

void printBoardInfo(const BoardLinkStatus& status);

/// Prints one line on what was sent and played since `before`. Empty, or the board's error.
std::string reportBoard(const BoardLink& link, const wire::Telemetry& before);

} // namespace physvib
