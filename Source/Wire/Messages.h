// SPDX-License-Identifier: MIT
// The messages between a computer and the four-channel board; this file alone defines their bytes.
//
// On the line: COBS( type, fields, CRC-16 of both ), then a zero. All numbers are little-endian. The format
// is append-only: later versions add fields at the end and new types; a reader ignores those that it does not
// know.
#pragma once
#include "Core/BoardEvent.h"
#include "Wire/Frames.h"
#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>

namespace physvib::wire {

constexpr std::uint8_t protocolVersion = 2; // 2: segments
constexpr std::uint8_t firstVersionWithSegments = 2;
constexpr int lineBitsPerSecond = 115200; // 8N1: 11,520 bytes a second, as the thesis' Bluetooth module
constexpr std::size_t maxPayload = 64;    // type, fields, CRC; leaves space for more telemetry
constexpr std::size_t maxFrame = cobsMaxEncoded(maxPayload) + 1;
constexpr int defaultWatchdogMs = 500;  // five pings missed: the computer is gone. A Hello cannot lengthen it
constexpr int pingsPerSecond = 10;      // also keeps the board's watchdog from muting it
constexpr int firstPingsPerSecond = 50; // until the clock is known

enum class Type : std::uint8_t {
    hello = 0x01,
    strike,
    compactStrike,
    gains,
    ping,
    telemetryRequest,
    stopAll,
    selfTest,
    segment,
    helloReply = 0x81,
    pong = 0x85,
    telemetry = 0x86,
    selfTestReply = 0x88
};

/// First message of a connection: sequence numbers restart, the board stops all sound.
struct Hello {
    static constexpr Type type = Type::hello;
    std::uint8_t version = protocolVersion;
    std::uint16_t watchdogMs = defaultWatchdogMs; ///< so long without a message it mutes itself; at most this
    void visit(auto&& field) { field(version), field(watchdogMs); }
};

/// Properties of the board.
struct HelloReply {
    static constexpr Type type = Type::helloReply;
    std::uint8_t version = protocolVersion; ///< the board's, but no later than the computer's
    std::uint8_t channels = 0;
    std::uint16_t sampleRateHz = 0, maxModes = 0, maxPending = 0;
    std::uint16_t aheadFrames = 0; ///< an event has to arrive so many frames before its onset
    std::uint16_t watchdogMs = 0;  ///< as set by Hello
    std::uint8_t crystal = 0; ///< 1: clocked by the ST-Link's crystal, 0: by the internal oscillator (1 %)
    std::uint8_t resets = 0;  ///< restarts by the hardware watchdog since power-on
    void visit(auto&& field) {
        field(version), field(channels), field(sampleRateHz), field(maxModes), field(maxPending),
            field(aheadFrames), field(watchdogMs), field(crystal), field(resets);
    }
};

/// An impact or other event. `sequence` counts events of both forms and segments. A repeated one (see
/// DuplicateFilter), or one before a Hello, is not played.
struct Strike {
    static constexpr Type type = Type::strike;
    std::uint8_t sequence = 0;
    BoardEvent event;
    void visit(auto&& field) {
        field(sequence), field(event.frame), field(event.frequency16), field(event.decay16),
            field(event.durationMs);
        for (auto& a : event.amplitudes) field(a);
    }
};

/// A Strike in 16 bytes instead of 24 on the line, for a loaded link: no duration, coarse amplitude and time.
struct CompactStrike {
    static constexpr Type type = Type::compactStrike;
    std::uint8_t sequence = 0;
    std::uint16_t frameLow = 0; ///< low bits of a frame at most four seconds away
    std::uint16_t frequency16 = 0, decay16 = 0;
    std::array<std::int8_t, limits::board::channels> amplitudes{}; ///< 1/128 of full scale
    void visit(auto&& field) {
        field(sequence), field(frameLow), field(frequency16), field(decay16);
        for (auto& a : amplitudes) field(a);
    }
};

/// A segment of a moving tone. Shares the sequence numbers of events.
struct Segment {
    static constexpr Type type = Type::segment;
    std::uint8_t sequence = 0;
    BoardSegment segment;
    void visit(auto&& field) {
        field(sequence), field(segment.frame), field(segment.turn), field(segment.frames),
            field(segment.phase16), field(segment.decay16);
        for (auto& a : segment.start) field(a);
        for (auto& a : segment.end) field(a);
    }
};

struct Gains { // of the channels
    static constexpr Type type = Type::gains;
    /// in 1/4096; negative: inverted polarity; 0: muted
    std::array<std::int16_t, limits::board::channels> gains{};
    void visit(auto&& field) {
        for (auto& g : gains) field(g);
    }
};

struct Ping { // the board answers with a Pong
    static constexpr Type type = Type::ping;
    std::uint8_t id = 0;
    void visit(auto&& field) { field(id); }
};

/// The board's clock when the last byte of the ping arrived.
struct Pong {
    static constexpr Type type = Type::pong;
    std::uint8_t id = 0;
    std::uint32_t frame = 0;   ///< at the converters
    std::uint8_t fraction = 0; ///< 1/256 frame
    void visit(auto&& field) { field(id), field(frame), field(fraction); }
};

struct TelemetryRequest { // the board answers with its Telemetry
    static constexpr Type type = Type::telemetryRequest;
    void visit(auto&&) {}
};

/// Counts since power-on; `lost` since the last Hello.
struct Telemetry {
    static constexpr Type type = Type::telemetry;
    std::uint32_t frame = 0;
    std::uint32_t good = 0, bad = 0; ///< frames of the link
    std::uint32_t lost = 0;          ///< gaps in the sequence of events and segments
    std::uint32_t overruns = 0;      ///< bytes that arrived faster than they were read
    std::uint32_t played = 0, late = 0, dropped = 0, stolen = 0;
    std::uint32_t missedFrames = 0;     ///< the converters had to repeat a frame
    std::uint32_t worstBlockCycles = 0; ///< processor cycles for one block, maximum since the last telemetry
    std::uint16_t stackFree = 0;        ///< bytes never used
    std::uint8_t modes = 0, pending = 0;
    std::uint8_t silenced = 0; ///< 1: the watchdog muted the board
    std::uint16_t guarded = 0; ///< how often the guard began to act; wraps. 0 from firmware without a guard
    static constexpr std::size_t optionalBytes = 2; ///< bytes at the end that older firmware does not send
    void visit(auto&& field) {
        field(frame), field(good), field(bad), field(lost), field(overruns), field(played), field(late),
            field(dropped), field(stolen);
        field(missedFrames), field(worstBlockCycles), field(stackFree), field(modes), field(pending),
            field(silenced);
        field(guarded);
    }
};

/// Silence at once; pending events are dropped.
struct StopAll {
    static constexpr Type type = Type::stopAll;
    void visit(auto&&) {}
};

/// Runs the kernel with all modes in use, and measures. Sounding modes are lost.
struct SelfTest {
    static constexpr Type type = Type::selfTest;
    void visit(auto&&) {}
};

struct SelfTestReply { // what SelfTest has measured
    static constexpr Type type = Type::selfTestReply;
    std::uint16_t modes = 0;
    std::uint32_t blockCycles = 0;    ///< for one block of that many modes, by the processor's cycle counter
    std::uint32_t cyclesPerBlock = 0; ///< available cycles
    std::uint32_t hash = 0;           ///< CRC-16 of the block's bits: the same on every machine
    void visit(auto&& field) { field(modes), field(blockCycles), field(cyclesPerBlock), field(hash); }
};

/// Writes numbers as bytes, least significant first.
class Writer {
public:
    explicit constexpr Writer(std::span<std::uint8_t> out)
        : out_{out} {}
    template <std::integral T>
    constexpr void operator()(T value) {
        for (std::size_t i = 0; i < sizeof(T); ++i)
            out_[size_++] = static_cast<std::uint8_t>(static_cast<std::make_unsigned_t<T>>(value) >> (8 * i));
    }
    constexpr std::size_t size() const { return size_; }

private:
    std::span<std::uint8_t> out_;
    std::size_t size_ = 0;
};

/// Reads numbers that Writer wrote. Past the end it returns zeros, and isComplete() is false.
class Reader {
public:
    explicit constexpr Reader(std::span<const std::uint8_t> in)
        : in_{in} {}
    template <std::integral T>
    constexpr void operator()(T& value) {
        std::make_unsigned_t<T> bits = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i, ++position_)
            if (position_ < in_.size())
                bits = static_cast<std::make_unsigned_t<T>>(
                    bits | static_cast<std::make_unsigned_t<T>>(in_[position_]) << (8 * i));
        value = static_cast<T>(bits);
    }
    constexpr bool isComplete(std::size_t allowedMissing = 0) const {
        return position_ <= in_.size() + allowedMissing;
    }

private:
    std::span<const std::uint8_t> in_;
    std::size_t position_ = 0;
};

