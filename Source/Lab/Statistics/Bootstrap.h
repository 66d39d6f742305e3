// SPDX-License-Identifier: MIT
// Intervals of a mean over participants, by drawing participants again.
#pragma once
#include "Lab/Statistics/Moments.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
inline BootstrapInterval bootstrapMean(std::span<const double> values, std::uint64_t seed = 1) {
    const Moments moments{values};
    BootstrapInterval interval{moments.mean, moments.mean, moments.mean};
    if (moments.n < 2 || moments.deviation == 0.0) return interval;
    if (moments.n < fewestDrawn) {
        const double half = moments.halfInterval();
        return {moments.mean, moments.mean - half, moments.mean + half};
    }
    SeededRandom random{seed, "bootstrap"};
    std::vector<double> drawn(values.size()), distances;
    for (int draw = 0; draw < bootstrapDraws; ++draw) {
        for (double& value : drawn) value = values[random.below(values.size())];
        const Moments own{drawn};
        if (own.deviation > 0.0) distances.push_back((own.mean - moments.mean) / own.standardError());
    }
    std::ranges::sort(distances);
    const auto at = [&](double share) {
        return distances[static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1))];
    };
    interval.least = moments.mean - at(0.975) * moments.standardError();
    interval.most = moments.mean - at(0.025) * moments.standardError();
    return interval;
}

} // namespace physvib
