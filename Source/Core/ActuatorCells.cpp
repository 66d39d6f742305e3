// SPDX-License-Identifier: MIT
// Finds rows, grids and belts among the places of actuators, in any plane, the triangles of layouts that
// close around their centre, and the cell that contains an impact.
#include "Core/ActuatorCells.h"
#include "Core/PortableMath.h"
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

double lengthOf(const Place& vector) noexcept { return std::sqrt(scalarProduct(vector, vector)); }

/// The part of `vector` that is at right angles to the unit vector.
Place perpendicular(const Place& vector, const Place& unit) noexcept {
    return addScaled(vector, unit, -scalarProduct(vector, unit));
}

/// At right angles to the unit vector, along x if it can be, else along y or z as far as it can be: planes of
/// two axes keep them as their own.
Place perpendicularAxis(const Place& unit) noexcept {
    constexpr Place axes[]{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const Place* best = axes;
    for (const Place& axis : axes)
        if (std::abs(scalarProduct(axis, unit)) < std::abs(scalarProduct(*best, unit)) - 1e-9) best = &axis;
    return normalised(perpendicular(*best, unit));
}

/// The weights with which the vectors from the centre to three corners sum to `offset`, the vector to a place
/// (Pulkki 1997, Eq. 9). All are 0 or more if the place is in their direction.
using Weights = std::array<double, 3>;
Weights weightsOf(const ActuatorPlace& offset, const std::array<ActuatorPlace, 3>& corner) noexcept {
    const double volume = scalarProduct(corner[0], vectorProduct(corner[1], corner[2]));
    Weights weights;
    for (std::size_t i = 0; i < 3; ++i)
        weights[i] = scalarProduct(offset, vectorProduct(corner[(i + 1) % 3], corner[(i + 2) % 3])) / volume;
    return weights;
}

} // namespace

NeighbourCells::Place NeighbourCells::place(const Layout& layout, int k) const noexcept {
    return toPlane(layout.places[order_[static_cast<std::size_t>(k)]]);
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
        acrosses[j] = across(toPlane(layout.places[j]));
        alongs[j] = along(toPlane(layout.places[j]));
    }
    const auto begin = order_.begin(), end = begin + layout.count;
    sortBy(acrosses, order_.data(), order_.data() + layout.count);
    const double margin = tolerance(layout), lowest = across(place(layout, 0));
    columns_ = static_cast<int>(
        std::count_if(begin, end, [&](std::uint8_t j) { return acrosses[j] - lowest <= margin; }));
    if (columns_ < 2 || layout.count % columns_ != 0) return false;
    rows_ = layout.count / columns_;
    for (int row = 0; row < layout.count; row += columns_)
        sortBy(alongs, order_.data() + row, order_.data() + row + columns_);
    return isGrid(layout);
}

bool NeighbourCells::isGrid(const Layout& layout) const noexcept {
    const double margin = tolerance(layout);
    for (int k = 0; k < layout.count; ++k) {
        const int row = k / columns_, column = k % columns_;
        const Place p = place(layout, k), inRow = place(layout, row * columns_),
                    inColumn = place(layout, column);
        if (std::abs(across(p) - across(inRow)) > margin) return false;
        if (std::abs(along(p) - along(inColumn)) > margin) return false;
        if (column > 0 && along(p) - along(place(layout, k - 1)) <= margin) return false;
        if (row > 0 && across(p) - across(place(layout, k - columns_)) <= margin) return false;
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
        const Place d = difference(toPlane(layout.places[j]), centre_);
        angles[j] = portable::atan2(d.yMetres, d.xMetres);
    }
    sortBy(angles, order_.data(), order_.data() + n);
    const double margin = tolerance(layout);
    for (int k = 0; k < n; ++k) {
        const Place a = place(layout, k), b = place(layout, (k + 1) % n), c = place(layout, (k + 2) % n);
        const Place chord = difference(c, a);
        const double inwards = crossProduct(chord, difference(b, a)); // times the chord's length
        if (inwards > margin * portable::hypot(chord.xMetres, chord.yMetres)) return false;
        if (crossProduct(difference(a, centre_), difference(b, centre_)) <= margin * margin) return false;
    }
    return true;
}

