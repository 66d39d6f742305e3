// SPDX-License-Identifier: MIT
// Percent counts of a grid, and the largest grid that merging neighbouring rows and columns makes of them
// (thesis 4.2, Fig. 4.9).
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Half of a cell of a uniform 7 x 5 grid, as the thesis prints it; a kept cell is at least this (SPEC 3).
constexpr double defaultPercentThreshold = 1.42;

/// Most rows or columns of a grid, of which merging tries every division.
constexpr std::size_t mostGridLines = 16;

/// The share of the field, in percent, in which each target is the likeliest. Row 0 is the upper one.
struct PercentCounts {
    std::string condition;
    std::size_t rows = 0, columns = 0;
    std::vector<double> percent; ///< row by row

    double at(std::size_t row, std::size_t column) const { return percent[row * columns + column]; }
    double sum() const noexcept;
    /// Sample standard deviation; 0 for a single cell.
    double standardDeviation() const noexcept;
    bool operator==(const PercentCounts&) const = default;
};

/// Sizes of groups of neighbouring rows and columns: {1, 2, 1, 1} merges the second and third.
struct GridMerge {
    std::vector<std::size_t> columnGroups, rowGroups;
    bool operator==(const GridMerge&) const = default;
};

/// The largest grids whose cells all reach the threshold.
struct PerceptualResolution {
    std::size_t columns = 0, rows = 0; ///< of the first of `ties`; both 0 if even the whole field does not
                                       ///< reach it
    std::vector<GridMerge> ties; ///< every merge of that many cells, wider grids first; the first counts
};

/// `counts` with 1 to mostGridLines rows and columns, `thresholdPercent` inclusive. Any thread (allocates).
PerceptualResolution perceptualResolution(const PercentCounts& counts,
                                          double thresholdPercent = defaultPercentThreshold);

/// The percent counts of the merged cells. Any thread (allocates).
PercentCounts merged(const PercentCounts& counts, const GridMerge& merge);

} // namespace physvib
