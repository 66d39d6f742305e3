// SPDX-License-Identifier: MIT
// Grids of phantom sensations between actuators (thesis 4.1, 4.2).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"
#include "Stimuli/FieldPlace.h"
#include <vector>

namespace physvib {

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
