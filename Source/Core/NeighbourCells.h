// SPDX-License-Identifier: MIT
// Shares of an impact among the actuators that surround its place: two of a row or a belt, four of a grid.
#pragma once
#include "Core/EnchanterLayout.h"
#include <cstdint>

namespace physvib {

/// Cells of a layout whose shape is a row, a grid or a belt, in the plane of x and y or in any other. The
/// shares sum to one, and the actuators' places weighted by them give the place itself, anywhere within the
/// shape. Docs/rows.md has the formulas.
class NeighbourCells {
public:
    using Layout = EnchanterLayout;
    using Place = EnchanterPlace;
    using Shares = std::array<double, limits::maxEnchanters>; ///< One per actuator.
    struct Axis {
        double x = 1.0, y = 0.0;
    }; ///< Unit vector.

    NeighbourCells() = default;

    /// Cells of a valid layout. `line`: direction in which the actuators of a row stand. Places may miss the
    /// shape by a thousandth of the extent, as rounded numbers of a file do. Any thread.
    NeighbourCells(const Layout& layout, Axis line) noexcept;

    /// Cells of a valid layout in space: of the plane or line that its actuators are in, if they are in one.
    /// A place beside the plane is moved onto it. Grids may stand at any angle. Any thread.
    explicit NeighbourCells(const Layout& layout) noexcept;

    /// False if the layout has none of the shapes. Any thread.
    bool areFound() const noexcept { return shape_ != Shape::none; }

    /// Shares for a place in metres of the layout the cells were made of. A place outside is moved to the
    /// shape's edge. Writes the first `layout.count` entries. Any thread.
    void sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept;

private:
    enum class Shape : std::uint8_t { none, grid, ring }; // a row is a grid of one row
    struct Between {
        int first = 0;      // this one and the next
        double share = 0.0; // of the next
    };

    Place place(const Layout& layout, int k) const noexcept;
    Place onPlane(const Place& p) const noexcept;
    bool findPlane(const Layout& layout) noexcept;
    double tolerance(const Layout& layout) const noexcept;
    Axis towardsNearest(const Layout& layout) const noexcept;
    double along(const Place& p) const noexcept { return p.xMetres * axis_.x + p.yMetres * axis_.y; }
    double across(const Place& p) const noexcept { return p.yMetres * axis_.x - p.xMetres * axis_.y; }
    bool findGrid(const Layout& layout, Axis axis) noexcept;
    bool isGrid(const Layout& layout) const noexcept;
    bool findRing(const Layout& layout) noexcept;
    void gridShares(const Layout& layout, const Place& p, Shares& shares) const noexcept;
    void ringShares(const Layout& layout, const Place& p, Shares& shares) const noexcept;

    Shape shape_ = Shape::none;
    bool isTilted_ = false;   // the plane is not that of x and y
    Place right_, up_;        // of a tilted plane: its axes
    double spanMetres_ = 0.0; // and the actuators' extents along both
    Axis axis_;
    Place centre_;               // of a ring: the mean of the actuators' places
    int columns_ = 0, rows_ = 0; // of a grid
    // actuators in rows from below and in each from left to right, or counter-clockwise around the centre
    std::array<std::uint8_t, limits::maxEnchanters> order_{};
};

} // namespace physvib
