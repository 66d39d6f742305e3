// SPDX-License-Identifier: MIT
// Prepares recordings: finds the strongest impact, checks the samples, removes the slow part.
#pragma once
#include "Core/Samples.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace physvib {
constexpr double onsetReachSeconds = 0.02; ///< from a peak back to its onset: a quarter period of 12 Hz

struct HitExcerpt {
    std::size_t begin = 0, end = 0; ///< samples
    double offset = 0.0;            ///< mean before the impact
};

/// Number of samples in that time, at least one.
inline std::size_t toSamples(double seconds, double rateHz) noexcept {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(seconds * rateHz)));
}

/// Sum of the squared samples. Any thread.
double signalEnergy(std::span<const double> samples);

/// The excerpt from the onset of the loudest impact to the noise, the next impact, or one second;
/// `samples` must not be empty. Message thread (M) only.
HitExcerpt strongestHit(const std::vector<float>& samples, double rateHz);

/// The channel with the highest peak; `channels` are not empty. Any thread.
inline const std::vector<float>& loudestChannel(const std::vector<std::vector<float>>& channels) {
    return *std::ranges::max_element(channels, {}, [](const auto& samples) { return peakOf(samples); });
}

// Checks whether a recording can be measured: too short, not finite, clipped. Message thread (M) only.

inline std::string timeText(std::size_t sample, double rateHz) {
    return " at " + fixedNumber(static_cast<double>(sample) / rateHz, 4) + " s";
}

/// Empty, or the error that the recording is clipped: three equal samples at the peak between steep flanks.
/// Rounding flattens peaks too, but then the next sample is only a few steps lower; `step` is the smallest
/// difference in the recording.
inline std::string clippingError(const std::vector<float>& x, double rateHz) {
    float peak = 0.0f, step = HUGE_VALF;
    for (std::size_t i = 0; i < x.size(); ++i) {
        peak = std::max(peak, std::abs(x[i]));
        if (i > 0 && x[i] != x[i - 1]) step = std::min(step, std::abs(x[i] - x[i - 1]));
    }
    for (std::size_t i = 0; i + 2 < x.size(); ++i) {
        if (std::abs(x[i]) < peak || x[i + 1] != x[i] || x[i + 2] != x[i]) continue;
        std::size_t plateauEnd = i + 3;
        while (plateauEnd < x.size() && x[plateauEnd] == x[i]) ++plateauEnd;
        const float rise = i > 0 ? std::abs(x[i] - x[i - 1]) : 0.0f,
                    fall = plateauEnd < x.size() ? std::abs(x[i] - x[plateauEnd]) : 0.0f;
        if (std::max(rise, fall) > 8.0f * step)
            return "expected a recording that is not clipped, found " + std::to_string(plateauEnd - i) +
                   " equal samples at its peak" + timeText(i, rateHz);
        i = plateauEnd;
    }
    return {};
}

/// True if all samples are equal.
inline bool isSilent(const std::vector<float>& x) {
    return std::ranges::all_of(x, [&](float s) { return s == x.front(); });
}

inline std::string nonFiniteError(float x, std::size_t sample, double rateHz) {
    return "expected finite samples, found " + std::string(std::isnan(x) ? "NaN" : "infinity") +
           timeText(sample, rateHz);
}

/// Empty, or the error that it is too short or has NaN, infinite or huge samples.
inline std::string recordingError(const std::vector<float>& x, double rateHz, double minSeconds) {
    if (static_cast<double>(x.size()) < minSeconds * rateHz)
        return "expected at least " + numberText(minSeconds) + " s, found " + std::to_string(x.size()) +
               (x.size() == 1 ? " sample" : " samples");
    const auto bad = std::ranges::find_if(x, [](float s) { return !std::isfinite(s) || std::abs(s) > 1e6f; });
    return bad == x.end() ? "" : nonFiniteError(*bad, static_cast<std::size_t>(bad - x.begin()), rateHz);
}

/// The removed part below limits::slowestToneHz, which is imperceptible and only heats a coil, in shares of
/// full scale; 0: too little, and the samples are unchanged.
struct SlowPart {
    static constexpr double windowSeconds = 0.2; ///< a period of limits::slowestToneHz; shorter: no slow part
    static constexpr double minMean = 0.01, minVarying = 0.1;

    double mean = 0.0;    ///< maximum over the channels, like `varying`
    double varying = 0.0; ///< peak of the varying part below that frequency

    bool isPresent() const noexcept { return mean != 0.0 || varying != 0.0; }
    void mergeMax(const SlowPart& other) noexcept {
        mean = std::max(mean, other.mean);
        varying = std::max(varying, other.varying);
    }
    /// A note for the user; empty if nothing was removed. Any thread.
    std::string text() const;
};

/// Subtracts the mean, and then, if it reaches minVarying, what is left below limits::slowestToneHz: a
/// running mean over windowSeconds with triangular weights (-4.5 dB at 5 Hz, -18 dB at 2 Hz, -30 dB at 1 Hz;
/// within 0.5 dB from 10 Hz on). `fullScale`: the sample value that is played as full scale. Not for the
/// render thread (allocates).
SlowPart removeSlowPart(std::vector<float>& samples, double sampleRateHz, double fullScale = 1.0);

} // namespace physvib
