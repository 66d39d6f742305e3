// SPDX-License-Identifier: MIT
// Detects that a device has stopped asking for blocks, because some drivers do not report that a device has
// gone.
#pragma once
#include "Live/Session/DevicePulse.h"
#include <chrono>
#include <cstdint>

namespace physvib {

/// M.
class DeviceWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device that asks for no block during this time counts as gone; the longest block lasts 1.6 s (8192
    /// frames at 5 kHz).
    static constexpr std::chrono::nanoseconds patience{DevicePulse::goneNs};

    /// Whether the device has gone; call about once a second. `blocks`: number the device has asked for so
    /// far. `isIdle`: the device has no reason to ask. If more than `patience` passed since the last call,
    /// the program was paused together with the device, and the watch restarts.
    bool hasGone(Clock::time_point now, std::uint64_t blocks, bool isIdle) noexcept {
        const bool wasAway = now - lookedAt_ > patience;
        if (blocks != blocks_ || isIdle || wasAway) movedAt_ = now;
        blocks_ = blocks;
        lookedAt_ = now;
        return now - movedAt_ > patience;
    }

    /// Counts a loss, and watches the device that runs now.
    void lose(Clock::time_point now) noexcept {
        movedAt_ = lookedAt_ = now;
        ++losses_;
    }
    int losses() const noexcept { return losses_; }

private:
    int losses_ = 0;
    std::uint64_t blocks_ = 0;
    Clock::time_point movedAt_, lookedAt_; // zero before the first call
};

} // namespace physvib