/// Encodes the message for the line, with its final zero; returns the length. `out`: of maxFrame. Any thread.
template <class Message>
constexpr std::size_t encode(Message message, std::span<std::uint8_t> out) noexcept {
    std::array<std::uint8_t, maxPayload> payload{};
    Writer write{payload};
    write(static_cast<std::uint8_t>(Message::type));
    message.visit(write);
    write(crc16({payload.data(), write.size()}));
    const std::size_t end = cobsEncode({payload.data(), write.size()}, out);
    out[end] = 0;
    return end + 1;
}

/// False if `payload` (of a FrameDecoder) is another message or too short. Any thread.
template <class Message>
constexpr bool decode(std::span<const std::uint8_t> payload, Message& message) noexcept {
    if (payload.empty() || payload[0] != static_cast<std::uint8_t>(Message::type)) return false;
    Reader read{payload.subspan(1)};
    Message decoded;
    decoded.visit(read);
    std::size_t allowedMissing = 0;
    if constexpr (requires { Message::optionalBytes; }) allowedMissing = Message::optionalBytes;
    if (!read.isComplete(allowedMissing)) return false;
    message = decoded;
    return true;
}

/// Ratio of the amplitude steps of CompactStrike and Strike.
constexpr int compactStep = limits::board::amplitudeUnit / 128;

