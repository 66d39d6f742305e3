// SPDX-License-Identifier: MIT
// Finds the strongest impact by comparing levels of short frames with the quietest part of the recording.
#include "Measure/HitExcerpt.h"

namespace physvib {

double energyOf(std::span<const double> samples) {
    double sum = 0.0;
    for (const double x : samples) sum += x * x;
    return sum;
}

namespace {

constexpr double longestHitSeconds = 1.0;   // long enough to estimate a slower decay
constexpr double frameSeconds = 0.025;      // a period of 40 Hz, so that power does not ripple
constexpr double leastBeforeSeconds = 0.01; // a shorter silence is too short to estimate an offset

double power(std::span<const double> samples) {
    return energyOf(samples) / static_cast<double>(samples.size());
}

/// Power of the quietest twentieth of the recording; 0 if it is too short for an estimate.
double noisePower(const std::vector<double>& samples, std::size_t frame) {
    std::vector<double> powers;
    for (std::size_t i = 0; i + frame <= samples.size(); i += frame)
        powers.push_back(power(std::span(samples).subspan(i, frame)));
    if (powers.size() < 4) return 0.0;
    const auto low = powers.begin() + static_cast<std::ptrdiff_t>(powers.size() / 20);
    std::ranges::nth_element(powers, low);
    return *low;
}

/// The mean; 0 if noise alone explains it, because subtracting it would then add noise.
double offsetOf(std::span<const double> samples) {
    double mean = 0.0;
    for (const double x : samples) mean += x / static_cast<double>(samples.size());
    return mean * mean > 9.0 * power(samples) / static_cast<double>(samples.size()) ? mean : 0.0;
}

std::size_t loudest(const std::vector<double>& samples) {
    return static_cast<std::size_t>(
        std::ranges::max_element(samples, {}, [](double s) { return std::abs(s); }) - samples.begin());
}

/// First sample near the peak that exceeds the noise and a fiftieth of the peak.
std::size_t firstLoud(const std::vector<double>& samples, std::size_t peak, double noise, double rateHz) {
    const double threshold = std::max(4.0 * std::sqrt(noise), 0.02 * std::abs(samples[peak]));
    std::size_t first = peak - std::min(peak, samplesIn(onsetReachSeconds, rateHz));
    while (first < peak && std::abs(samples[first]) < threshold) ++first;
    return first;
}

/// Where the noise begins, or the next impact: ten times the lowest power so far, and not far below the
/// highest.
std::size_t endOf(const std::vector<double>& samples, std::size_t begin, double noise, double rateHz) {
    const std::size_t frame = samplesIn(frameSeconds, rateHz),
                      most = std::min(samples.size(), begin + samplesIn(longestHitSeconds, rateHz));
    double least = HUGE_VAL, highest = 0.0;
    for (std::size_t i = begin; i + frame <= most; i += frame) {
        const double now = power(std::span(samples).subspan(i, frame));
        highest = std::max(highest, now);
        if (i > begin && now < 1.2 * noise) return i + frame;
        if (now > 10.0 * least && now > 0.01 * highest) return i;
        least = std::min(least, now);
    }
    return most;
}

} // namespace

HitExcerpt strongestHit(const std::vector<float>& samples, double rateHz) {
    std::vector<double> x(samples.begin(), samples.end());
    const std::size_t peak = loudest(x), quiet = peak - std::min(peak, samplesIn(onsetReachSeconds, rateHz));
    HitExcerpt hit;
    if (quiet >= samplesIn(leastBeforeSeconds, rateHz)) hit.offset = offsetOf(std::span(x).first(quiet));
    for (double& s : x) s -= hit.offset;
    const double noise = noisePower(x, samplesIn(0.4 * frameSeconds, rateHz));
    hit.begin = firstLoud(x, loudest(x), noise, rateHz);
    hit.end = endOf(x, hit.begin, noise, rateHz);
    return hit;
}

} // namespace physvib
