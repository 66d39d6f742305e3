// SPDX-License-Identifier: MIT
// How strong a stimulus was where it was felt.
#pragma once

namespace physvib {

/// Of the actuator that moved most, behind the master level, strips and ceilings.
struct FeltLevel {
    double peakG = 0.0, rmsG = 0.0; ///< the latter over the time that the stimulus lasts
    bool operator==(const FeltLevel&) const = default;
};

} // namespace physvib
