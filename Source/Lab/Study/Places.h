// SPDX-License-Identifier: MIT
// Pointing responses: a normal distribution per target of a grid, the map of the most likely target at every
// place (thesis 4.2, Eq. 4.4 and 4.5), and pointing errors at targets anywhere.
#pragma once
#include "Lab/Study/Identification.h"
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {
/// One pointing trial. The target's row and column start at 1; the response's x and y are in [0, 1], y down.
struct LocationTrial {
    int targetColumn = 0, targetRow = 0;
    double x = 0.0, y = 0.0;
    std::string participant{};
    bool operator==(const LocationTrial&) const = default;
};

/// A two-dimensional normal distribution.
struct PlaceNormal {
    std::size_t responses = 0;
    double meanX = 0.0, meanY = 0.0;
    double varianceX = 0.0, varianceY = 0.0, covariance = 0.0;
    bool usesPooledCovariance = false; ///< its own covariance is singular or has fewer than three
                                       ///< responses, so the pooled one is used

    double determinant() const noexcept { return varianceX * varianceY - covariance * covariance; }
};

/// Normal distributions of a condition. Targets without a response have none and are never the most likely.
struct ResponseNormals {
    std::size_t rows = 0, columns = 0;
    std::vector<PlaceNormal> normals;  ///< row by row; responses == 0: no distribution
    std::vector<std::string> warnings; ///< one line each: targets without responses, and pooled covariances
    std::string error;                 ///< if not empty, why no distributions can be computed
};

/// Mean and sample covariance per target. A target with a singular covariance gets the condition's pooled
/// within-target covariance. Any thread (allocates).
ResponseNormals responseNormals(const std::vector<LocationTrial>& trials);

/// Size of the evaluated field in pixels: the thesis' tablet.
constexpr std::size_t mapColumns = 1230, mapRows = 635;

/// Index (row by row) of the most likely target at the centre of every pixel, rows from the top (Eq. 4.5).
/// Precondition: `normals` without an error. Any thread (allocates).
std::vector<std::uint16_t> likelihoodMap(const ResponseNormals& normals, std::size_t width = mapColumns,
                                         std::size_t height = mapRows);

/// The share of each target in `map`, in percent. Any thread (allocates).
PercentCounts percentCounts(const ResponseNormals& normals, const std::vector<std::uint16_t>& map,
                            std::string condition);

/// All results of one condition, from responses to perceptual resolution.
struct ConditionResolution {
    std::string condition;
    ResponseNormals normals; ///< with an error, the other results are empty
    PercentCounts counts;
    PerceptualResolution resolution;
};

/// Computes all results of a condition from its trials. Any thread (allocates).
ConditionResolution resolveCondition(std::string condition, const std::vector<LocationTrial>& trials,
                                     double thresholdPercent = defaultPercentThreshold);

// Pointing errors for targets anywhere: constant error (bias), variable error (scatter), mean distance.

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
