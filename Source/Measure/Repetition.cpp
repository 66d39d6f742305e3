// SPDX-License-Identifier: MIT
// The autocorrelation of the slope: far from 0 what rings is gone, what repeats is not.
#include "Measure/Repetition.h"
#include "Measure/Peaks.h"
#include "Measure/ScrapePulses.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <cstddef>
#include <vector>

namespace physvib {
namespace {

/// Products of x with itself `lag` later, as shares of what the stronger of both parts has: what dies away is not alike.
std::vector<double> likenessOf(std::span<const double> x) {
    std::vector<double> likeness = autocorrelation(x), energy{0.0};
    for (const double sample : x) energy.push_back(energy.back() + sample * sample);
    for (std::size_t lag = 0; lag < likeness.size(); ++lag) {
        const double stronger = std::max(energy[x.size() - lag], energy[x.size()] - energy[lag]);
        likeness[lag] = stronger > 0.0 ? likeness[lag] / stronger : 0.0;
    }
    return likeness;
}

Peak highestWithin(std::span<const double> x, std::size_t from, std::size_t to) {
    return vertex(x, static_cast<std::size_t>(std::max_element(x.begin() + static_cast<std::ptrdiff_t>(from), x.begin() + static_cast<std::ptrdiff_t>(to)) - x.begin()));
}

} // namespace

double repetitionsPerSecond(std::span<const double> samples, double rateHz) {
    constexpr double smoothSeconds = 0.00025, leastLikeness = 0.6;
    const std::vector<double> slope = smoothSlope(samples, rateHz, smoothSeconds);
    if (slope.size() < 200) return 0.0;
    const auto likeness = likenessOf(std::span{slope}.subspan(slope.size() / 5)); // without what it begins with
    const std::size_t n = likeness.size();
    const double far = highestWithin(likeness, n / 4, n / 2).height; // what rings is not alike for so long
    if (far < leastLikeness) return 0.0;
    double lag = 0.0;
    for (std::size_t i = 1; lag == 0.0 && i + 1 < n / 2; ++i)
        if (isPeak(likeness, i))
            if (const Peak peak = vertex(likeness, i); peak.height >= 1.0 - 3.0 * (1.0 - far) - 0.003) lag = peak.at;
    for (double times = 2.0; lag > 4.0 && lag * times < 0.5 * static_cast<double>(n) - lag; times *= 2.0) // the longer, the finer
        lag = highestWithin(likeness, static_cast<std::size_t>((times - 0.25) * lag), static_cast<std::size_t>((times + 0.25) * lag) + 2).at / times;
    return lag > 4.0 ? rateHz / lag : 0.0;
}

} // namespace physvib
