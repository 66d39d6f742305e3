// SPDX-License-Identifier: MIT
// Where in a recording its strongest hit is.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

constexpr double onsetReachSeconds = 0.02; ///< from a hit's peak back to its onset: a quarter period of 12 Hz

struct HitExcerpt {
    std::size_t begin = 0, end = 0; ///< samples
    double offset = 0.0;            ///< mean before the hit
};

/// Whole samples in that time, at least one.
inline std::size_t samplesIn(double seconds, double rateHz) noexcept {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(seconds * rateHz)));
}

/// The sum of their squares. Any thread.
double energyOf(std::span<const double> samples);

/// From the onset of what is loudest to where it has sunk into the noise, the next hit, or one second;
/// `samples` are not empty. M only.
HitExcerpt strongestHit(const std::vector<float>& samples, double rateHz);

} // namespace physvib
