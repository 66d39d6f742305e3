// SPDX-License-Identifier: MIT
// Which strikes of a line are new: a frame that comes again, at once or much later, must not be felt again.
#pragma once
#include "Core/Limits.h"
#include <cstdint>

namespace physvib::wire {

/// Of one connection, on the board. One thread.
class StrikeOrder {
public:
    /// A computer sends nothing that is 50 ms late; no line needs the rest.
    static constexpr std::int32_t mostLateFrames = limits::board::sampleRateHz / 4;

    /// False if the strike was here before. `frame`: its onset; `now`: the frame that is rendered next.
    bool isNew(std::uint8_t sequence, std::uint32_t frame, std::uint32_t now) noexcept {
        if (after(frame, now) < -mostLateFrames) return false; // the numbers have gone round since
        const auto gap = static_cast<std::uint8_t>(sequence - last_);
        const bool isBehind = gap == 0 || gap >= 128; // or so many were lost, but then it is later than all
                                                      // so far
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
