// SPDX-License-Identifier: MIT
// Where people point at what they feel: one normal distribution per target, and the map of the likeliest
// target for every place (thesis 4.2, Eq. 4.4 and 4.5).
#pragma once
#include "Lab/Study/PercentCounts.h"
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// One pointing trial; row and column of the target from 1, x and y of the response within [0, 1], y
/// downwards.
struct LocationTrial {
    int targetColumn = 0, targetRow = 0;
    double x = 0.0, y = 0.0;
    bool operator==(const LocationTrial&) const = default;
};

/// A two-dimensional normal distribution.
struct PlaceNormal {
    std::size_t responses = 0;
    double meanX = 0.0, meanY = 0.0;
    double varianceX = 0.0, varianceY = 0.0, covariance = 0.0;
    bool isBorrowed = false; ///< the covariance is the pooled one: its own is singular or rests on fewer than
                             ///< three responses

    double determinant() const noexcept { return varianceX * varianceY - covariance * covariance; }
};

/// The normals of a condition. Targets without a response have none and can never be the likeliest.
struct ResponseNormals {
    std::size_t rows = 0, columns = 0;
    std::vector<PlaceNormal> normals;  ///< row by row; responses == 0: no normal
    std::vector<std::string> warnings; ///< a line each: targets without a response, borrowed covariances
    std::string fault;                 ///< not empty: no normals can be made, and why
};

/// Mean and sample covariance per target. A target whose covariance cannot be inverted gets the condition's
/// pooled covariance within targets. Any thread (allocates).
ResponseNormals responseNormals(const std::vector<LocationTrial>& trials);

/// The field that is counted, in pixels: the thesis' tablet.
constexpr std::size_t mapColumns = 1230, mapRows = 635;

/// The index (row by row) of the likeliest target at the middle of every pixel, rows from the top: Eq. 4.5.
/// `normals` without a fault. Any thread (allocates).
std::vector<std::uint16_t> likelihoodMap(const ResponseNormals& normals, std::size_t width = mapColumns,
                                         std::size_t height = mapRows);

/// The share of each target in `map`, in percent. Any thread (allocates).
PercentCounts percentCounts(const ResponseNormals& normals, const std::vector<std::uint16_t>& map,
                            std::string condition);

/// A condition from its responses to its resolution.
struct ConditionResolution {
    std::string condition;
    ResponseNormals normals; ///< after a fault the rest is empty
    PercentCounts counts;
    PerceptualResolution resolution;
};

/// How far chance alone moves the number of cells: responses are drawn again, with replacement, target by
/// target.
struct CellSpread {
    double mean = 0.0, deviation = 0.0; ///< cells
};

/// Of trials whose normals have no fault. The same seed gives the same bits. Any thread (allocates).
CellSpread cellSpread(const std::vector<LocationTrial>& trials,
                      double thresholdPercent = defaultPercentThreshold, int draws = 200,
                      std::uint64_t seed = 1);

/// Any thread (allocates).
ConditionResolution resolveCondition(std::string condition, const std::vector<LocationTrial>& trials,
                                     double thresholdPercent = defaultPercentThreshold);

} // namespace physvib
