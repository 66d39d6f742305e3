// SPDX-License-Identifier: MIT
// Estimates when a session time is felt, on the computer's steady clock, from the times at which a device
// requests blocks.
//
// A driver requests a block when there is room for it: never earlier, often a little later. So the earliest
// of the recent requests, relative to the time that it requested, represents the device's clock; a mean would
// lag by the computer's load. The window is a quarter to half a second: 300 ppm of drift are then at most
// 0.15 ms.
#pragma once
#include "Live/Session/OutputClock.h"
#include <algorithm>
#include <cstdint>

namespace physvib {

/// One thread.
class SessionClock {
public:
    static constexpr std::int64_t halfWindowNs = 250'000'000;

    /// In time order; repeating a moment changes nothing.
    void add(const OutputMoment& moment) noexcept {
        const std::int64_t lag = moment.steadyNs - moment.sessionNs, age = moment.steadyNs - halfBeganNs_;
        // the first, or the first after a pause
        if (!isReady_ || age > 2 * halfWindowNs) before_ = now_ = lag;
        if (!isReady_ || age > halfWindowNs) {
            before_ = now_;
            now_ = lag;
            halfBeganNs_ = moment.steadyNs;
        }
        now_ = std::min(now_, lag);
        isReady_ = true;
    }

    bool isReady() const noexcept { return isReady_; }

    /// Steady time at which `sessionNs` is felt; only if ready.
    std::int64_t steadyAt(std::int64_t sessionNs) const noexcept {
        return sessionNs + std::min(before_, now_);
    }

private:
    std::int64_t before_ = 0, now_ = 0; // smallest lag of the last half window and of the current one
    std::int64_t halfBeganNs_ = 0;
    bool isReady_ = false;
};

} // namespace physvib
