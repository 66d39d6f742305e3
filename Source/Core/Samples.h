// SPDX-License-Identifier: MIT
// Two helpers for samples: their peak, and the times at which a tone can be cut without a step.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace physvib {
/// The largest magnitude; 0 if there are no samples. NaN counts as infinite. Any thread.
inline float peakOf(std::span<const float> samples) noexcept {
    float peak = 0.0f;
    for (const float x : samples) peak = std::max(peak, std::isfinite(x) ? std::abs(x) : HUGE_VALF);
    return peak;
}

/// Where a tone can be cut without a step: the zero crossing of sin(2 pi frequencyHz t) that is nearest to
/// `ns`, in whole nanoseconds. Any thread.
inline std::int64_t nearestCrossingNs(double frequencyHz, std::int64_t ns) noexcept {
    const double crossingsPerNs = 2e-9 * frequencyHz;
    return std::llround(std::round(static_cast<double>(ns) * crossingsPerNs) / crossingsPerNs);
}

/// The zero crossing that ends a tone, which is at least a half period long. The end is at most a quarter
/// period from `ns`, except for shorter tones. Any thread.
inline std::int64_t toneEndNs(double frequencyHz, std::int64_t ns) noexcept {
    return nearestCrossingNs(frequencyHz, std::max(ns, std::int64_t{std::llround(0.5e9 / frequencyHz)}));
}

} // namespace physvib
