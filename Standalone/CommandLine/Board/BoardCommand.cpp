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
    std::string port;                ///< path, or "auto"
    std::string action;              ///< info, play or test
    std::string eventsPath;          ///< for play
    std::string layout = "phone4";   ///< at most four actuators, in the order of the board's channels
    FieldSize field;                 ///< of the list; unset: the list's own, else the layout's extent
    double levelDb = defaultLevelDb; ///< master level of play
};

/// Waits for a condition. False on time-out or interruption by the user.
template <class Condition>
bool waitFor(Condition condition, std::int64_t maxMs = 1'000'000'000) {
    for (const std::int64_t end = BoardLink::nowNs() + maxMs * 1'000'000; !condition();
         std::this_thread::sleep_for(std::chrono::milliseconds(5)))
        if (interrupted || BoardLink::nowNs() > end) return false;
    return true;
}

const auto keepGoing = [] { return !interrupted; };

void printBoardInfo(const BoardLinkStatus& status) {
    const auto& board = status.board;
    const auto& t = status.telemetry;
    std::cout << status.port << ": " << int(board.channels) << " channels at " << board.sampleRateHz
              << " Hz, " << board.maxModes << " modes, protocol " << int(board.version) << ", clock "
              << (board.crystal ? "72 MHz from the crystal" : "64 MHz, internal") << ", " << int(board.resets)
              << " restarts by the watchdog\n"
              << (board.version < wire::firstVersionWithSegments
                      ? "what moves is a row of still bursts on this image, an older one"
                      : "what moves is within one step of a device")
              << '\n'
              << std::fixed << std::setprecision(1) << "felt " << status.outputLatencyMs
              << " ms after the call at the earliest; drift " << status.driftPpm << " ppm\n"
              << t.played << " strikes played, " << t.late << " late, " << t.dropped << " dropped, "
              << t.stolen << " modes stolen; link: " << t.good << " good, " << t.bad << " bad, " << t.lost
              << " lost, " << t.overruns << " overruns; " << t.missedFrames << " frames missed; "
              << "guard acted " << t.guarded << " times; " << t.stackFree << " bytes of stack never used\n";
}

constexpr std::int64_t nsPerMs = 1'000'000;

/// Plays each channel in turn: 205 Hz for a quarter of a second at a quarter of full scale. Returns whether
/// it came to its end.
bool playChannelsInTurn(BoardLink& link) {
    const std::int64_t start =
        BoardLink::nowNs() + static_cast<std::int64_t>(link.status().outputLatencyMs * 1e6) + 50 * nsPerMs;
    for (std::size_t j = 0; j < limits::board::channels; ++j) {
        std::array<double, limits::board::channels> gains{};
        gains[j] = 1.0;
        CollisionEvent tone;
        tone.frequencyHz = 205.0;
        tone.decayPerSecond = 1.0;
        tone.amplitude = 0.25;
        tone.durationNs = 250 * nsPerMs;
        link.push({start + static_cast<std::int64_t>(j) * 400 * nsPerMs, toBoardEvent(tone, gains)});
    }
    const auto isReady = [&] { return link.status().state == BoardLinkStatus::State::ready; };
    waitFor([&] { return BoardLink::nowNs() > start + 1600 * nsPerMs || !isReady(); }, 5000);
    return !interrupted && isReady();
}

constexpr const char* endedEarly = "ended before its time"; // as pads test says

int runSelfTest(BoardLink& link) {
    link.requestSelfTest();
    if (!waitFor([&] { return link.status().selfTest.has_value(); }, 3000))
        return reportExit(exitFailed,
                          interrupted ? endedEarly : link.status().port + ": no answer to the self-test");
    const auto reply = *link.status().selfTest;
    const auto renderer = std::make_unique<BoardRenderer>();
    const bool isEqual = reply.hash == wire::expectedSelfTest(*renderer).hash;
    std::cout << reply.modes << " modes: " << reply.blockCycles << " of " << reply.cyclesPerBlock
              << " cycles (" << std::fixed << std::setprecision(1)
              << 100.0 * reply.blockCycles / reply.cyclesPerBlock << " %); the bits are "
              << (isEqual ? "those of this computer" : "NOT those of this computer") << '\n';
    std::cout << "channels 1 to 4 in turn, 205 Hz" << std::endl;
    if (!playChannelsInTurn(link))
        return reportExit(exitFailed, interrupted ? endedEarly : "the board is gone");
    return isEqual ? exitDone
                   : reportExit(exitFailed, link.status().port + ": the board computes other bits");
}

