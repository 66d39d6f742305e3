// SPDX-License-Identifier: MIT
// Bootstrap confidence interval of a mean over participants.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace physvib {

struct BootstrapInterval {
    double mean = 0.0, least = 0.0, most = 0.0; ///< all equal for a single participant
};

constexpr int bootstrapDraws = 4000;
/// Minimum sample size. With fewer, about one in some hundred resamples repeats a single participant and has
/// standard error 0.
constexpr std::size_t fewestDrawn = 6;

/// 95 % interval by studentised bootstrap (Efron 1981): each resampled mean is divided by its own standard
/// error, so intervals of small samples are not too narrow. With fewer than `fewestDrawn` values, Student's t
/// interval. The same seed gives identical bits. Any thread (allocates).
BootstrapInterval bootstrapMean(std::span<const double> values, std::uint64_t seed = 1);

} // namespace physvib
