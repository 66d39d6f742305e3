// SPDX-License-Identifier: MIT
// Resamples with replacement, with a fixed stream of random numbers.
#include "Lab/Statistics/Bootstrap.h"
#include "Lab/Statistics/Moments.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <vector>

namespace physvib {

BootstrapInterval bootstrapMean(std::span<const double> values, std::uint64_t seed) {
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
