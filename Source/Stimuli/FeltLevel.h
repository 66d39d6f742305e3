// SPDX-License-Identifier: MIT
// Measured level of a played stimulus.
#pragma once

namespace physvib {

/// Of the actuator with the highest level, after master level, strips and ceilings.
struct FeltLevel {
    double peakG = 0.0, rmsG = 0.0; ///< rmsG: over the stimulus' duration
    bool operator==(const FeltLevel&) const = default;
};

} // namespace physvib
