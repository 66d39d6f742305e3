// SPDX-License-Identifier: MIT
// From 0 to 1, as phones say frequencies, to Hz.
#pragma once
#include <algorithm>

namespace physvib {

/// A line between the ends of what an actuator plays; unless told, what MPEG's encoder takes sharpness for.
/// Any thread.
struct FrequencyScale {
    double lowHz = 65.0, highHz = 300.0;

    double hertz(double share) const noexcept {
        return lowHz + (highHz - lowHz) * std::clamp(share, 0.0, 1.0);
    }
    double share(double hz) const noexcept { return std::clamp((hz - lowHz) / (highHz - lowHz), 0.0, 1.0); }
};

} // namespace physvib
