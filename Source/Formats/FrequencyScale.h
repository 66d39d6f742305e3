// SPDX-License-Identifier: MIT
// Maps the relative frequencies (0 to 1) of phone formats to Hz.
#pragma once
#include <algorithm>

namespace physvib {

/// Linear over the actuator's range; by default the range that MPEG's encoder uses for sharpness. Any thread.
struct FrequencyScale {
    double lowHz = 65.0, highHz = 300.0;

    double hertz(double share) const noexcept {
        return lowHz + (highHz - lowHz) * std::clamp(share, 0.0, 1.0);
    }
    double share(double hz) const noexcept { return std::clamp((hz - lowHz) / (highHz - lowHz), 0.0, 1.0); }
};

} // namespace physvib
