// SPDX-License-Identifier: MIT
// Shares of a place among the corners of the triangle in whose direction it lies.
#include "Core/TriangleCells.h"
#include "Core/SpaceVectors.h"
#include <algorithm>

namespace physvib {
namespace {

/// Shares of a place, `out` from the centre, among three corners: the weights with which their vectors from
/// the centre sum to `out` (Pulkki 1997, Eq. 9). All are 0 or more if the place is in their direction.
using Weights = std::array<double, 3>;
Weights weightsOf(const ActuatorPlace& out, const std::array<ActuatorPlace, 3>& corner) noexcept {
    const double volume = scalarProduct(corner[0], vectorProduct(corner[1], corner[2]));
    Weights weights;
    for (std::size_t i = 0; i < 3; ++i)
        weights[i] = scalarProduct(out, vectorProduct(corner[(i + 1) % 3], corner[(i + 2) % 3])) / volume;
    return weights;
}

} // namespace

// The triangle in whose direction the place lies is the one whose smallest weight is largest: in all others
// one is below zero. A face of more than three corners is divided at its middle. No actuator stands there, so
// its corners carry the middle's share equally, and so do all actuators that of the centre.
void TriangleCells::sharesAt(const Layout& layout, const Place& place, Shares& shares) const noexcept {
    const Place out = vectorFrom(centre_, place);
    const Triangle best = triangleTowards(layout, out);
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
                                                       const Place& out) const noexcept {
    const auto corner = [&](std::size_t c) { return vectorFrom(centre_, layout.places[corners_[c]]); };
    Triangle best;
    double inside = 0.0;
    for (std::size_t face = 0; face < static_cast<std::size_t>(faces_); ++face) {
        const std::size_t first = firstCorner(face), count = ends_[face] - first;
        Place middle;
        for (std::size_t i = 0; i < count; ++i)
            middle = sumOf(middle, corner(first + i), 1.0 / static_cast<double>(count));
        for (std::size_t i = 0; i < (count == 3 ? 1 : count); ++i) {
            const std::size_t second = count == 3 ? first + 1 : first + i,
                              third = count == 3 ? first + 2 : first + (i + 1) % count;
            const Weights weights =
                weightsOf(out, {count == 3 ? corner(first) : middle, corner(second), corner(third)});
            const double least = std::min({weights[0], weights[1], weights[2]});
            if (face + i > 0 && least <= inside) continue;
            inside = least;
            best = {weights, face, corners_[first], corners_[second], corners_[third]};
        }
    }
    for (double& weight : best.weights) weight = std::max(weight, 0.0); // below zero by rounding alone
    return best;
}

} // namespace physvib
