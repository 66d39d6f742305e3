// SPDX-License-Identifier: MIT
// Percent counts of a grid, and the largest grid obtained by merging neighbouring rows and columns (thesis
// 4.2, Fig. 4.9).
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Minimum percentage of a kept cell: half a cell of a uniform 7 x 5 grid, as printed in the thesis (SPEC 3).
constexpr double defaultPercentThreshold = 1.42;

/// Maximum number of rows or columns of a grid; merging tries every division of them.
constexpr std::size_t mostGridLines = 16;

/// Share of the field, in percent, in which each target is the most likely one. Row 0 is the top row.
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
    std::size_t columns = 0, rows = 0; ///< of the first entry of `ties`; both 0 if even the whole field is
                                       ///< below the threshold
    std::vector<GridMerge> ties; ///< every merge with that number of cells, wider grids first; the first is
                                 ///< the result
};

/// `counts` with 1 to mostGridLines rows and columns, `thresholdPercent` inclusive. Any thread (allocates).
PerceptualResolution perceptualResolution(const PercentCounts& counts,
                                          double thresholdPercent = defaultPercentThreshold);

/// The percent counts of the merged cells. Any thread (allocates).
PercentCounts merged(const PercentCounts& counts, const GridMerge& merge);

} // namespace physvib
