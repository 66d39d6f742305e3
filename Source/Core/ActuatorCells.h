// SPDX-License-Identifier: MIT
// Cells between actuators, for the panning laws `neighbours` and `triangles`: rows, grids and belts
// in a plane, and triangles of a layout in space. Each shares an impact among the actuators around its place.
#pragma once
#include "Core/EnchanterLayout.h"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace physvib {

/// The vector from a to b. Any thread, as all arithmetic of places.
inline ActuatorPlace vectorBetween(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return {b.xMetres - a.xMetres, b.yMetres - a.yMetres, b.zMetres - a.zMetres};
}

/// The vector a + factor * b.
inline ActuatorPlace addScaled(const ActuatorPlace& a, const ActuatorPlace& b, double factor) noexcept {
    return {a.xMetres + factor * b.xMetres, a.yMetres + factor * b.yMetres, a.zMetres + factor * b.zMetres};
}

inline double scalarProduct(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return a.xMetres * b.xMetres + a.yMetres * b.yMetres + a.zMetres * b.zMetres;
}

inline ActuatorPlace vectorProduct(const ActuatorPlace& a, const ActuatorPlace& b) noexcept {
    return {a.yMetres * b.zMetres - a.zMetres * b.yMetres, a.zMetres * b.xMetres - a.xMetres * b.zMetres,
            a.xMetres * b.yMetres - a.yMetres * b.xMetres};
}

/// The vector of length 1 in the same direction; the vector must not be 0.
inline ActuatorPlace normalised(const ActuatorPlace& vector) noexcept {
    return addScaled({}, vector, 1.0 / std::sqrt(scalarProduct(vector, vector)));
}

/// Sorts numbers of actuators by insertion, the smallest key first: a layout has at most 64 actuators, and
/// std::sort would enlarge the browser's page by a hundredth. Any thread.
template <class Key>
void sortActuators(std::uint8_t* begin, std::uint8_t* end, const Key& key) noexcept {
    for (std::uint8_t* next = begin; next < end; ++next) {
        const std::uint8_t moved = *next;
        const auto movedKey = key(moved);
        std::uint8_t* hole = next;
        for (; hole > begin && movedKey < key(*(hole - 1)); --hole) *hole = *(hole - 1);
        *hole = moved;
    }
}

/// Shares an impact among the actuators around its place: two of a row or a belt, four of a grid. Cells of a
/// layout whose shape is a row, a grid or a belt, in the plane of x and y or in any other. The shares sum to
/// one, and the actuators' places weighted by them give the place itself, anywhere within the shape.
/// Docs/rows.md has the formulas.
class NeighbourCells {
public:
    using Layout = ActuatorLayout;
    using Place = ActuatorPlace;
    using Shares = std::array<double, limits::maxActuators>; ///< One per actuator.
    struct Axis {                                            // a unit vector
        double x = 1.0, y = 0.0;
    };

    NeighbourCells() = default;

    /// Cells of a valid layout. `line`: direction in which the actuators of a row stand. Places may miss the
    /// shape by a thousandth of the extent, as rounded numbers of a file do. Any thread.
    NeighbourCells(const Layout& layout, Axis line) noexcept;

    /// Cells of a valid layout in space: of the plane or line that its actuators are in, if they are in one.
    /// A place beside the plane is moved onto it. Grids may stand at any angle. Any thread.
    explicit NeighbourCells(const Layout& layout) noexcept;

    /// False if the layout has none of the shapes. Any thread.
    bool isUsable() const noexcept { return shape_ != Shape::none; }

    /// Shares for a place in metres of the layout the cells were made of. A place outside is moved to the
    /// shape's edge. Writes the first `layout.count` entries. Any thread.
    void sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept;

private:
    enum class Shape : std::uint8_t { none, grid, ring }; // a row is a grid of one row
    struct Segment {
        int first = 0;      // this one and the next
        double share = 0.0; // of the next
    };

    Place place(const Layout& layout, int k) const noexcept;
    Place toPlane(const Place& p) const noexcept;
    bool findPlane(const Layout& layout) noexcept;
    double tolerance(const Layout& layout) const noexcept;
    Axis nearestDirection(const Layout& layout) const noexcept;
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
    std::array<std::uint8_t, limits::maxActuators> order_{};
};

/// Triangles between the actuators of a layout that closes around its centre, as a sleeve or a vest does: as
/// amplitude panning over triangles has them between loudspeakers (Pulkki 1997). They follow from the
/// actuators' directions, seen from the mean of their places, and are found once, when the object is made.
/// The shares sum to one, and the actuators' places weighted by them give the place itself, anywhere within
/// the surface. Docs/space.md has the formulas.
class TriangleCells {
public:
    using Layout = ActuatorLayout;
    using Place = ActuatorPlace;
    static constexpr std::size_t maxActuators = std::tuple_size_v<decltype(Layout::places)>;
    using Shares = std::array<double, maxActuators>; ///< One per actuator.

    TriangleCells() = default;

    /// Triangles of a valid layout. The time grows with the cube of their number; no heap. Any thread.
    explicit TriangleCells(const Layout& layout) noexcept;

    /// False if the layout is flat, open, or has an actuator right behind another. Any thread.
    bool isUsable() const noexcept { return faces_ > 0; }

    /// Shares for a place in metres of the layout the triangles were made of. A place outside is moved to the
    /// surface, towards the centre. Writes the first `layout.count` entries. Any thread.
    void sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept;

private:
    // what Euler's formula allows for convex bodies
    static constexpr std::size_t maxFaces = 2 * maxActuators - 4, maxCorners = 3 * maxFaces;
    struct Triangle {
        std::array<double, 3> weights{}; // of `first`, or of the middle of a face of more than three corners
        std::size_t face = 0;
        std::uint8_t first = 0, second = 0, third = 0; // actuators
    };

    bool addFace(const std::uint8_t* corners, std::size_t count) noexcept;
    Triangle triangleTowards(const Layout& layout, const Place& offset) const noexcept;
    std::size_t firstCorner(std::size_t face) const noexcept { return face == 0 ? 0 : ends_[face - 1]; }

    Place centre_;  // the mean of the actuators' places
    int faces_ = 0; // of three corners, or more in one plane; face f has corners ends_[f - 1] to ends_[f]
    std::array<std::uint16_t, maxFaces> ends_{};
    std::array<std::uint8_t, maxCorners> corners_{}; // of each face in order around it
};

} // namespace physvib
