// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib board`: connects to a board and plays events on it.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "Core/Units.h"
#include "Live/Devices/OutputMap.h"
#include "Live/Session/BoardLink.h"
#include "Live/Session/BoardOutput.h"
#include "Scene/EventsCsv.h"
#include "Scene/FieldSize.h"
#include "Scene/LayoutFile.h"
#include "System/Process.h"
#include "Wire/SelfTest.h"
#include <chrono>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

namespace physvib {
namespace {

struct BoardOptions {
    std::string port;                   ///< path, or "auto"
    std::string action;                 ///< info, play or test
    std::string eventsPath;             ///< for play
    std::string layout = "phone4";      ///< at most four actuators, in the order of the board's channels
    FieldSize field;                    ///< of the list; unset: the list's own, else the layout's extent
    double levelDb = safeStartDecibels; ///< master level of play
};

/// Waits for a condition. False on time-out or interruption by the user.
template <class Condition>
bool waitFor(Condition isTrue, std::int64_t milliseconds = 1'000'000'000) {
    for (const std::int64_t end = BoardLink::nowNs() + milliseconds * 1'000'000; !isTrue();
         std::this_thread::sleep_for(std::chrono::milliseconds(5)))
        if (interrupted || BoardLink::nowNs() > end) return false;
    return true;
}

const auto keepGoing = [] { return !interrupted; };

void printBoardInfo(const BoardLinkStatus& s) {
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

constexpr std::int64_t ms = 1'000'000;

/// Plays each channel in turn: 205 Hz for a quarter of a second at a quarter of full scale.
void playScale(BoardLink& link) {
    const std::int64_t start =
        BoardLink::nowNs() + static_cast<std::int64_t>(link.status().outputLatencyMs * 1e6) + 50 * ms;
    for (std::size_t j = 0; j < limits::board::channels; ++j) {
        std::array<double, limits::board::channels> gains{};
        gains[j] = 1.0;
        CollisionEvent tone;
        tone.frequencyHz = 205.0;
        tone.decayPerSecond = 1.0;
        tone.amplitude = 0.25;
        tone.durationNs = 250 * ms;
        link.push({start + static_cast<std::int64_t>(j) * 400 * ms, boardEventOf(tone, gains)});
    }
    waitFor([&] { return BoardLink::nowNs() > start + 1600 * ms; }, 5000);
}

int test(BoardLink& link) {
    link.requestSelfTest();
    if (!waitFor([&] { return link.status().selfTest.has_value(); }, 3000))
        return leave(exitFailed, link.status().port + ": no answer to the self-test");
    const auto reply = *link.status().selfTest;
    const auto here = std::make_unique<BoardRenderer>();
    const bool isEqual = reply.hash == wire::expectedSelfTest(*here).hash;
    std::cout << reply.modes << " modes: " << reply.blockCycles << " of " << reply.cyclesPerBlock
              << " cycles (" << std::fixed << std::setprecision(1)
              << 100.0 * reply.blockCycles / reply.cyclesPerBlock << " %); the bits are "
              << (isEqual ? "those of this computer" : "NOT those of this computer") << '\n';
    std::cout << "channels 1 to 4 in turn, 205 Hz" << std::endl;
    playScale(link);
    return isEqual ? exitDone : leave(exitFailed, link.status().port + ": the board computes other bits");
}

/// A list's time, from when the board can play its beginning.
class ListClock final : public OutputClock {
public:
    ListClock(double latencySeconds, double levelDb)
        : OutputClock{&interrupted}
        , startNs{BoardLink::nowNs() + static_cast<std::int64_t>(latencySeconds * 1e9) + 20 * ms} {
        setLevel(static_cast<float>(fromDecibels(levelDb)));
        tell({0, startNs, 0, sampleRateHz});
    }
    /// Waits for that session time; false if interrupted.
    bool await(std::int64_t timeNs) const {
        return waitFor([&] { return BoardLink::nowNs() > startNs + timeNs; });
    }
    const std::int64_t startNs;

private:
    static constexpr int sampleRateHz = 48000; // as if there were a device
};

/// Reports events outside the field. Returns false after an error line if nothing can be felt.
bool tellWhatIsFelt(const BoardOptions& o, const std::vector<CollisionEvent>& events,
                    const PhantomPanner& panner, bool isGuessed) {
    const double least = 0.5 / 127.0 / fromDecibels(o.levelDb); // that changes the converter's code
    const std::string silent = silentWords(events, panner, isGuessed, limits::maxTimeNs + 1, least);
    const std::string outside = outsideWarning(events, fieldOf(panner), isGuessed);
    if (!silent.empty())
        leave(exitFailed,
              o.eventsPath + ": nothing can be felt at --level " + numberText(o.levelDb) + ": " + silent);
    else if (!outside.empty())
        tell("warning: " + outside);
    return silent.empty();
}

/// Time until the event ends, or is 60 dB weaker: less than a step of the board's converters.
std::int64_t feltNs(const CollisionEvent& e) {
    constexpr double slowest = 1.0 / limits::board::gridPerHz;
    return e.decayPerSecond > 0.0
               ? std::min(boardLifeNs(e),
                          static_cast<std::int64_t>(7e9 / std::max(e.decayPerSecond, slowest)))
               : e.durationNs;
}

int play(const BoardOptions& o, const std::vector<CollisionEvent>& events, const PhantomPanner& panner) {
    BoardOutput output{o.port, panner};
    if (const auto trouble = output.awaitReady(keepGoing); !trouble.empty())
        return leave(exitFailed, trouble);
    ListClock clock{output.latencySeconds(), o.levelDb};
    output.follow(&clock);
    std::int64_t endNs = 0;
    for (const CollisionEvent& event : events) {
        if (!clock.await(event.timeNs - 2 * BoardLink::sendAheadMs * ms)) break;
        output.made(event);
        endNs = std::max(endNs, event.timeNs + feltNs(event));
    }
    clock.await(endNs);
    output.follow(nullptr);
    std::cout << output.summary(keepGoing);
    const SinkState state = output.state();
    return state.isReady ? exitDone
                         : leave(exitFailed, state.trouble.empty() ? "the board is gone" : state.trouble);
}

void declareBoardOptions(OptionTable& command, BoardOptions& o) {
    command.add("port", o.port, "serial port, or auto: the first on which a board answers").required();
    command.add("action", o.action, "info, play or test").required().oneOf({"info", "play", "test"});
    command.add("events", o.eventsPath, "event list to play").as("EVENTS.csv");
    command.add("--layout", o.layout, "layout of at most four actuators: preset or file");
    addField(command, o.field);
    command.add("--level", o.levelDb, "master level of play in dB").in(-90.0, 0.0);
}

int runBoard(const BoardOptions& o) {
    if ((o.action == "play") != !o.eventsPath.empty())
        return leave(exitUsage, "board: an event list goes with play, and only with it");
    std::vector<CollisionEvent> events;
    PhantomPanner panner;
    if (o.action == "play") {
        auto list = loadEventsCsv(o.eventsPath);
        if (!list) return leave(exitFailed, list.error);
        events = std::move(list.value.events);
        const auto layout = layoutNamed(o.layout);
        if (!layout) return leave(exitFailed, layout.error);
        const auto& geometry = layout.value.geometry;
        if (geometry.count > limits::board::channels)
            return leave(exitUsage, "--layout: the board has four channels, this layout " +
                                        std::to_string(geometry.count));
        const FieldSize said = o.field.isKnown() ? o.field : list.value.field;
        const FieldSize field = said.isKnown() ? said : extentOf(geometry);
        panner = {geometry, PanningLaw::automatic, 1.0, field.widthMetres, field.heightMetres};
        if (!tellWhatIsFelt(o, events, panner, !said.isKnown())) return exitFailed;
    }
    heedInterrupts();
    sayWithoutWaiting();
    if (o.action == "play") return play(o, events, panner);
    BoardLink link{o.port};
    if (const auto trouble = link.awaitReady(keepGoing); !trouble.empty()) return leave(exitFailed, trouble);
    if (o.action == "info") return printBoardInfo(link.status()), exitDone;
    link.setGains({1.0, 1.0, 1.0, 1.0});
    return test(link);
}

} // namespace

Command boardCommand() {
    return commandOf("board", "the four-channel board: info, play an event list, test", declareBoardOptions,
                     runBoard);
}

} // namespace physvib
