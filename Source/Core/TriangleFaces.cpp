// SPDX-License-Identifier: MIT
// Finds the triangles of a layout in space: the faces of the convex hull of the actuators' directions.
#include "Core/ActuatorSort.h"
#include "Core/SpaceVectors.h"
#include "Core/TriangleCells.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Direction = ActuatorPlace; // length 1
using Directions = std::array<Direction, TriangleCells::maxActuators>;

constexpr double coplanar = 1e-6;   // directions that miss a plane by less lie in it
constexpr double leastApart = 1e-3; // between two directions
constexpr double leastReach = 0.1;  // from the centre to a face of directions: below, the layout is open

/// False if an actuator is at the centre, or two are in one direction from it.
bool findDirections(const ActuatorLayout& layout, const ActuatorPlace& centre,
                    Directions& directions) noexcept {
    const auto count = static_cast<std::size_t>(layout.count);
    const double least = leastApart * (layout.extentWidthMetres + layout.extentHeightMetres);
    for (std::size_t j = 0; j < count; ++j) {
        const ActuatorPlace out = vectorFrom(centre, layout.places[j]);
        if (!(scalarProduct(out, out) > least * least)) return false;
        directions[j] = directionOf(out);
        for (std::size_t k = 0; k < j; ++k) {
            const ActuatorPlace apart = vectorFrom(directions[j], directions[k]);
            if (scalarProduct(apart, apart) < leastApart * leastApart) return false;
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
        : normal{directionOf(vectorProduct(vectorFrom(all[i], all[j]), vectorFrom(all[i], all[k])))}
        , reach{scalarProduct(normal, all[i])} {
        if (reach < 0.0) normal = sumOf({}, normal, -1.0), reach = -reach;
        for (std::size_t m = 0; m < count && !(hasBeyond && hasBelow); ++m) {
            const double along = scalarProduct(normal, all[m]);
            hasBeyond = hasBeyond || along > reach + coplanar;
            hasBelow = hasBelow || along < reach - coplanar;
        }
    }
    bool isFace() const noexcept { return !hasBeyond; }
    /// Nothing is below: the centre is not inside. Or it is hardly inside.
    bool isOpen() const noexcept { return !hasBelow || (isFace() && reach < leastReach); }
    bool contains(const Direction& one) const noexcept {
        return std::abs(scalarProduct(normal, one) - reach) <= coplanar;
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
        const Direction right = directionOf(sumOf(all[corners[0]], plane.normal, -plane.reach)),
                        up = vectorProduct(plane.normal, right);
        const auto angle = [&](std::uint8_t m) {
            return std::atan2(scalarProduct(all[m], up), scalarProduct(all[m], right));
        };
        sortActuators(corners.data(), corners.data() + count, angle);
    }
};

} // namespace

TriangleCells::TriangleCells(const Layout& layout) noexcept {
    const auto count = static_cast<std::size_t>(layout.count);
    if (layout.count < 4 || isFlat(layout)) return;
    for (std::size_t j = 0; j < count; ++j)
        centre_ = sumOf(centre_, layout.places[j], 1.0 / static_cast<double>(count));
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
                if (!keep(face.corners.data(), face.count)) return;
            }
}

// False, and no triangles are found, if there are more than a convex body has: rounding has doubled a face.
bool TriangleCells::keep(const std::uint8_t* corners, std::size_t count) noexcept {
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
