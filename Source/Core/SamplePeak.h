// SPDX-License-Identifier: MIT
// Peak magnitude of samples.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>

namespace physvib {

/// The largest magnitude; 0 if there are no samples. NaN counts as infinite. Any thread.
inline float peakOf(std::span<const float> samples) noexcept {
    float peak = 0.0f;
    for (const float x : samples) peak = std::max(peak, std::isfinite(x) ? std::abs(x) : HUGE_VALF);
    return peak;
}

} // namespace physvib
