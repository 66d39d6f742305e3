// SPDX-License-Identifier: MIT
// Selects the loudest channel of a multichannel recording.
#pragma once
#include "Core/Samples.h"
#include <algorithm>
#include <vector>

namespace physvib {

/// The channel with the highest peak; `channels` are not empty. Any thread.
inline const std::vector<float>& loudestOf(const std::vector<std::vector<float>>& channels) {
    return *std::ranges::max_element(channels, {}, [](const auto& samples) { return peakOf(samples); });
}

} // namespace physvib