/// True if the compact form loses only precision of amplitudes, at most half a converter step. Any thread.
constexpr bool fitsCompact(const BoardEvent& e) noexcept {
    return e.durationMs == 0 && std::ranges::all_of(e.amplitudes, [](int a) {
               return a >= -128 * compactStep && a < 127 * compactStep + compactStep / 2;
           });
}

constexpr CompactStrike toCompact(const Strike& strike) noexcept {
    const BoardEvent& e = strike.event;
    CompactStrike c{strike.sequence, static_cast<std::uint16_t>(e.frame), e.frequency16, e.decay16, {}};
    for (std::size_t j = 0; j < e.amplitudes.size(); ++j)
        c.amplitudes[j] =
            static_cast<std::int8_t>(std::clamp((e.amplitudes[j] + compactStep / 2) >> 5, -128, 127));
    return c;
}

/// `now`: the reader's frame, at most four seconds from the event's.
constexpr Strike expand(const CompactStrike& c, std::uint32_t now) noexcept {
    Strike s{c.sequence, {}};
    const auto ahead = static_cast<std::int16_t>(c.frameLow - static_cast<std::uint16_t>(now));
    s.event.frame = now + static_cast<std::uint32_t>(ahead);
    s.event.frequency16 = c.frequency16;
    s.event.decay16 = c.decay16;
    for (std::size_t j = 0; j < c.amplitudes.size(); ++j)
        s.event.amplitudes[j] = static_cast<std::int16_t>(c.amplitudes[j] * compactStep);
    return s;
}
static_assert(compactStep == 1 << 5);

} // namespace physvib::wire
