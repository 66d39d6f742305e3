// SPDX-License-Identifier: MIT
// Grids of phantom sensations between actuators, percent counts of a grid, and the largest grid obtained by
// merging neighbouring rows and columns (thesis 4.1, 4.2, Fig. 4.9).
#pragma once
#include "Lab/Study/Identification.h"
#include "Stimuli/Stimulus.h"
#include <cstddef>
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
    std::size_t columns = 0, rows = 0; ///< of the first of `ties`; both 0: all is below the threshold
    std::vector<GridMerge> ties; ///< all with that number of cells, wider grids first; first: the result
};

/// `counts` with 1 to mostGridLines rows and columns, `thresholdPercent` inclusive. Any thread (allocates).
PerceptualResolution perceptualResolution(const PercentCounts& counts,
                                          double thresholdPercent = defaultPercentThreshold);

/// The percent counts of the merged cells. Any thread (allocates).
PercentCounts merged(const PercentCounts& counts, const GridMerge& merge);

struct PhantomGrid {
    enum class Points {
        corners, ///< the outer points lie on the field's edges, so the corners are the actuators (thesis 4.1)
        middles  ///< the field is divided into cells and the points are their centres (4.2; an assumption)
    };
    int columns = 0, rows = 0; ///< 1 to 16
    Points points = Points::corners;
    bool operator==(const PhantomGrid&) const = default;

    FieldPlace place(const GridCell& cell) const noexcept {
        return {along(cell.column, columns), along(cell.row, rows)};
    }

    /// The cell with the nearest point; the first of equal ones.
    GridCell nearest(const FieldPlace& place) const noexcept {
        return {nearestLine(place.y, rows), nearestLine(place.x, columns)};
    }

    /// All cells, row by row. Message thread only (allocates).
    std::vector<GridCell> cells() const {
        std::vector<GridCell> all;
        for (int row = 1; row <= rows; ++row)
            for (int column = 1; column <= columns; ++column) all.push_back({row, column});
        return all;
    }

private:
    double along(int line, int lines) const noexcept {
        if (points == Points::middles || lines == 1) return (line - 0.5) / lines;
        return static_cast<double>(line - 1) / (lines - 1);
    }
    int nearestLine(double at, int lines) const noexcept {
        int best = 1;
        for (int line = 2; line <= lines; ++line) {
            const double now = at - along(line, lines), before = at - along(best, lines);
            if (now * now < before * before) best = line;
        }
        return best;
    }
};

} // namespace physvib
