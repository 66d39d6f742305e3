// SPDX-License-Identifier: MIT
// A virtual board on the bench: messages to it in time, its answers, and what its renderer holds.
#pragma once
#include "Support/BoardReference.h"
#include "VirtualBoard.h"
#include "Wire/FrameDecoder.h"
#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace physvib::test {

template <class Message>
std::vector<std::uint8_t> framed(const Message& message) {
    std::vector<std::uint8_t> frame(wire::maxFrame);
    frame.resize(wire::encode(message, frame));
    return frame;
}

class Rig {
public:
    explicit Rig(const std::string& image = PHYSVIB_BOARD_IMAGE,
                 virtualboard::CostModel model = virtualboard::CostModel::optimistic, bool hasCrystal = true)
        : image_{virtualboard::readElf(image)}
        , board{image_, model, hasCrystal} {}

private:
    virtualboard::ElfImage image_;

public:
    virtualboard::VirtualBoard board;

    void start() { board.runUntil(board.seconds() + 0.01); }

    /// Waits for the board to start, says hello; its answer. Throws if there is none.
    wire::HelloReply connect(int watchdogMs = wire::defaultWatchdogMs) {
        start();
        return *ask<wire::HelloReply>(
            wire::Hello{wire::protocolVersion, static_cast<std::uint16_t>(watchdogMs)});
    }

    template <class Message>
    void send(const Message& message) {
        sentAt_ = board.seconds();
        board.send(framed(message));
    }

    /// Sends and waits up to `seconds` for an answer of this type.
    template <class Reply, class Message>
    std::optional<Reply> ask(const Message& message, double seconds = 0.1) {
        send(message);
        for (const double end = board.seconds() + seconds; board.seconds() < end;) {
            board.runUntil(board.seconds() + 0.001);
            if (auto reply = next<Reply>()) return reply;
        }
        throw std::runtime_error("the board does not answer");
    }

    /// The next message of this type that has come; others are skipped.
    template <class Reply>
    std::optional<Reply> next() {
        std::optional<Reply> found;
        for (const auto& byte : board.received())
            if (Reply reply; wire::decode(decoder_.feed(byte.value), reply)) found = reply;
        return found;
    }

    wire::Telemetry telemetry() { return *ask<wire::Telemetry>(wire::TelemetryRequest{}); }

    /// The frame that is played next.
    std::uint32_t frame() { return static_cast<std::uint32_t>(board.peripherals().frames.size()); }
    std::vector<BoardFrame>& codes() { return board.peripherals().frames; }

    /// Sends the events 60 ms before their onsets, or as the line lets them, and plays to frame `end`.
    void play(const std::vector<BoardEvent>& events, std::uint32_t end, bool compact = false) {
        for (const BoardEvent& event : events) {
            runTo(static_cast<double>(event.frame) - 480.0);
            const wire::Strike strike{++sequence_, event};
            if (compact)
                send(wire::toCompact(strike));
            else
                send(strike);
        }
        runTo(end);
    }

    /// The same with segments of what moves, 20 ms before their onsets, as the board holds only a few.
    void play(const std::vector<BoardEvent>& events, const std::vector<BoardSegment>& segments,
              std::uint32_t end, bool compact = false) {
        auto event = events.begin();
        for (const BoardSegment& segment : segments) {
            const auto next = std::find_if(event, events.end(), [&](const BoardEvent& e) {
                return e.frame - 480 > segment.frame - 160;
            });
            play({event, next}, segment.frame - 160, compact);
            event = next;
            send(wire::Segment{++sequence_, segment});
        }
        play({event, events.end()}, end, compact);
    }

    /// Runs until this frame is played, and keeps in touch meanwhile.
    void runTo(double frame) {
        constexpr double patience = 0.4; // less than the board's
        while (this->frame() < frame) {
            if (board.seconds() > sentAt_ + 0.9 * patience) send(wire::Ping{});
            board.runUntil(board.seconds() +
                           std::clamp((frame - this->frame()) / 8000, 0.0001, 0.1 * patience));
        }
    }

    /// The renderer in the board's memory, between two blocks.
    BoardRenderer renderer() {
        while (!board.isAsleep()) board.runUntil(board.seconds() + 0.00001);
        const auto symbol = image_.findSymbol("rendererMemory");
        static_assert(std::is_trivially_copyable_v<BoardRenderer>);
        if (symbol.size != sizeof(BoardRenderer))
            throw std::runtime_error("the renderer has another layout on the board");
        const auto bytes = board.memory(symbol.address, symbol.size);
        BoardRenderer copy;
        std::memcpy(static_cast<void*>(&copy), bytes.data(), bytes.size());
        return copy;
    }

    const virtualboard::ElfImage& image() const { return image_; }

private:
    wire::FrameDecoder decoder_;
    std::uint8_t sequence_ = 0xFF;
    double sentAt_ = 0.0;
};

/// True if the modes hold the same bits.
inline bool sameModes(const PhasorBank& a, const PhasorBank& b) {
    if (a.liveModes() != b.liveModes()) return false;
    for (int i = 0; i < a.liveModes(); ++i)
        if (std::memcmp(&a.mode(i), &b.mode(i), sizeof(PhasorBank::Mode)) != 0) return false;
    return true;
}

/// What separates a board from this computer's renderer after the same list.
struct Parity {
    std::size_t frames = 0, differing = 0; ///< frames with another code on any channel
    bool sameState = false;
    int worstFromClosedForm = 0;
    int worstGivenLeft = 0; ///< the same, where the closed form's guard decides from what left the board
    std::uint32_t episodes = 0, exactEpisodes = 0; ///< of the guard, on the board and in the closed form
    long timingViolations = 0;
    wire::Telemetry telemetry;
};

/// Plays a random list on both.
inline Parity comparePlay(Rig& rig, const BoardListSettings& list, std::uint32_t seed, std::uint32_t frames,
                          bool compact = false) {
    rig.connect();
    auto events = randomBoardEvents(list, seed);
    if (compact)
        for (auto& e : events) e = wire::expand(wire::toCompact({0, e}), e.frame).event;
    rig.play(events, frames, compact);
    Parity parity;
    parity.telemetry = rig.telemetry();
    const BoardRenderer onBoard = rig.renderer();
    BoardRenderer here;
    here.prepare();
    auto codes = renderBoardEvents(here, events, onBoard.frame());
    parity.episodes = onBoard.guard().episodes();
    parity.sameState = here.frame() == onBoard.frame() && sameModes(here.bank(), onBoard.bank()) &&
                       here.guard().gain() == onBoard.guard().gain() &&
                       here.guard().episodes() == parity.episodes;
    const auto& played = rig.codes();
    parity.frames = std::min(played.size(), codes.size());
    for (std::size_t n = 0; n < parity.frames; ++n) parity.differing += codes[n] != played[n] ? 1 : 0;
    auto left = played;
    left.resize(parity.frames);
    ReferenceGuard guard, fromLeft{true, &left};
    parity.worstFromClosedForm = worstDifference(left, boardClosedForm(events, parity.frames, guard));
    parity.exactEpisodes = guard.episodes;
    parity.worstGivenLeft = worstDifference(left, boardClosedForm(events, parity.frames, fromLeft));
    parity.timingViolations = rig.board.peripherals().converters.observedTimes().violations;
    return parity;
}

} // namespace physvib::test
