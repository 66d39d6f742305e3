// SPDX-License-Identifier: MIT
// Finds the strongest impact in a recording.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

constexpr double onsetReachSeconds = 0.02; ///< from an impact's peak back to its onset: a quarter period of
                                           ///< 12 Hz

struct HitExcerpt {
    std::size_t begin = 0, end = 0; ///< samples
    double offset = 0.0;            ///< mean before the impact
};

/// Number of samples in that time, at least one.
inline std::size_t samplesIn(double seconds, double rateHz) noexcept {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(seconds * rateHz)));
}

/// The sum of their squares. Any thread.
double energyOf(std::span<const double> samples);

/// From the onset of the loudest impact to where it falls below the noise, the next impact, or one second;
/// `samples` must not be empty. Message thread (M) only.
HitExcerpt strongestHit(const std::vector<float>& samples, double rateHz);

} // namespace physvib
