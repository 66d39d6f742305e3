// SPDX-License-Identifier: MIT
// Renderer of the four-channel vibration board: events in, codes of its digital-to-analogue converters out.
// The board's firmware compiles these files; on a computer they are the reference for the board's output.
//
// Order of one block: the modes are summed; events that are due are added; segments of moving tones are
// added; each channel passes its gain; a limiter with one gain for all channels cuts what exceeds full scale
// at once and recovers within limits::limiterReleaseSeconds, so that a phantom stays in place; the guard
// turns down slow signal parts that would only warm a coil; the codes saturate.
#pragma once
#include "Core/Actuators/BoardGuard.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/BoardEvent.h"
#include "Core/Modes/MovingSegments.h"
#include "Core/Modes/PhasorBank.h"
#include "Core/TimeOrdered.h"
#include <array>
#include <cstdint>
#include <limits>

namespace physvib {

/// Counts since prepare, and the state after the last block.
struct BoardStatus {
    std::uint32_t played = 0;  ///< events started, segments accepted
    std::uint32_t late = 0;    ///< of these: after their time. A late event starts at once; a late segment
                               ///< starts at the phase and gain that it has by then
    std::uint32_t dropped = 0; ///< events that are not playable, or that found the pending store full
    std::uint32_t stolen = 0;  ///< modes ended early to make room for another
    int modes = 0;
    int pending = 0;
};

/// All memory is inside the object. Render thread (R) only.
class BoardRenderer {
public:
    static constexpr int channels = PhasorBank::channels;
    static constexpr int blockFrames = PhasorBank::blockFrames;
    static constexpr std::uint8_t midScale = 128;
    using Codes = std::array<std::array<std::uint8_t, static_cast<std::size_t>(channels)>,
                             static_cast<std::size_t>(blockFrames)>;
    using Gains = std::array<float, static_cast<std::size_t>(channels)>;

    /// Silence at frame 0, all gains 1.
    void prepare() noexcept;

    /// False, and counted as dropped, if the event is not playable or the pending store is full. Events of
    /// one frame keep their order.
    bool schedule(const BoardEvent& event) noexcept;
    bool schedule(const BoardSegment& segment) noexcept;

    /// Gains per channel, reached within limits::channelRampSeconds. Negative gains invert the polarity, 0
    /// mutes.
    void setGains(const Gains& gains) noexcept;

    /// Ends all modes and segments and discards pending events, from the next block on. The caller fades what
    /// the converters still hold.
    void stopAll() noexcept;

    /// The guard does not act on the next block: for a block that is not sent to the actuators (self-test).
    void letThrough() noexcept { guard_.letThrough(); }

    /// Renders the next block.
    void render(Codes& out) noexcept;

    /// First frame of the next block.
    std::uint32_t frame() const noexcept { return static_cast<std::uint32_t>(frame_); }
    BoardStatus status() const noexcept;
    const PhasorBank& bank() const noexcept { return bank_; }
    const BoardGuard& guard() const noexcept { return guard_; }

private:
    void strikeDue(PhasorBank::Block& io) noexcept;
    void limit(PhasorBank::Block& io) noexcept;
    void encode(const PhasorBank::Block& block, Codes& out) noexcept;

    PhasorBank bank_;
    MovingSegments segments_;
    TimeOrdered<BoardEvent, limits::board::maxPending> pending_;
    std::array<GainRamp, static_cast<std::size_t>(channels)> gains_{};
    float linkedGain_ = 1.0f;
    BoardGuard guard_;
    std::int64_t frame_ = 0; // does not wrap, so that pending events keep their order
    static constexpr auto never = std::numeric_limits<std::int64_t>::max();
    std::int64_t nextDue_ = never; // due time of the first pending event; kept here because every block
                                   // compares it
    std::uint32_t played_ = 0, late_ = 0, dropped_ = 0;
};

} // namespace physvib
