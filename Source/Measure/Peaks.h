// SPDX-License-Identifier: MIT
// Local maxima of a sequence, interpolated between samples.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// A peak at a fractional index.
struct Peak {
    double at, height;
};

/// Vertex of the parabola through x[i - 1], x[i] and x[i + 1], of which the middle one is the highest. Any
/// thread.
inline Peak vertex(std::span<const double> x, std::size_t i) {
    const double bend = x[i - 1] - 2.0 * x[i] + x[i + 1],
                 at = bend < 0.0 ? 0.5 * (x[i - 1] - x[i + 1]) / bend : 0.0;
    return {static_cast<double>(i) + at, x[i] - 0.25 * (x[i - 1] - x[i + 1]) * at};
}

/// Any thread.
inline bool isPeak(std::span<const double> x, std::size_t i) { return x[i] > x[i - 1] && x[i] >= x[i + 1]; }

/// All peaks above 0. Any thread (allocates).
inline std::vector<Peak> peaksOf(std::span<const double> x) {
    std::vector<Peak> all;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        if (isPeak(x, i) && x[i] > 0.0) all.push_back(vertex(x, i));
    return all;
}

} // namespace physvib
