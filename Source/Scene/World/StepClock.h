// SPDX-License-Identifier: MIT
// World time as a step count, so that no rounding accumulates.
#pragma once
#include <cmath>
#include <cstdint>

namespace physvib {

/// Times of the steps of a world that runs at `stepsPerSecond` (> 0).
struct StepClock {
    int stepsPerSecond = 100;

    double stepSeconds() const noexcept { return 1.0 / stepsPerSecond; }

    /// Nanoseconds at which step `step` (>= 0) begins, rounded down. Any thread.
    std::int64_t timeNs(std::int64_t step) const noexcept {
        constexpr std::int64_t nsPerSecond = 1'000'000'000;
        // Whole seconds separately: step * 10^9 alone would overflow within 107 days at 1,000 steps per
        // second.
        return step / stepsPerSecond * nsPerSecond + step % stepsPerSecond * nsPerSecond / stepsPerSecond;
    }

    /// The first step that begins at or after `seconds` (>= 0). Any thread.
    std::int64_t firstStepAt(double seconds) const noexcept {
        constexpr double rounding = 1.0e-6; // 0.07 s * 100 is 7.000000000000001, which belongs to step 7
        return static_cast<std::int64_t>(std::ceil(seconds * stepsPerSecond - rounding));
    }
};

} // namespace physvib
