// SPDX-License-Identifier: MIT
// Intervals of a mean over participants, by drawing participants again.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace physvib {

struct BootstrapInterval {
    double mean = 0.0, least = 0.0, most = 0.0; ///< all alike where there is one participant
};

constexpr int bootstrapDraws = 4000;
/// Of fewer, one in some hundred draws is one participant again and again, with a standard error of nothing.
constexpr std::size_t fewestDrawn = 6;

/// 95 %, by studentised resampling (Efron 1981): each draw's mean counts in units of its own standard error,
/// so that few participants are not taken for too sure. Of fewer than `fewestDrawn` by Student's t. The same
/// seed gives the same bits. Any thread (allocates).
BootstrapInterval bootstrapMean(std::span<const double> values, std::uint64_t seed = 1);

} // namespace physvib
