// SPDX-License-Identifier: MIT
// All that the four-channel board computes: events in, codes of its converters out. The board runs these very
// files; on a computer they are what the board is held against.
//
// Order of one block: the modes are summed; events that are due are struck into it; legs of what moves are
// added; each channel goes through its gain; one gain for all channels takes at once what exceeds full scale
// and comes back within limits::limiterReleaseSeconds, so that a phantom stays where it is; the guard turns
// down what would only warm a coil; the codes saturate.
#pragma once
#include "Core/Actuators/BoardGuard.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/BoardEvent.h"
#include "Core/Modes/MovingLegs.h"
#include "Core/Modes/PhasorBank.h"
#include "Core/TimeOrdered.h"
#include <array>
#include <cstdint>
#include <limits>

namespace physvib {

/// Counts since prepare, and the state after the last block.
struct BoardStatus {
    std::uint32_t played = 0; ///< events struck, legs taken
    std::uint32_t late = 0; ///< of these: after their time; a strike at once, a leg from where it is by then
    std::uint32_t dropped = 0; ///< not playable, or too many waiting
    std::uint32_t stolen = 0;  ///< modes that made room
    int modes = 0;
    int pending = 0;
};

/// All memory is inside the object. R only.
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

    /// False, and counted, if the event is not playable or too many wait. Events of one frame keep their
    /// order.
    bool schedule(const BoardEvent& event) noexcept;
    bool schedule(const BoardLeg& leg) noexcept;

    /// Within limits::channelRampSeconds. Negative gains turn the polarity, 0 mutes.
    void setGains(const Gains& gains) noexcept;

    /// Nothing sounds, nothing waits, from the next block on. (Whoever owns the converters fades what they
    /// hold.)
    void stopAll() noexcept;

    /// The guard lets the next block through as it is: for one that does not leave (the self-test's).
    void letThrough() noexcept { guard_.letThrough(); }

    /// The next block.
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
    MovingLegs legs_;
    TimeOrdered<BoardEvent, limits::board::maxPending> pending_;
    std::array<GainRamp, static_cast<std::size_t>(channels)> gains_{};
    float linkedGain_ = 1.0f;
    BoardGuard guard_;
    std::int64_t frame_ = 0; // does not wrap, so that waiting events keep their order
    static constexpr auto never = std::numeric_limits<std::int64_t>::max();
    std::int64_t nextDue_ = never; // when the first of those that wait is due: asked in every block
    std::uint32_t played_ = 0, late_ = 0, dropped_ = 0;
};

} // namespace physvib
