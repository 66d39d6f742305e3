// SPDX-License-Identifier: MIT
// Finds rows, grids and belts among the places of actuators, and the cell that contains an impact.
#include "Core/NeighbourCells.h"
#include "Core/ActuatorSort.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace physvib {
namespace {

using Layout = NeighbourCells::Layout;
using Place = NeighbourCells::Place;

Place difference(const Place& a, const Place& b) noexcept {
    return {a.xMetres - b.xMetres, a.yMetres - b.yMetres};
}

double crossProduct(const Place& a, const Place& b) noexcept {
    return a.xMetres * b.yMetres - a.yMetres * b.xMetres;
}

using Keys = std::array<double, std::tuple_size_v<decltype(Layout{}.places)>>; // of each actuator

void sortBy(const Keys& keys, std::uint8_t* begin, std::uint8_t* end) noexcept {
    sortActuators(begin, end, [&keys](std::uint8_t j) { return keys[j]; });
}

} // namespace

NeighbourCells::Place NeighbourCells::place(const Layout& layout, int k) const noexcept {
    return onPlane(layout.places[order_[static_cast<std::size_t>(k)]]);
}

double NeighbourCells::tolerance(const Layout& layout) const noexcept {
    return 1e-3 * (isTilted_ ? spanMetres_ : layout.extentWidthMetres + layout.extentHeightMetres);
}

NeighbourCells::NeighbourCells(const Layout& layout, Axis line) noexcept {
    if (layout.count < 2) return;
    std::iota(order_.begin(), order_.begin() + layout.count, std::uint8_t{0});
    if (findGrid(layout, line) || findGrid(layout, {}))
        shape_ = Shape::grid;
    else if (findRing(layout))
        shape_ = Shape::ring;
}

// Sorting by rows, then within each row, puts the actuators of a grid in the order of reading from below.
bool NeighbourCells::findGrid(const Layout& layout, Axis axis) noexcept {
    axis_ = axis;
    Keys acrosses{}, alongs{};
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j) {
        acrosses[j] = across(onPlane(layout.places[j]));
        alongs[j] = along(onPlane(layout.places[j]));
    }
    const auto begin = order_.begin(), end = begin + layout.count;
    sortBy(acrosses, order_.data(), order_.data() + layout.count);
    const double near = tolerance(layout), lowest = across(place(layout, 0));
    columns_ = static_cast<int>(
        std::count_if(begin, end, [&](std::uint8_t j) { return acrosses[j] - lowest <= near; }));
    if (columns_ < 2 || layout.count % columns_ != 0) return false;
    rows_ = layout.count / columns_;
    for (int row = 0; row < layout.count; row += columns_)
        sortBy(alongs, order_.data() + row, order_.data() + row + columns_);
    return isGrid(layout);
}

bool NeighbourCells::isGrid(const Layout& layout) const noexcept {
    const double near = tolerance(layout);
    for (int k = 0; k < layout.count; ++k) {
        const int row = k / columns_, column = k % columns_;
        const Place p = place(layout, k), inRow = place(layout, row * columns_),
                    inColumn = place(layout, column);
        if (std::abs(across(p) - across(inRow)) > near) return false;
        if (std::abs(along(p) - along(inColumn)) > near) return false;
        if (column > 0 && along(p) - along(place(layout, k - 1)) <= near) return false;
        if (row > 0 && across(p) - across(place(layout, k - columns_)) <= near) return false;
    }
    return true;
}

// A belt may be a circle, an ellipse or any other convex outline with nothing inside.
bool NeighbourCells::findRing(const Layout& layout) noexcept {
    const int n = layout.count;
    if (n < 4) return false;
    centre_ = {};
    for (int k = 0; k < n; ++k) {
        centre_.xMetres += place(layout, k).xMetres / n;
        centre_.yMetres += place(layout, k).yMetres / n;
    }
    Keys angles{};
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
        const Place d = difference(onPlane(layout.places[j]), centre_);
        angles[j] = std::atan2(d.yMetres, d.xMetres);
    }
    sortBy(angles, order_.data(), order_.data() + n);
    const double near = tolerance(layout);
    for (int k = 0; k < n; ++k) {
        const Place a = place(layout, k), b = place(layout, (k + 1) % n), c = place(layout, (k + 2) % n);
        const Place chord = difference(c, a);
        const double inwards = crossProduct(chord, difference(b, a)); // times the chord's length
        if (inwards > near * std::hypot(chord.xMetres, chord.yMetres)) return false;
        if (crossProduct(difference(a, centre_), difference(b, centre_)) <= near * near) return false;
    }
    return true;
}

void NeighbourCells::sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept {
    if (shape_ == Shape::ring)
        ringShares(layout, onPlane(place), shares);
    else
        gridShares(layout, onPlane(place), shares);
}

void NeighbourCells::gridShares(const Layout& layout, const Place& p, Shares& shares) const noexcept {
    const auto between = [](int count, double at, auto coordinate) -> Between {
        if (count == 1) return {};
        int first = 0;
        while (first + 2 < count && coordinate(first + 1) <= at) ++first;
        const double from = coordinate(first), to = coordinate(first + 1);
        return {first, std::clamp((at - from) / (to - from), 0.0, 1.0)};
    };
    const Between column = between(columns_, along(p), [&](int c) { return along(place(layout, c)); });
    const Between row = between(rows_, across(p), [&](int r) { return across(place(layout, r * columns_)); });
    std::fill_n(shares.begin(), layout.count, 0.0);
    for (int r = 0; r < std::min(2, rows_); ++r)
        for (int c = 0; c < 2; ++c) {
            const int k = (row.first + r) * columns_ + column.first + c;
            shares[order_[static_cast<std::size_t>(k)]] =
                (r == 0 ? 1.0 - row.share : row.share) * (c == 0 ? 1.0 - column.share : column.share);
        }
}

// The two neighbours and the centre form a triangle. The centre has no actuator; all of the ring share its
// part, and their mean place is the centre.
void NeighbourCells::ringShares(const Layout& layout, const Place& p, Shares& shares) const noexcept {
    const Place out = difference(p, centre_);
    int sector = 0;
    double first = 0.0, second = 0.0, inside = -1.0; // parts of the two; the best sector's smaller part
    for (int k = 0; k < layout.count; ++k) {
        const Place a = difference(place(layout, k), centre_),
                    b = difference(place(layout, (k + 1) % layout.count), centre_);
        const double area = crossProduct(a, b);
        const double toA = crossProduct(out, b) / area, toB = crossProduct(a, out) / area;
        if (k > 0 && std::min(toA, toB) <= inside) continue;
        inside = std::min(toA, toB);
        sector = k, first = std::max(0.0, toA), second = std::max(0.0, toB);
    }
    const double reach = first + second; // 1 on the outline
    const double scale = std::max(1.0, reach);
    std::fill_n(shares.begin(), layout.count, (1.0 - std::min(1.0, reach)) / layout.count);
    shares[order_[static_cast<std::size_t>(sector)]] += first / scale;
    shares[order_[static_cast<std::size_t>((sector + 1) % layout.count)]] += second / scale;
}

} // namespace physvib
