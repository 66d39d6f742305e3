// SPDX-License-Identifier: MIT
// When hands feel a moment of the session, on the computer's steady clock: from the times at which a device
// asks for blocks.
//
// A driver asks for a block when there is room for it, never earlier, and often a little later. So the
// earliest of the last calls, for the time that it asked for, is the device's clock; a mean would lag by how
// busy the computer is. A quarter to half a second of calls is looked at: 300 ppm of drift are then 0.15 ms
// at most.
#pragma once
#include "Live/Session/FeltOutput.h"
#include <algorithm>
#include <cstdint>

namespace physvib {

/// One thread.
class FeltClock {
public:
    static constexpr std::int64_t halfWindowNs = 250'000'000;

    /// Moments in the order of time; the same again changes nothing.
    void add(const FeltMoment& moment) noexcept {
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

    /// When `sessionNs` is felt; only if ready.
    std::int64_t steadyAt(std::int64_t sessionNs) const noexcept {
        return sessionNs + std::min(before_, now_);
    }

private:
    std::int64_t before_ = 0, now_ = 0; // least lag of the last half window and of the one that runs
    std::int64_t halfBeganNs_ = 0;
    bool isReady_ = false;
};

} // namespace physvib