/// Clock of an event list: its time is 0 when the board can play its first event at the earliest.
class ListClock final : public OutputClock {
public:
    ListClock(double latencySeconds, double levelDb)
        : OutputClock{&interrupted}
        , startNs{BoardLink::nowNs() + static_cast<std::int64_t>(latencySeconds * 1e9) + 20 * nsPerMs} {
        setLevel(static_cast<float>(fromDecibels(levelDb)));
        publish({0, startNs, 0, sampleRateHz});
    }
    /// Waits for that session time; false if interrupted.
    bool waitUntil(std::int64_t timeNs) const {
        return waitFor([&] { return BoardLink::nowNs() > startNs + timeNs; });
    }
    const std::int64_t startNs;

private:
    static constexpr int sampleRateHz = 48000; // as if there were a device
};

/// Reports events outside the field. Returns false after an error line if nothing can be felt.
bool checkPlayable(const BoardOptions& o, const std::vector<CollisionEvent>& events,
                   const PhantomPanner& panner, bool isFieldGuessed) {
    const double minAmplitude = 0.5 / 127.0 / fromDecibels(o.levelDb); // half a step of the converter
    const std::string silenceText =
        silenceReason(events, panner, isFieldGuessed, limits::maxTimeNs + 1, minAmplitude);
    const std::string outsideText = outsideFieldWarning(events, fieldOf(panner), isFieldGuessed);
    if (!silenceText.empty())
        reportExit(exitFailed, o.eventsPath + ": nothing can be felt at --level " + numberText(o.levelDb) +
                                   ": " + silenceText);
    else if (!outsideText.empty())
        printMessage("warning: " + outsideText);
    return silenceText.empty();
}

/// Time until the event ends, or is 60 dB weaker: less than a step of the board's converters.
std::int64_t lifetimeNs(const CollisionEvent& e) {
    constexpr double minDecayPerSecond = 1.0 / limits::board::gridPerHz;
    return e.decayPerSecond > 0.0
               ? std::min(boardLifetimeNs(e),
                          static_cast<std::int64_t>(7e9 / std::max(e.decayPerSecond, minDecayPerSecond)))
               : e.durationNs;
}

int playEvents(const BoardOptions& o, const std::vector<CollisionEvent>& events,
               const PhantomPanner& panner) {
    BoardOutput output{o.port, panner};
    if (const auto error = output.awaitReady(keepGoing); !error.empty()) return reportExit(exitFailed, error);
    ListClock clock{output.latencySeconds(), o.levelDb};
    output.follow(&clock);
    std::int64_t endNs = 0;
    for (const CollisionEvent& event : events) {
        if (!clock.waitUntil(event.timeNs - 2 * BoardLink::sendAheadMs * nsPerMs)) break;
        output.onCollision(event);
        endNs = std::max(endNs, event.timeNs + lifetimeNs(event));
    }
    clock.waitUntil(endNs);
    output.follow(nullptr);
    std::cout << output.summary(keepGoing);
    const SinkState state = output.state();
    return state.isReady ? exitDone
                         : reportExit(exitFailed, state.error.empty() ? "the board is gone" : state.error);
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
        return reportExit(exitUsage, "board: an event list goes with play, and only with it");
    std::vector<CollisionEvent> events;
    PhantomPanner panner;
    if (o.action == "play") {
        auto list = loadEventsCsv(o.eventsPath);
        if (!list) return reportExit(exitFailed, list.error);
        events = std::move(list.value.events);
        const auto layout = resolveLayout(o.layout);
        if (!layout) return reportExit(exitFailed, layout.error);
        const auto& geometry = layout.value.geometry;
        if (geometry.count > limits::board::channels)
            return reportExit(exitUsage, "--layout: the board has four channels, this layout " +
                                             std::to_string(geometry.count));
        const FieldSize statedField = o.field.isKnown() ? o.field : list.value.field;
        const FieldSize field = statedField.isKnown() ? statedField : extentOf(geometry);
        panner = {geometry, PanningLaw::automatic, 1.0, field.widthMetres, field.heightMetres};
        if (!checkPlayable(o, events, panner, !statedField.isKnown())) return exitFailed;
    }
    installInterruptHandlers();
    beginNonBlockingOutput();
    if (o.action == "play") return playEvents(o, events, panner);
    BoardLink link{o.port};
    if (const auto error = link.awaitReady(keepGoing); !error.empty()) return reportExit(exitFailed, error);
    if (o.action == "info") return printBoardInfo(link.status()), exitDone;
    link.setGains({1.0, 1.0, 1.0, 1.0});
    return runSelfTest(link);
}

} // namespace

Command boardCommand() {
    return makeCommand("board", "the four-channel board: info, play an event list, test", declareBoardOptions,
                       runBoard);
}

} // namespace physvib
