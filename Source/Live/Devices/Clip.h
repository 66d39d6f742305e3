// SPDX-License-Identifier: MIT
// Limits samples to a range.
#pragma once
#include <algorithm>

namespace physvib {

/// Limits to -most..most; what is not a number becomes -most, which OutputGuard then takes away. R,
/// wait-free.
inline void clip(float* samples, float most, int frames) noexcept {
    std::transform(samples, samples + frames, samples,
                   [most](float x) { return std::min(most, std::max(-most, x)); });
}

} // namespace physvib
