// SPDX-License-Identifier: MIT
// Player of moving-tone segments on the four-channel board: segments that are pending or sounding.
//
// A segment keeps one phasor, as a mode of PhasorBank does, and a start and an end gain per channel, between
// which gains are interpolated. Segments are summed in order of arrival, so that a computer computes the same
// bits as the board.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/Modes/PhasorBank.h"
#include <array>
#include <cstdint>

namespace physvib {

/// All memory is inside the object. Render thread (R) only.
class MovingSegments {
public:
    static constexpr int capacity = limits::board::maxSegments;

    void clear() noexcept { count_ = 0; }
    int count() const noexcept { return count_; }

    /// False if there is no room, or if the segment ends before frame `now`, which is rendered next. A late
    /// segment is played from where it would be by then. `segment` is playable.
    bool add(const BoardSegment& segment, std::uint32_t now) noexcept;

    /// Adds all segments to the block that begins at `frame`; blocks are consecutive. Segments that have
    /// ended are removed.
    void render(std::uint32_t frame, PhasorBank::Block& io) noexcept;

private:
    struct Slot {
        std::uint32_t frame;
        std::uint16_t frames;
        Complex<float> phasor, turn; // phasor: at its first frame, or at the block's if that is later
        std::array<std::int16_t, static_cast<std::size_t>(limits::board::channels)> start, end;
    };
    static void renderSlot(Slot& slot, std::int32_t age, PhasorBank::Block& io) noexcept;

    std::array<Slot, static_cast<std::size_t>(capacity)> slots_{};
    int count_ = 0;
};

} // namespace physvib
