// SPDX-License-Identifier: MIT
// What moves on the board: legs that wait for their first frame or sound.
//
// A leg keeps one phasor, as a mode of PhasorBank does, and two gains per channel, of which a line makes
// those of each frame. They are added in the order in which they came: so it does not matter when, and a
// computer holds the same bits.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/Modes/PhasorBank.h"
#include <array>
#include <cstdint>

namespace physvib {

/// All memory is inside the object. R only.
class MovingLegs {
public:
    static constexpr int capacity = limits::board::maxLegs;

    void clear() noexcept { count_ = 0; }
    int count() const noexcept { return count_; }

    /// False if there is no room, or nothing of it lies at or after frame `now`, which is rendered next. Of a
    /// leg that is late the rest is played, as if nothing had been missed. `leg` is playable.
    bool add(const BoardLeg& leg, std::uint32_t now) noexcept;

    /// Adds them to the block that begins at `frame`, each of them right after the one before. What is over
    /// is forgotten.
    void render(std::uint32_t frame, PhasorBank::Block& io) noexcept;

private:
    struct Slot {
        std::uint32_t frame;
        std::uint16_t frames;
        Complex<float> phasor, turn; // the former at its first frame, or at the block's if that is later
        std::array<std::int16_t, static_cast<std::size_t>(limits::board::channels)> start, end;
    };
    static void renderSlot(Slot& slot, std::int32_t age, PhasorBank::Block& io) noexcept;

    std::array<Slot, static_cast<std::size_t>(capacity)> slots_{};
    int count_ = 0;
};

} // namespace physvib
