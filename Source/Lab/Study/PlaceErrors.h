// SPDX-License-Identifier: MIT
// Pointing errors for targets at arbitrary places: constant error (bias), variable error (scatter) and mean
// distance.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {

/// One pointing trial, true and answered place in the same unit. On a line, y and trueY are 0.
struct PlaceTrial {
    std::string participant, target;
    double trueX = 0.0, trueY = 0.0, x = 0.0, y = 0.0;
    bool operator==(const PlaceTrial&) const = default;
};

/// One participant's answers to one target.
struct TargetError {
    std::string participant, target;
    std::size_t trials = 0;
    double trueX = 0.0, trueY = 0.0;         ///< means, as a target may have another place in each trial
    double constantX = 0.0, constantY = 0.0; ///< mean of answered minus true place
    double variable = 0.0; ///< root of the summed sample variances of both axes; 0 for one trial
    double distance = 0.0; ///< mean distance from the true place
};

/// One participant's means over targets, with equal weights.
struct ParticipantError {
    std::string participant;
    std::size_t targets = 0, trials = 0;
    double constantX = 0.0, constantY = 0.0, distance = 0.0;
    double variable = 0.0;    ///< over targets with more than one trial
    bool hasVariable = false; ///< at least one target has more than one trial
    double gainX = 0.0,
           gainY = 0.0; ///< slope of answered over true place; 1 means no compression or expansion
    bool hasGainX = false, hasGainY = false; ///< true places differ along that axis
};

/// Participants and targets in the order of their first trials. Any thread (allocates).
std::vector<TargetError> targetErrors(const std::vector<PlaceTrial>& trials);

/// In the order of their first trials. Any thread (allocates).
std::vector<ParticipantError> participantErrors(const std::vector<PlaceTrial>& trials);

} // namespace physvib