void NeighbourCells::sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept {
    if (shape_ == Shape::ring)
        ringShares(layout, toPlane(place), shares);
    else
        gridShares(layout, toPlane(place), shares);
}

void NeighbourCells::gridShares(const Layout& layout, const Place& p, Shares& shares) const noexcept {
    const auto locate = [](int count, double position, auto coordinate) -> Segment {
        if (count == 1) return {};
        int first = 0;
        while (first + 2 < count && coordinate(first + 1) <= position) ++first;
        const double low = coordinate(first), high = coordinate(first + 1);
        return {first, std::clamp((position - low) / (high - low), 0.0, 1.0)};
    };
    const Segment column = locate(columns_, along(p), [&](int c) { return along(place(layout, c)); });
    const Segment row = locate(rows_, across(p), [&](int r) { return across(place(layout, r * columns_)); });
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
    const Place offset = difference(p, centre_);
    int sector = 0;
    double first = 0.0, second = 0.0, inside = -1.0; // parts of the two; the best sector's smaller part
    for (int k = 0; k < layout.count; ++k) {
        const Place a = difference(place(layout, k), centre_),
                    b = difference(place(layout, (k + 1) % layout.count), centre_);
        const double area = crossProduct(a, b);
        const double toA = crossProduct(offset, b) / area, toB = crossProduct(a, offset) / area;
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

// Finds the plane or the line in space that the actuators are in. Rows, grids and belts are then looked for
// in the plane's own two coordinates.
NeighbourCells::NeighbourCells(const Layout& layout) noexcept {
    if (layout.count < 2 || !findPlane(layout)) return;
    std::iota(order_.begin(), order_.begin() + layout.count, std::uint8_t{0});
    // Four on the corners of a rectangle that is not upright are a belt, as in the plane of x and y.
    if (findGrid(layout, {}) || (layout.count != 4 && findGrid(layout, nearestDirection(layout))))
        shape_ = Shape::grid;
    else if (findRing(layout))
        shape_ = Shape::ring;
}

NeighbourCells::Place NeighbourCells::toPlane(const Place& p) const noexcept {
    if (!isTilted_) return p;
    return {scalarProduct(p, right_), scalarProduct(p, up_)};
}

// The farthest from the first gives a line, and the farthest from the line a plane. A row's plane is any that
// has the line as its first axis.
bool NeighbourCells::findPlane(const Layout& layout) noexcept {
    const auto begin = layout.places.begin(), end = begin + layout.count;
    const auto farthest = [&](auto distance) {
        return *std::max_element(begin, end, [&](const Place& a, const Place& b) {
            return distance(vectorBetween(*begin, a)) < distance(vectorBetween(*begin, b));
        });
    };
    const Place reach = vectorBetween(*begin, farthest(lengthOf));
    const double length = lengthOf(reach);
    if (!(length > 0.0)) return false;
    isTilted_ = true;
    const Place line = normalised(reach);
    const auto lineDistance = [&](const Place& d) { return lengthOf(perpendicular(d, line)); };
    const Place side = perpendicular(vectorBetween(*begin, farthest(lineDistance)), line);
    spanMetres_ = length + lengthOf(side);
    const bool isRow = lengthOf(side) <= tolerance(layout);
    const Place normal = isRow ? perpendicularAxis(line) : normalised(vectorProduct(line, side));
    right_ = isRow ? line : perpendicularAxis(normal);
    up_ = vectorProduct(normal, right_);
    return isRow || std::all_of(begin, end, [&](const Place& p) {
               return std::abs(scalarProduct(vectorBetween(*begin, p), normal)) <= tolerance(layout);
           });
}

// In a grid the nearest neighbour is in the same row or column, so a grid at any angle is upright along it.
NeighbourCells::Axis NeighbourCells::nearestDirection(const Layout& layout) const noexcept {
    const Place first = toPlane(layout.places[0]);
    Place nearest;
    for (int j = 1; j < layout.count; ++j) {
        const Place d = vectorBetween(first, toPlane(layout.places[static_cast<std::size_t>(j)]));
        if (j == 1 || lengthOf(d) < lengthOf(nearest)) nearest = d;
    }
    const double length = lengthOf(nearest);
    return length > 0.0 ? Axis{nearest.xMetres / length, nearest.yMetres / length} : Axis{};
}

// The triangle in whose direction the place lies is the one whose smallest weight is largest: in all others
// one is below zero. A face of more than three corners is divided at its middle. No actuator stands there, so
// its corners carry the middle's share equally, and so do all actuators that of the centre.
void TriangleCells::sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept {
    const Place offset = vectorBetween(centre_, place);
    const Triangle best = triangleTowards(layout, offset);
    const double reach = best.weights[0] + best.weights[1] + best.weights[2]; // 1 on the surface
    const double scale = 1.0 / std::max(1.0, reach);
    std::fill_n(shares.begin(), layout.count, (1.0 - std::min(1.0, reach)) / layout.count);
    shares[best.second] += best.weights[1] * scale;
    shares[best.third] += best.weights[2] * scale;
    const std::size_t first = firstCorner(best.face), corners = ends_[best.face] - first;
    if (corners == 3)
        shares[best.first] += best.weights[0] * scale;
    else
        for (std::size_t i = 0; i < corners; ++i)
            shares[corners_[first + i]] += best.weights[0] * scale / static_cast<double>(corners);
}

TriangleCells::Triangle TriangleCells::triangleTowards(const Layout& layout,
                                                       const Place& offset) const noexcept {
    const auto corner = [&](std::size_t c) { return vectorBetween(centre_, layout.places[corners_[c]]); };
    Triangle best;
    double inside = 0.0;
    for (std::size_t face = 0; face < static_cast<std::size_t>(faces_); ++face) {
        const std::size_t first = firstCorner(face), count = ends_[face] - first;
        Place middle;
        for (std::size_t i = 0; i < count; ++i)
            middle = addScaled(middle, corner(first + i), 1.0 / static_cast<double>(count));
        for (std::size_t i = 0; i < (count == 3 ? 1 : count); ++i) {
            const std::size_t second = count == 3 ? first + 1 : first + i,
                              third = count == 3 ? first + 2 : first + (i + 1) % count;
            const Weights weights =
                weightsOf(offset, {count == 3 ? corner(first) : middle, corner(second), corner(third)});
            const double smallest = std::min({weights[0], weights[1], weights[2]});
            if (face + i > 0 && smallest <= inside) continue;
            inside = smallest;
            best = {weights, face, corners_[first], corners_[second], corners_[third]};
        }
    }
    for (double& weight : best.weights) weight = std::max(weight, 0.0); // below zero by rounding alone
    return best;
}

// Finds the triangles of a layout in space: the faces of the convex hull of the actuators' directions.

namespace {

using Direction = ActuatorPlace; // length 1
using Directions = std::array<Direction, TriangleCells::maxActuators>;

constexpr double coplanar = 1e-6;      // directions that miss a plane by less lie in it
constexpr double minSeparation = 1e-3; // between two directions
constexpr double minReach = 0.1;       // from the centre to a face of directions: below, the layout is open

/// False if an actuator is at the centre, or two are in one direction from it.
bool findDirections(const ActuatorLayout& layout, const ActuatorPlace& centre,
                    Directions& directions) noexcept {
    const auto count = static_cast<std::size_t>(layout.count);
    const double minMetres = minSeparation * (layout.extentWidthMetres + layout.extentHeightMetres);
    for (std::size_t j = 0; j < count; ++j) {
        const ActuatorPlace offset = vectorBetween(centre, layout.places[j]);
        if (!(scalarProduct(offset, offset) > minMetres * minMetres)) return false;
        directions[j] = normalised(offset);
        for (std::size_t k = 0; k < j; ++k) {
            const ActuatorPlace separation = vectorBetween(directions[j], directions[k]);
            if (scalarProduct(separation, separation) < minSeparation * minSeparation) return false;
        }
    }
    return true;
}

/// The plane through three directions, whose normal points away from the centre.
struct FacePlane {
    Direction normal;
    double reach = 0.0;                       // from the centre
    bool hasBeyond = false, hasBelow = false; // directions on either side of it

    FacePlane(const Directions& all, std::size_t count, std::size_t i, std::size_t j, std::size_t k) noexcept
        : normal{normalised(vectorProduct(vectorBetween(all[i], all[j]), vectorBetween(all[i], all[k])))}
        , reach{scalarProduct(normal, all[i])} {
        if (reach < 0.0) normal = addScaled({}, normal, -1.0), reach = -reach;
        for (std::size_t m = 0; m < count && !(hasBeyond && hasBelow); ++m) {
            const double along = scalarProduct(normal, all[m]);
            hasBeyond = hasBeyond || along > reach + coplanar;
            hasBelow = hasBelow || along < reach - coplanar;
        }
    }
    bool isFace() const noexcept { return !hasBeyond; }
    /// Nothing is below: the centre is not inside. Or it is hardly inside.
    bool isOpen() const noexcept { return !hasBelow || (isFace() && reach < minReach); }
    bool contains(const Direction& offset) const noexcept {
        return std::abs(scalarProduct(normal, offset) - reach) <= coplanar;
    }
};

/// Corners of a face, by number.
struct Face {
    std::size_t count = 0;
    std::array<std::uint8_t, TriangleCells::maxActuators> corners{};

    /// The directions in the plane. False if three earlier ones span it, so that the face is already known.
    bool collect(const FacePlane& plane, const Directions& all, std::size_t directions, std::size_t i,
                 std::size_t j, std::size_t k) noexcept {
        for (std::size_t m = 0; m < directions; ++m) {
            const bool isOwn = m == i || m == j || m == k;
            if (!isOwn && !plane.contains(all[m])) continue;
            if (!isOwn && m < k) return false;
            corners[count++] = static_cast<std::uint8_t>(m);
        }
        return true;
    }

    /// Puts the corners in order around the face.
    void sort(const FacePlane& plane, const Directions& all) noexcept {
        const Direction right = normalised(addScaled(all[corners[0]], plane.normal, -plane.reach)),
                        up = vectorProduct(plane.normal, right);
        const auto angle = [&](std::uint8_t m) {
            return portable::atan2(scalarProduct(all[m], up), scalarProduct(all[m], right));
        };
        sortActuators(corners.data(), corners.data() + count, angle);
    }
};

} // namespace

TriangleCells::TriangleCells(const Layout& layout) noexcept {
    const auto count = static_cast<std::size_t>(layout.count);
    if (layout.count < 4 || isFlat(layout)) return;
    for (std::size_t j = 0; j < count; ++j)
        centre_ = addScaled(centre_, layout.places[j], 1.0 / static_cast<double>(count));
    Directions all;
    if (!findDirections(layout, centre_, all)) return;
    for (std::size_t i = 0; i + 2 < count; ++i)
        for (std::size_t j = i + 1; j + 1 < count; ++j)
            for (std::size_t k = j + 1; k < count; ++k) {
                const FacePlane plane{all, count, i, j, k};
                if (plane.isOpen()) {
                    faces_ = 0;
                    return;
                }
                Face face;
                if (!plane.isFace() || !face.collect(plane, all, count, i, j, k)) continue;
                face.sort(plane, all);
                if (!addFace(face.corners.data(), face.count)) return;
            }
}

// False, and no triangles are found, if there are more than a convex body has: rounding has doubled a face.
bool TriangleCells::addFace(const std::uint8_t* corners, std::size_t count) noexcept {
    const auto face = static_cast<std::size_t>(faces_);
    const std::size_t first = firstCorner(face), end = first + count;
    if (face == maxFaces || end > maxCorners) {
        faces_ = 0;
        return false;
    }
    std::copy_n(corners, count, corners_.begin() + first);
    ends_[face] = static_cast<std::uint16_t>(end);
    ++faces_;
    return true;
}

} // namespace physvib
