// SPDX-License-Identifier: GPL-3.0-or-later
// A link's status as text.
#include "CommandLine/Board/BoardStatus.h"
#include <iomanip>
#include <iostream>

namespace physvib {

std::string connectBoard(const BoardLink& link) {
    return link.awaitReady([] { return !interrupted; });
}

void printBoardInfo(const BoardLinkStatus& s) {
    const auto& b = s.board;
    const auto& t = s.telemetry;
    std::cout << s.port << ": " << int(b.channels) << " channels at " << b.sampleRateHz << " Hz, " << b.maxModes << " modes, protocol " << int(b.version) << ", clock "
              << (b.crystal ? "72 MHz from the crystal" : "64 MHz, internal") << ", " << int(b.resets) << " restarts by the watchdog\n"
              << (b.version < wire::legsSince ? "what moves is a row of still bursts on this image, an older one" : "what moves is within one step of a device") << '\n'
              << std::fixed << std::setprecision(1) << "felt " << s.playOutMs << " ms after the call at the earliest; drift " << s.driftPpm << " ppm\n"
              << t.played << " strikes played, " << t.late << " late, " << t.dropped << " dropped, " << t.stolen << " modes stolen; link: " << t.good << " good, " << t.bad
              << " bad, " << t.lost << " lost, " << t.overruns << " overruns; " << t.missedFrames << " frames missed; " << t.stackFree << " bytes of stack never used\n";
}

std::string reportBoard(const BoardLink& link, const wire::Telemetry& before) {
    waitFor([&, seen = link.status().telemetry.frame] { return link.status().telemetry.frame != seen; }, 1500);
    const auto s = link.status();
    if (s.legs > 0) std::cout << s.legs << " legs of what moves, " << s.coarseLegs << " of them longer than their law asks for, as the line was full\n";
    std::cout << std::fixed << std::setprecision(1) << "felt " << s.playOutMs << " ms after the call; " << s.sent << " strikes sent, " << s.thinned << " thinned, " << s.refused
              << " refused; the board played " << s.telemetry.played - before.played << ", " << s.telemetry.late - before.late << " late, " << s.telemetry.dropped - before.dropped
              << " dropped, " << s.telemetry.lost << " lost\n";
    if (s.state == BoardLinkStatus::State::ready) return {};
    return s.trouble.empty() ? "the board is gone" : s.trouble;
}

} // namespace physvib
