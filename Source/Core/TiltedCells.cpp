// SPDX-License-Identifier: MIT
// Finds the plane or the line in space that the actuators of a layout are in. Rows, grids and belts are then
// looked for in the plane's own two coordinates.
#include "Core/NeighbourCells.h"
#include "Core/SpaceVectors.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

using Place = NeighbourCells::Place;

double lengthOf(const Place& vector) noexcept { return std::sqrt(scalarProduct(vector, vector)); }

/// The part of `vector` that is at right angles to the unit vector.
Place perpendicular(const Place& vector, const Place& unit) noexcept {
    return sumOf(vector, unit, -scalarProduct(vector, unit));
}

/// At right angles to the unit vector, along x if it can be, else along y or z as far as it can be: planes of
/// two axes keep them as their own.
Place uprightAcross(const Place& unit) noexcept {
    constexpr Place axes[]{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const Place* best = axes;
    for (const Place& axis : axes)
        if (std::abs(scalarProduct(axis, unit)) < std::abs(scalarProduct(*best, unit)) - 1e-9) best = &axis;
    return directionOf(perpendicular(*best, unit));
}

} // namespace

NeighbourCells::NeighbourCells(const Layout& layout) noexcept {
    if (layout.count < 2 || !findPlane(layout)) return;
    std::iota(order_.begin(), order_.begin() + layout.count, std::uint8_t{0});
    // Four on the corners of a rectangle that is not upright are a belt, as in the plane of x and y.
    if (findGrid(layout, {}) || (layout.count != 4 && findGrid(layout, towardsNearest(layout))))
        shape_ = Shape::grid;
    else if (findRing(layout))
        shape_ = Shape::ring;
}

NeighbourCells::Place NeighbourCells::onPlane(const Place& p) const noexcept {
    if (!isTilted_) return p;
    return {scalarProduct(p, right_), scalarProduct(p, up_)};
}

// The farthest from the first gives a line, and the farthest from the line a plane. A row's plane is any that
// has the line as its first axis.
bool NeighbourCells::findPlane(const Layout& layout) noexcept {
    const auto begin = layout.places.begin(), end = begin + layout.count;
    const auto farthest = [&](auto distance) {
        return *std::max_element(begin, end, [&](const Place& a, const Place& b) {
            return distance(vectorFrom(*begin, a)) < distance(vectorFrom(*begin, b));
        });
    };
    const Place reach = vectorFrom(*begin, farthest(lengthOf));
    const double length = lengthOf(reach);
    if (!(length > 0.0)) return false;
    isTilted_ = true;
    const Place line = directionOf(reach);
    const auto aside = [&](const Place& d) { return lengthOf(perpendicular(d, line)); };
    const Place side = perpendicular(vectorFrom(*begin, farthest(aside)), line);
    spanMetres_ = length + lengthOf(side);
    const bool isRow = lengthOf(side) <= tolerance(layout);
    const Place normal = isRow ? uprightAcross(line) : directionOf(vectorProduct(line, side));
    right_ = isRow ? line : uprightAcross(normal);
    up_ = vectorProduct(normal, right_);
    return isRow || std::all_of(begin, end, [&](const Place& p) {
               return std::abs(scalarProduct(vectorFrom(*begin, p), normal)) <= tolerance(layout);
           });
}

// In a grid the nearest neighbour is in the same row or column, so a grid at any angle is upright along it.
NeighbourCells::Axis NeighbourCells::towardsNearest(const Layout& layout) const noexcept {
    const Place first = onPlane(layout.places[0]);
    Place nearest;
    for (int j = 1; j < layout.count; ++j) {
        const Place d = vectorFrom(first, onPlane(layout.places[static_cast<std::size_t>(j)]));
        if (j == 1 || lengthOf(d) < lengthOf(nearest)) nearest = d;
    }
    const double length = lengthOf(nearest);
    return length > 0.0 ? Axis{nearest.xMetres / length, nearest.yMetres / length} : Axis{};
}

} // namespace physvib
