// SPDX-License-Identifier: GPL-3.0-or-later
// Waiting for a board, and what it says of itself.
#pragma once
#include "Live/Session/BoardLink.h"
#include "System/Interrupt.h"
#include <chrono>
#include <string>
#include <thread>

namespace physvib {

/// False if it does not come true in time or the user interrupts.
template <class Condition>
bool waitFor(Condition isTrue, int milliseconds) {
    for (const std::int64_t end = BoardLink::nowNs() + milliseconds * std::int64_t{1'000'000}; !isTrue();
         std::this_thread::sleep_for(std::chrono::milliseconds(5)))
        if (interrupted || BoardLink::nowNs() > end) return false;
    return true;
}

/// BoardLink::awaitReady, until the user interrupts.
std::string connectBoard(const BoardLink& link);

void printBoardInfo(const BoardLinkStatus& status);

/// One line on what was sent and played since `before`; empty, or what is wrong with the board now.
std::string reportBoard(const BoardLink& link, const wire::Telemetry& before);

} // namespace physvib
