// SPDX-License-Identifier: MIT
// Formats the counters of the link and the board as text.
#include "Live/Session/BoardWords.h"
#include "Io/Text/NumberText.h"
#include <chrono>

namespace physvib {
namespace {

using State = BoardLinkStatus::State;
constexpr std::int64_t newsWithinNs = 1'500'000'000; // telemetry is sent once a second

std::string count(std::uint64_t n) { return std::to_string(n); }

std::string whereItPlays(const BoardLinkStatus& s) {
    if (s.state == State::ready)
        return s.port + ": ready, needs " + fixedNumber(s.outputLatencyMs, 0) + " ms, " + count(s.sent) +
               " sent, " + count(s.thinned) + " thinned";
    if (!s.trouble.empty()) return s.trouble;
    return s.state == State::searching ? "looking for a board" : s.port + ": connecting";
}

std::vector<SinkState::Fact> factsOf(const BoardLinkStatus& s) {
    const auto& t = s.telemetry;
    if (s.state != State::ready) return {{"Board", s.trouble.empty() ? "looking for it" : s.trouble, true}};
    std::vector<SinkState::Fact> facts{
        {"Board", "ready, its clock " + fixedNumber(s.driftPpm, 0) + " ppm off"},
        {"Link", count(s.sent) + " sent, " + count(s.thinned) + " thinned, " + count(s.refused) + " refused",
         s.thinned + s.refused > 0}};
    if (s.segments > 0)
        facts.push_back({"What moves",
                         count(s.segments) + " segments sent, " + count(s.coarseSegments) + " of them coarse",
                         s.coarseSegments > 0});
    facts.push_back(
        {"On board",
         count(t.played) + " played, " + count(t.late) + " late, " + count(t.dropped + t.lost) + " lost",
         t.late + t.dropped + t.lost > 0});
    if (t.guarded > 0) facts.push_back({"Guard of the board", "acted " + count(t.guarded) + " times", true});
    return facts;
}

// Without a port of its own the link tries one after the other: what it says of each would only flicker.
std::string troubleOf(const BoardLinkStatus& s, const std::string& port, double latencySeconds) {
    if (s.state == State::ready) {
        if (s.outputLatencyMs <= 1e3 * latencySeconds) return {};
        return "The board needs its strikes more than " + fixedNumber(1e3 * latencySeconds, 0) +
               " ms before they are felt: some come late there";
    }
    const bool wasReady = s.connections > 0;
    if (port == anyBoard)
        return wasReady ? "The board is gone; it is looked for on every serial port"
                        : "No board answers on any serial port";
    return "The board at " + port + (wasReady ? " is gone" : " does not answer") +
           "; it is looked for twice a second" + (s.trouble.empty() ? "" : " (" + s.trouble + ")");
}

} // namespace

SinkState sinkStateOf(const BoardLinkStatus& s, const std::string& port, double latencySeconds) {
    SinkState state{"board",
                    s.state == State::ready,
                    limits::board::channels,
                    s.sent,
                    s.thinned + s.refused,
                    troubleOf(s, port, latencySeconds),
                    whereItPlays(s),
                    factsOf(s)};
    state.playsClips = false;
    return state;
}

std::string boardSummary(const BoardLink& link, const wire::Telemetry& before,
                         const std::function<bool()>& keepGoing) {
    const std::int64_t end = BoardLink::nowNs() + newsWithinNs;
    const auto seen = link.status().telemetry.frame;
    while (link.status().telemetry.frame == seen && keepGoing() && BoardLink::nowNs() <= end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto s = link.status();
    const auto& t = s.telemetry;
    std::string lines;
    if (s.segments > 0)
        lines = count(s.segments) + " segments of moving strikes, " + count(s.coarseSegments) +
                " of them longer than their law asks for, as the line was full\n";
    std::string guarded;
    if (const auto times = static_cast<std::uint16_t>(t.guarded - before.guarded); times > 0)
        guarded = ", turned down " + count(times) + " times, as it would have been nearly direct current";
    return lines + "felt " + fixedNumber(s.outputLatencyMs, 1) + " ms after the call; " + count(s.sent) +
           " strikes sent, " + count(s.thinned) + " thinned, " + count(s.refused) +
           " refused; the board played " + count(t.played - before.played) + ", " +
           count(t.late - before.late) + " late, " + count(t.dropped - before.dropped) + " dropped, " +
           count(t.lost) + " lost" + guarded + '\n';
}

} // namespace physvib
