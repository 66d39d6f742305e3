// SPDX-License-Identifier: MIT
// One collision as the four-channel board plays it: already panned, on the board's frames, in the numbers of the link.
#pragma once
#include "Core/Limits.h"
#include <array>
#include <cstdint>

namespace physvib {

/// x_j(n) = a_j sin(2 pi f k / rate) exp(-tau k / rate), k = n - frame, from k = 0 on (Eq. 5.1 on the board's grid).
struct BoardEvent {
    std::uint32_t frame = 0;       ///< onset, in frames of the board's clock; wraps after six days
    std::uint16_t frequency16 = 0; ///< f in 1/16 Hz, below half the sample rate
    std::uint16_t decay16 = 0;     ///< tau in 1/16 per second
    std::uint16_t durationMs = 0;  ///< 0: until it has decayed; else it is cut after this time
    std::array<std::int16_t, limits::board::channels> amplitudes{}; ///< a_j in 1/4096 of full scale
    bool operator==(const BoardEvent&) const = default;
};

/// True if the board can play it: below half the sample rate, and sure to end. Any thread.
constexpr bool isPlayable(const BoardEvent& e) noexcept {
    constexpr int nyquist16 = limits::board::sampleRateHz / 2 * limits::board::gridPerHz;
    return e.frequency16 > 0 && e.frequency16 < nyquist16 && (e.decay16 > 0 || e.durationMs > 0);
}

} // namespace physvib
