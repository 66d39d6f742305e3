// SPDX-License-Identifier: MIT
// Finds impacts by levels of short frames against the quietest part; removes slow parts by running means.
#include "Measure/HitExcerpt.h"
#include "Core/Limits.h"

namespace physvib {
double signalEnergy(std::span<const double> samples) {
    double sum = 0.0;
    for (const double x : samples) sum += x * x;
    return sum;
}

namespace {

constexpr double maxHitSeconds = 1.0;      // long enough to estimate a slower decay
constexpr double frameSeconds = 0.025;     // a period of 40 Hz, so that power does not ripple
constexpr double minSilenceSeconds = 0.01; // a shorter silence is too short to estimate an offset

double power(std::span<const double> samples) {
    return signalEnergy(samples) / static_cast<double>(samples.size());
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
double estimateOffset(std::span<const double> samples) {
    double mean = 0.0;
    for (const double x : samples) mean += x / static_cast<double>(samples.size());
    return mean * mean > 9.0 * power(samples) / static_cast<double>(samples.size()) ? mean : 0.0;
}

std::size_t peakIndex(const std::vector<double>& samples) {
    return static_cast<std::size_t>(
        std::ranges::max_element(samples, {}, [](double s) { return std::abs(s); }) - samples.begin());
}

/// First sample near the peak that exceeds the noise and a fiftieth of the peak.
std::size_t onsetIndex(const std::vector<double>& samples, std::size_t peak, double noise, double rateHz) {
    const double threshold = std::max(4.0 * std::sqrt(noise), 0.02 * std::abs(samples[peak]));
    std::size_t first = peak - std::min(peak, toSamples(onsetReachSeconds, rateHz));
    while (first < peak && std::abs(samples[first]) < threshold) ++first;
    return first;
}

/// End of the impact: where the noise begins, or the next impact, with ten times the lowest power so far.
std::size_t endIndex(const std::vector<double>& samples, std::size_t begin, double noise, double rateHz) {
    const std::size_t frame = toSamples(frameSeconds, rateHz),
                      endLimit = std::min(samples.size(), begin + toSamples(maxHitSeconds, rateHz));
    double minPower = HUGE_VAL, maxPower = 0.0;
    for (std::size_t i = begin; i + frame <= endLimit; i += frame) {
        const double framePower = power(std::span(samples).subspan(i, frame));
        maxPower = std::max(maxPower, framePower);
        if (i > begin && framePower < 1.2 * noise) return i + frame;
        if (framePower > 10.0 * minPower && framePower > 0.01 * maxPower) return i;
        minPower = std::min(minPower, framePower);
    }
    return endLimit;
}

} // namespace

HitExcerpt strongestHit(const std::vector<float>& samples, double rateHz) {
    std::vector<double> x(samples.begin(), samples.end());
    const std::size_t peak = peakIndex(x),
                      quietSamples = peak - std::min(peak, toSamples(onsetReachSeconds, rateHz));
    HitExcerpt hit;
    if (quietSamples >= toSamples(minSilenceSeconds, rateHz))
        hit.offset = estimateOffset(std::span(x).first(quietSamples));
    for (double& s : x) s -= hit.offset;
    const double noise = noisePower(x, toSamples(0.4 * frameSeconds, rateHz));
    hit.begin = onsetIndex(x, peakIndex(x), noise, rateHz);
    hit.end = endIndex(x, hit.begin, noise, rateHz);
    return hit;
}

// Removes the slow part of samples: subtracts the mean, then a triangular running mean, computed as two
// running means in a row.

namespace {

/// View of samples in which values that are not finite count as 0, as in the limiter, and large values are
/// clamped to keep running sums exact.
class ClampedSamples {
public:
    ClampedSamples(std::span<const float> samples, double fullScale)
        : samples_{samples}
        , limit_{limits::maxAmplitude * fullScale} {}

    std::ptrdiff_t count() const { return std::ssize(samples_); }
    /// 0 before the first and after the last sample.
    double at(std::ptrdiff_t i) const {
        if (i < 0 || i >= count()) return 0.0;
        const double sample = samples_[static_cast<std::size_t>(i)];
        return std::isfinite(sample) ? std::clamp(sample, -limit_, limit_) : 0.0;
    }
    double mean() const {
        double sum = 0.0;
        for (std::ptrdiff_t i = 0; i < count(); ++i) sum += at(i);
        return sum / static_cast<double>(count());
    }

private:
    std::span<const float> samples_;
    double limit_;
};

/// The triangular running mean, sample by sample.
class RunningMean {
public:
    RunningMean(const ClampedSamples& samples, double sampleRateHz)
        : samples_{samples}
        , reach_{std::lround(0.25 * SlowPart::windowSeconds * sampleRateHz)}
        , next_{-2 * reach_} {
        while (next_ < 0) next();
    }

    /// The mean at the next sample; the first call is for the first sample.
    double next() {
        ahead_ += samples_.at(next_ + 2 * reach_) - samples_.at(next_ - 1);
        behind_ += samples_.at(next_ - 1) - samples_.at(next_ - 2 * reach_ - 2);
        sum_ += ahead_ - behind_;
        ++next_;
        const auto width = static_cast<double>(2 * reach_ + 1);
        return sum_ / (width * width);
    }

private:
    ClampedSamples samples_;
    std::ptrdiff_t reach_, next_;
    double ahead_ = 0.0, behind_ = 0.0; // sums of the 2 reach_ + 1 samples around next_ + reach_ and next_ -
                                        // reach_ - 1
    double sum_ = 0.0;                  // of the 2 reach_ + 1 such sums around next_
};

} // namespace

SlowPart removeSlowPart(std::vector<float>& samples, double sampleRateHz, double fullScale) {
    SlowPart removed;
    if (!(fullScale > 0.0) || static_cast<double>(samples.size()) < SlowPart::windowSeconds * sampleRateHz)
        return removed;
    const ClampedSamples clamped{samples, fullScale};
    if (const double mean = clamped.mean(); std::abs(mean) >= SlowPart::minMean * fullScale) {
        removed.mean = std::abs(mean) / fullScale;
        for (float& x : samples) x = static_cast<float>(x - mean);
    }
    double slowPeak = 0.0;
    RunningMean peakPass{clamped, sampleRateHz};
    for (std::size_t i = 0; i < samples.size(); ++i) slowPeak = std::max(slowPeak, std::abs(peakPass.next()));
    if (slowPeak < SlowPart::minVarying * fullScale) return removed;
    removed.varying = slowPeak / fullScale;
    std::vector<float> filtered(samples.size());
    RunningMean filterPass{clamped, sampleRateHz};
    for (std::size_t i = 0; i < samples.size(); ++i)
        filtered[i] = static_cast<float>(samples[i] - filterPass.next());
    samples = std::move(filtered);
    return removed;
}

std::string SlowPart::text() const {
    if (!isPresent()) return {};
    const std::string meanText = mean != 0.0 ? "a mean of " + fixedNumber(mean, 2) : "",
                      varyingText = varying != 0.0 ? "up to " + fixedNumber(varying, 2) +
                                                         (mean != 0.0 ? " beside it" : "")
                                                   : "";
    return "what lies below " + numberText(limits::slowestToneHz) + " Hz is not played: " + meanText +
           (mean != 0.0 && varying != 0.0 ? ", and " : "") + varyingText + ", of full scale";
}

} // namespace physvib
