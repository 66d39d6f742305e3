// SPDX-License-Identifier: MIT
// Hand-arm vibration exposure: the frequency weighting W_h of ISO 5349-1 at any sample rate, and the daily
// exposure A(8).
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/EventQueue.h"
#include "Core/Limits.h"
#include "Core/Units.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {
/// W_h by the standard's annex A: a second-order band-pass, times a transition from acceleration to velocity.
namespace handWeighting {
constexpr double lowHz = 6.310, highHz = 1258.9, bandQ = 0.70710678118654752; // 10^0.8 and 10^3.1 Hz
constexpr double transitionHz = 15.915, transitionQ = 0.64;                   // 100 rad/s

/// Magnitude of W_h. Any thread.
double gain(double frequencyHz) noexcept;
} // namespace handWeighting

// m/s^2, A(8) (directive 2002/44/EC)
constexpr double exposureActionMetresPerSecond2 = 2.5, exposureLimitMetresPerSecond2 = 5.0;
constexpr double exposureReferenceSeconds = 8.0 * 3600.0;

/// A(8) in m/s^2 from the integral of squared weighted acceleration, in g^2 s; and the inverse. Any thread.
inline double dailyExposure(double squareGSeconds) noexcept {
    return standardGravity * std::sqrt(squareGSeconds / exposureReferenceSeconds);
}
inline double squareGSecondsOf(double dailyExposure) noexcept {
    return dailyExposure * dailyExposure / (standardGravity * standardGravity) * exposureReferenceSeconds;
}

/// W_h as a filter: within 0.1 dB of gain() from 8 to 1000 Hz at every rate that limits:: allows. One thread.
class HandWeighting {
public:
    HandWeighting() = default;
    explicit HandWeighting(int sampleRateHz) noexcept;

    double process(double x) noexcept {
        for (Biquad& section : sections_) x = section.process(x);
        return x;
    }
    void clear() noexcept {
        for (Biquad& section : sections_) section.clear();
    }
    double gainAt(double frequencyHz) const noexcept; ///< Magnitude of the filter.

private:
    double sampleRateHz_ = 1.0;
    std::array<Biquad, 3> sections_;
};

/// Weighted sums of the samples that were sent, for vibration exposure. Per channel; 1 = full scale.
struct ExposureSums {
    using Channels = std::array<double, static_cast<std::size_t>(limits::maxActuators)>;
    Channels weighted{}; ///< integral of squared weighted samples over time, in s, since the meter was made
};

class ExposureMeter { // sums weighted samples per channel, for one reader on another thread
public:
    /// Keeps the sums. Message thread (M), not while the render thread (R) runs.
    void prepare(int sampleRateHz) noexcept {
        framesPerSecond_ = sampleRateHz;
        weightings_.fill(HandWeighting{sampleRateHz});
        isAtRest_.fill(true);
    }

    /// Adds the next samples of a channel, 1 to limits::maxBlockFrames. R, wait-free.
    void add(int channel, const float* samples, int frames) noexcept PHYSVIB_NONBLOCKING {
        const auto j = static_cast<std::size_t>(channel);
        const bool isSilent = std::all_of(samples, samples + frames, [](float x) { return x == 0.0f; });
        if (isSilent && isAtRest_[j]) return;
        double weighted = 0.0;
        for (int n = 0; n < frames; ++n) {
            const double w = weightings_[j].process(static_cast<double>(samples[n]));
            weighted += w * w;
        }
        sums_.weighted[j] += weighted / framesPerSecond_;
        isAtRest_[j] = isSilent && weighted < silentSquare * frames;
        if (isAtRest_[j]) weightings_[j].clear(); // before its tail becomes denormal
    }

    /// Publishes the sums so far. R, wait-free, once per block.
    void publish() noexcept PHYSVIB_NONBLOCKING { published_.write(sums_); }

    /// One reader on one other thread.
    const ExposureSums& read() noexcept { return published_.read(); }

private:
    static constexpr double silentSquare = 1e-24; // -240 dB

    double framesPerSecond_ = 1.0;
    std::array<HandWeighting, static_cast<std::size_t>(limits::maxActuators)> weightings_;
    std::array<bool, static_cast<std::size_t>(limits::maxActuators)> isAtRest_{};
    ExposureSums sums_;
    LatestValue<ExposureSums> published_;
};

} // namespace physvib
