// SPDX-License-Identifier: MIT
// Bootstrap confidence interval of a mean over participants.
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
    double mean = 0.0, least = 0.0, most = 0.0; ///< all equal for a single participant
};

constexpr int bootstrapDraws = 4000;
/// Minimum sample size. With fewer, about one in some hundred resamples repeats a single participant and has
/// standard error 0.
constexpr std::size_t fewestDrawn = 6;

/// 95 % interval by studentised bootstrap (Efron 1981): each resampled mean is divided by its own standard
/// error, so intervals of small samples are not too narrow. With fewer than `fewestDrawn` values, Student's t
/// interval. The same seed gives identical bits. Any thread (allocates).
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
