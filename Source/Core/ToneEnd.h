// SPDX-License-Identifier: MIT
// Where a tone may be cut without a step: at its zero crossings, every half period.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib {

/// The time nearest to `ns` at which sin(2 pi frequencyHz t) is 0, a whole number of half periods, in whole
/// nanoseconds. Any thread.
inline std::int64_t nearestCrossingNs(double frequencyHz, std::int64_t ns) noexcept {
    const double crossingsPerNs = 2e-9 * frequencyHz;
    return std::llround(std::round(static_cast<double>(ns) * crossingsPerNs) / crossingsPerNs);
}

/// The same for the end of a tone: a half period at least. It lies a quarter period from `ns` at most, but
/// for what is shorter. Any thread.
inline std::int64_t softEndNs(double frequencyHz, std::int64_t ns) noexcept {
    return nearestCrossingNs(frequencyHz, std::max(ns, std::int64_t{std::llround(0.5e9 / frequencyHz)}));
}

} // namespace physvib
