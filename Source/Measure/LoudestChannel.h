// SPDX-License-Identifier: MIT
// Of several microphones, the one that heard most.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace physvib {

/// The channel with the highest peak; `channels` are not empty. Any thread.
inline const std::vector<float>& loudestOf(const std::vector<std::vector<float>>& channels) {
    return *std::ranges::max_element(channels, {}, [](const auto& samples) {
        float peak = 0.0f;
        for (const float x : samples) peak = std::max(peak, std::isfinite(x) ? std::abs(x) : HUGE_VALF);
        return peak;
    });
}

} // namespace physvib
