// SPDX-License-Identifier: MIT
// Finds the pulses of grains above the noise, and corrects their number for those that were missed.
#include "Measure/GrainTrain.h"
#include "Contacts/Grains.h"
#include "Measure/Peaks.h"
#include "Measure/ScrapePulses.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace physvib {
namespace {

constexpr double narrowestSeconds = 0.000125, widestSeconds = 0.012;
constexpr double leastSkewness = 1.2;
constexpr std::size_t fewestGrains = 20;
constexpr double mostLost = 0.3;
constexpr double mostSpread = 0.8; // coefficient of variation of heights: random grains have 0.46, ringing of
                                   // another partial above 1

/// RMS of the negative values: noise is symmetric, pulses are positive.
double noiseOf(std::span<const double> x) {
    double sum = 0.0, count = 0.0;
    for (const double height : x)
        if (height < 0.0) sum += height * height, count += 1.0;
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

struct Standing {
    std::vector<Peak> peaks; ///< peaks above the threshold
    double threshold, mean;  ///< mean: estimated height of all grains, including those below the threshold
};

/// For uniformly distributed heights the mean above the threshold is (mean x most + threshold) / 2.
Standing standingOut(const std::vector<Peak>& peaks, double noise) {
    constexpr double most = GrainChance::leastStrength + GrainChance::strengthRange, sure = 5.0,
                     leastShare = 0.12;
    Standing out{{}, sure * noise, 0.0};
    for (int round = 0; round < 10; ++round) {
        out.peaks.clear();
        double sum = 0.0;
        for (const Peak& peak : peaks)
            if (peak.height > out.threshold) sum += peak.height, out.peaks.push_back(peak);
        if (out.peaks.size() < fewestGrains) break;
        const double seen = sum / static_cast<double>(out.peaks.size());
        out.mean = out.threshold > GrainChance::leastStrength * seen
                       ? std::max(0.3 * seen, (2.0 * seen - out.threshold) / most)
                       : seen;
        out.threshold = std::max(sure * noise, leastShare * out.mean);
    }
    return out;
}

double spreadOf(const std::vector<Peak>& peaks) {
    double sum = 0.0, squares = 0.0;
    for (const Peak& peak : peaks) sum += peak.height, squares += peak.height * peak.height;
    return std::sqrt(std::max(0.0, squares * static_cast<double>(peaks.size()) / (sum * sum) - 1.0));
}

/// Spacings of consecutive peaks, without pauses, which are longer than random spacings.
std::vector<double> gapsOf(const std::vector<Peak>& peaks) {
    constexpr double pause = 4.0; // medians
    std::vector<double> gaps;
    for (std::size_t i = 1; i < peaks.size(); ++i) gaps.push_back(peaks[i].at - peaks[i - 1].at);
    std::vector<double> sorted = gaps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::erase_if(gaps, [longest = pause * *middle](double gap) { return gap > longest; });
    return gaps;
}

double meanOf(const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double unevennessOf(const std::vector<double>& gaps) {
    const double mean = meanOf(gaps);
    double sum = 0.0;
    for (const double gap : gaps) sum += (gap / mean - 1.0) * (gap / mean - 1.0);
    return std::sqrt(sum / static_cast<double>(gaps.size()));
}

/// Share of random grains that follow the one before at less than this, in spacings: a difference of two
/// uniform distributions.
double nearerThan(double spacings) {
    constexpr double range = GrainChance::spacingRange;
    return std::pow(std::max(0.0, spacings - (1.0 - range)) / range, 2.0) / 2.0;
}

std::optional<GrainTrain> countedAt(std::span<const double> samples, double rateHz, double halfWidthSeconds) {
    const auto pulses = scrapePulses(samples, rateHz, halfWidthSeconds);
    if (!pulses || !(pulses->skewness >= leastSkewness)) return std::nullopt;
    const Standing out = standingOut(peaksOf(pulses->heights), noiseOf(pulses->heights));
    if (out.peaks.size() < fewestGrains || spreadOf(out.peaks) > mostSpread) return std::nullopt;
    GrainTrain train;
    train.frequencyHz = pulses->frequencyHz;
    train.decayPerSecond = pulses->decayPerSecond;
    train.counted = out.peaks.size();
    const std::vector<double> gaps = gapsOf(out.peaks);
    train.perSecond = pulses->heightsPerSecond / meanOf(gaps);
    train.unevenness = unevennessOf(gaps);
    const double weak = std::clamp(
        (out.threshold / out.mean - GrainChance::leastStrength) / GrainChance::strengthRange, 0.0, 0.95);
    constexpr double apart = 0.75; // of the half width: closer pulses merge
    const double near = nearerThan(apart * halfWidthSeconds * train.perSecond / (1.0 - weak));
    train.lostShare = weak + near;
    if (train.isEven()) { // ridges: all alike, and none close to another
        train.strength = 0.0;
        for (const Peak& peak : out.peaks) train.strength += peak.height / static_cast<double>(train.counted);
        return train;
    }
    train.strength = out.mean;
    train.perSecond *= (1.0 + near) / (1.0 - weak);
    return train;
}

} // namespace

std::optional<GrainTrain> grainTrain(std::span<const double> samples, double rateHz) {
    std::optional<GrainTrain> best;
    for (double width = narrowestSeconds; width < widestSeconds && !(best && best->lostShare == 0.0);
         width *= std::sqrt(2.0)) {
        const auto train = countedAt(samples, rateHz, width);
        if (train && train->lostShare <= mostLost && (!best || train->lostShare < best->lostShare))
            best = train;
    }
    return best;
}

} // namespace physvib
