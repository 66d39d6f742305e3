// SPDX-License-Identifier: MIT
// Splits a moving tone into a series of short stationary events for a board of protocol 1, whose events have
// one amplitude per channel. Newer boards play segments (BoardPath).
#pragma once
#include "Core/CollisionEvent.h"
#include "Wire/BoardStrike.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib {

/// In time order. Each lasts whole milliseconds, as the link counts them, and nearly whole periods, because
/// each begins at phase 0 on the board. Any thread.
class BoardSteps {
public:
    static constexpr int leastMs = 20, mostMs = 60; ///< fewer than 50 per second, of the 720 that the line
                                                    ///< transmits

    explicit BoardSteps(const CollisionEvent& moving) noexcept
        : moving_{moving}
        , stepNs_{lengthMs(moving.frequencyHz) * 1'000'000LL}
        , endNs_{boardLifeNs(moving)} {}

    bool isOver() const noexcept { return doneNs_ >= endNs_; }
    std::int64_t nextNs() const noexcept { return moving_.timeNs + doneNs_; }

    /// The next event, at the place where the tone is in the middle of it. Not if isOver().
    CollisionEvent take() noexcept {
        const std::int64_t lengthNs = std::min(stepNs_, endNs_ - doneNs_);
        const double middle = static_cast<double>(doneNs_) + 0.5 * static_cast<double>(lengthNs);
        CollisionEvent step =
            movedAlong(moving_, std::min(1.0, middle / static_cast<double>(moving_.course.travelNs)));
        step.timeNs = nextNs();
        step.durationNs = lengthNs;
        step.course = {.sinceNs = moving_.course.sinceNs + doneNs_};
        doneNs_ += step.durationNs;
        return step;
    }

    /// The length that is closest to whole periods.
    static int lengthMs(double frequencyHz) noexcept {
        const auto off = [=](int ms) { return std::abs(std::remainder(frequencyHz * ms * 1e-3, 1.0)); };
        int best = leastMs;
        for (int ms = leastMs + 1; ms <= mostMs; ++ms)
            if (off(ms) < off(best)) best = ms;
        return best;
    }

private:
    CollisionEvent moving_;
    std::int64_t stepNs_, endNs_, doneNs_ = 0;
};

} // namespace physvib
