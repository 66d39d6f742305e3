// SPDX-License-Identifier: MIT
// Shares of an impact among the actuators of a layout in space that closes around its centre, as a sleeve or
// a vest does: panning over triangles.
#pragma once
#include "Core/EnchanterLayout.h"
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace physvib {

/// Triangles between the actuators, as amplitude panning over triangles has them between loudspeakers
/// (Pulkki 1997). They follow from the actuators' directions, seen from the mean of their places, and are
/// found once, when the object is made. The shares sum to one, and the actuators' places weighted by them
/// give the place itself, anywhere within the surface. Docs/space.md has the formulas.
class TriangleCells {
public:
    using Layout = ActuatorLayout;
    using Place = ActuatorPlace;
    static constexpr std::size_t maxActuators = std::tuple_size_v<decltype(Layout::places)>;
    using Shares = std::array<double, maxActuators>; ///< One per actuator.

    TriangleCells() = default;

    /// Triangles of a valid layout. Needs time that grows with the cube of the number of actuators, but no
    /// heap. Any thread.
    explicit TriangleCells(const Layout& layout) noexcept;

    /// False if the layout is flat, open, or has an actuator right behind another. Any thread.
    bool areFound() const noexcept { return faces_ > 0; }

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

    bool keep(const std::uint8_t* corners, std::size_t count) noexcept;
    Triangle triangleTowards(const Layout& layout, const Place& out) const noexcept;
    std::size_t firstCorner(std::size_t face) const noexcept { return face == 0 ? 0 : ends_[face - 1]; }

    Place centre_;  // the mean of the actuators' places
    int faces_ = 0; // faces have three corners, or more in one plane; face f has corners ends_[f - 1] to
                    // ends_[f]
    std::array<std::uint16_t, maxFaces> ends_{};
    std::array<std::uint8_t, maxCorners> corners_{}; // of each face in order around it
};

} // namespace physvib
