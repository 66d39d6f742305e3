// SPDX-License-Identifier: MIT
// The events that the four-channel vibration board plays: impacts, and segments of moving tones. They are
// already panned, timed in frames of the board's clock, and quantised to the link's fixed-point units.
#pragma once
#include "Core/Limits.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstdint>
#include <numbers>

namespace physvib {

namespace limits::board {
constexpr int maxSegments = 8; // 40 bytes each: of four moving tones, the sounding segment and the next
}

/// x_j(n) = a_j sin(2 pi f k / rate) exp(-tau k / rate), k = n - frame, k >= 0 (Eq. 5.1 on the board's grid).
struct BoardEvent {
    std::uint32_t frame = 0;       ///< onset, in frames of the board's clock; wraps after six days
    std::uint16_t frequency16 = 0; ///< f in 1/16 Hz, below half the sample rate
    std::uint16_t decay16 = 0;     ///< tau in 1/16 per second
    std::uint16_t durationMs = 0;  ///< 0: until it has decayed; else it is cut after this time
    std::array<std::int16_t, limits::board::channels> amplitudes{}; ///< a_j in 1/4096 of full scale
    bool operator==(const BoardEvent&) const = default;
};

/// True if the board can play the event: its frequency is below half the sample rate, and a decay or a
/// duration ends it. Any thread.
constexpr bool isPlayable(const BoardEvent& e) noexcept {
    constexpr int nyquist16 = limits::board::sampleRateHz / 2 * limits::board::gridPerHz;
    return e.frequency16 > 0 && e.frequency16 < nyquist16 && (e.decay16 > 0 || e.durationMs > 0);
}

/// A segment of a moving tone: x_j(n) = (start_j + (end_j - start_j) k / (frames - 1)) sin(2 pi (phase + turn
/// k)) exp(-tau k / rate), k = n - frame, for `frames` frames. A segment does not depend on the one before,
/// because that one may be lost on the link.
struct BoardSegment {
    std::uint32_t frame = 0; ///< first frame, in frames of the board's clock; wraps
    std::uint32_t turn = 0;  ///< phase advance per frame, in turns / 2^32: segments join in phase
    std::uint16_t frames = 0;
    std::uint16_t phase16 = 0; ///< at the first frame, in turns / 2^16
    std::uint16_t decay16 = 0; ///< tau in 1/16 per second
    /// amplitude at the first and at the last frame, in 1/4096 of full scale
    std::array<std::int16_t, limits::board::channels> start{}, end{};
    bool operator==(const BoardSegment&) const = default;
};

/// True if the board can play the segment: its frequency is below half the sample rate, and it has at least
/// one frame. Any thread.
constexpr bool isPlayable(const BoardSegment& segment) noexcept {
    return segment.frames > 0 && segment.turn < 0x8000'0000u;
}

/// The decay per frame of a `decay16` of the link, in octaves / 2^56. Any thread.
constexpr std::int64_t boardOctaves(std::uint16_t decay16) noexcept {
    constexpr auto perStep = static_cast<std::int64_t>(
        octaveUnit * std::numbers::log2e * (1.0 / (limits::board::gridPerHz * limits::board::sampleRateHz)));
    return perStep * decay16;
}

} // namespace physvib
