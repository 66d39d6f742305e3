// SPDX-License-Identifier: MIT
// Detects repeated event messages on the board link, so that an event is not played twice.
#pragma once
#include "Core/Limits.h"
#include <cstdint>

namespace physvib::wire {

/// For one connection, on the board. One thread.
class StrikeOrder {
public:
    /// A computer sends nothing later than 50 ms; the rest is margin.
    static constexpr std::int32_t mostLateFrames = limits::board::sampleRateHz / 4;

    /// False if the event was received before. `frame`: its onset; `now`: the frame that is rendered next.
    bool isNew(std::uint8_t sequence, std::uint32_t frame, std::uint32_t now) noexcept {
        if (after(frame, now) < -mostLateFrames) return false; // sequence numbers may have wrapped
        const auto gap = static_cast<std::uint8_t>(sequence - last_);
        const bool isBehind = gap == 0 || gap >= 128; // or that many were lost, but then its onset is later
                                                      // than all so far
        if (isBehind && hasNewest_ && after(frame, newest_) <= 0) return false;
        lost_ += static_cast<std::uint8_t>(gap - 1);
        last_ = sequence;
        if (!hasNewest_ || after(frame, newest_) > 0) newest_ = frame;
        hasNewest_ = true;
        return true;
    }

    std::uint32_t lost() const noexcept { return lost_; } ///< gaps in the sequence

private:
    static constexpr std::int32_t after(std::uint32_t a, std::uint32_t b) noexcept {
        return static_cast<std::int32_t>(a - b);
    }
    std::uint32_t lost_ = 0, newest_ = 0;
    std::uint8_t last_ = 0xFF;
    bool hasNewest_ = false;
};

} // namespace physvib::wire
