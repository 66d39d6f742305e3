// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for a board, and prints its status.
#pragma once
#include "Live/Session/BoardLink.h"
#include "Live/Session/BoardOutput.h"
#include "System/Interrupt.h"
#include <chrono>
#include <iomanip>
#include <iostream>
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
inline std::string connectBoard(const BoardLink& link) {
    return link.awaitReady([] { return !interrupted; });
}

inline void printBoardInfo(const BoardLinkStatus& s) {
    const auto& b = s.board;
    const auto& t = s.telemetry;
    std::cout << s.port << ": " << int(b.channels) << " channels at " << b.sampleRateHz << " Hz, "
              << b.maxModes << " modes, protocol " << int(b.version) << ", clock "
              << (b.crystal ? "72 MHz from the crystal" : "64 MHz, internal") << ", " << int(b.resets)
              << " restarts by the watchdog\n"
              << (b.version < wire::segmentsSince
                      ? "what moves is a row of still bursts on this image, an older one"
                      : "what moves is within one step of a device")
              << '\n'
              << std::fixed << std::setprecision(1) << "felt " << s.outputLatencyMs
              << " ms after the call at the earliest; drift " << s.driftPpm << " ppm\n"
              << t.played << " strikes played, " << t.late << " late, " << t.dropped << " dropped, "
              << t.stolen << " modes stolen; link: " << t.good << " good, " << t.bad << " bad, " << t.lost
              << " lost, " << t.overruns << " overruns; " << t.missedFrames << " frames missed; "
              << "guard acted " << t.guarded << " times; " << t.stackFree << " bytes of stack never used\n";
}

/// Prints one line on what was sent and played since `before`. Empty, or the board's error.
inline std::string reportBoard(const BoardLink& link, const wire::Telemetry& before) {
    std::cout << boardSummary(link, before, [] { return !interrupted; });
    const auto s = link.status();
    if (s.state == BoardLinkStatus::State::ready) return {};
    return s.trouble.empty() ? "the board is gone" : s.trouble;
}

} // namespace physvib
