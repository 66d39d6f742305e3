// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a device still asks for blocks: what some drivers never say when it has gone.
#pragma once
#include <chrono>
#include <cstdint>

namespace physvib {

/// M.
class DeviceWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device that asks for no block for this long has gone; the longest block lasts 1.6 s (8192 frames at
    /// 5 kHz).
    static constexpr std::chrono::seconds patience{2};

    /// About once a second: whether it has gone. `blocks`: that it has asked for so far; `isIdle`: it has
    /// nothing to ask for. A look that comes later than `patience` after the one before begins anew: then the
    /// program was paused, and the device with it.
    bool hasGone(Clock::time_point now, std::uint64_t blocks, bool isIdle) noexcept {
        const bool wasAway = now - lookedAt_ > patience;
        if (blocks != blocks_ || isIdle || wasAway) movedAt_ = now;
        blocks_ = blocks;
        lookedAt_ = now;
        return now - movedAt_ > patience;
    }

    /// It had gone, and runs again, or another does.
    void lose(Clock::time_point now) noexcept {
        movedAt_ = lookedAt_ = now;
        ++losses_;
    }
    int losses() const noexcept { return losses_; }

private:
    int losses_ = 0;
    std::uint64_t blocks_ = 0;
    Clock::time_point movedAt_, lookedAt_; // of the clock's beginning, before the first look
};

} // namespace physvib
