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
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

namespace physvib {
/// W_h as in the standard's annex A: a second-order band-pass, times a transition from acceleration to
/// velocity.
namespace handWeighting {
constexpr double lowHz = 6.310, highHz = 1258.9, bandQ = 0.70710678118654752; // 10^0.8 and 10^3.1 Hz
constexpr double transitionHz = 15.915, transitionQ = 0.64;                   // 100 rad/s

/// Magnitude of W_h. Any thread.
double gain(double frequencyHz) noexcept;
} // namespace handWeighting

// m/s^2, A(8) (directive 2002/44/EC)
constexpr double exposureActionValue = 2.5, exposureLimitValue = 5.0;
constexpr double exposureReferenceSeconds = 8.0 * 3600.0;

/// A(8) in m/s^2 from the integral of squared weighted acceleration, in g^2 s; and the inverse. Any thread.
inline double dailyExposure(double squareGSeconds) noexcept {
    return standardGravity * std::sqrt(squareGSeconds / exposureReferenceSeconds);
}
inline double squareGSecondsOf(double dailyExposure) noexcept {
    return dailyExposure * dailyExposure / (standardGravity * standardGravity) * exposureReferenceSeconds;
}

/// W_h as a filter: within 0.1 dB of gain() from 8 to 1000 Hz at every rate that limits:: allows. One thread
/// at a time.
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
    double gainAt(double frequencyHz) const noexcept;

private:
    double sampleRateHz_ = 1.0;
    std::array<Biquad, 3> sections_;
};

// Meter of the samples that were sent to the actuators: weighted sums for vibration exposure, unweighted sums
// and peaks for levels.

/// Per channel; 1 = full scale.
struct ExposureSums {
    using Channels = std::array<double, static_cast<std::size_t>(limits::maxEnchanters)>;
    Channels weighted{}; ///< integral of squared weighted samples over time, in s, since the meter was made
    Channels plain{}, peaks{}; ///< integral of squared unweighted samples, and the largest sample, of the
                               ///< span of `mark`
    std::uint32_t mark = 0;
    std::int64_t until = 0; ///< the place up to which all samples were taken
};

/// Places of samples, such as frames of a session.
struct SampleSpan {
    std::int64_t from = std::numeric_limits<std::int64_t>::min(),
                 to = std::numeric_limits<std::int64_t>::max();
};

class ExposureMeter {
public:
    /// Keeps the sums. Message thread (M), not while the render thread (R) runs.
    void prepare(int sampleRateHz) noexcept {
        framesPerSecond_ = sampleRateHz;
        weightings_.fill(HandWeighting{sampleRateHz});
        isAtRest_.fill(true);
    }

    /// Adds the next samples of a channel, 1 to limits::maxBlockFrames; the first is at that place. R,
    /// wait-free.
    void take(int channel, const float* samples, int frames,
              std::int64_t place = 0) noexcept PHYSVIB_NONBLOCKING {
        const auto j = static_cast<std::size_t>(channel);
        startAgainIfTold();
        const bool isSilent = std::all_of(samples, samples + frames, [](float x) { return x == 0.0f; });
        if (isSilent && isAtRest_[j]) return;
        double weighted = 0.0, plain = 0.0, peak = sums_.peaks[j];
        for (int n = 0; n < frames; ++n) {
            const auto x = static_cast<double>(samples[n]);
            const double w = weightings_[j].process(x);
            weighted += w * w;
            if (place + n < span_.from || place + n >= span_.to) continue;
            plain += x * x;
            peak = std::max(peak, std::abs(x));
        }
        sums_.weighted[j] += weighted / framesPerSecond_;
        sums_.plain[j] += plain / framesPerSecond_;
        sums_.peaks[j] = peak;
        isAtRest_[j] = isSilent && weighted < faded * frames;
        if (isAtRest_[j]) weightings_[j].clear(); // before its tail becomes denormal
    }

    /// Publishes the sums so far, of all samples before that place. R, wait-free, once per block.
    void publish(std::int64_t until = 0) noexcept PHYSVIB_NONBLOCKING {
        startAgainIfTold();
        sums_.until = until;
        published_.write(sums_);
    }

    /// One reader on one other thread.
    const ExposureSums& read() noexcept { return published_.read(); }

    /// Restarts unweighted sums and peaks with the next block, of the samples in `span`; they then carry the
    /// returned mark. The reader's thread, wait-free.
    std::uint32_t restart(const SampleSpan& span = {}) noexcept {
        from_.store(span.from, std::memory_order_relaxed);
        to_.store(span.to, std::memory_order_relaxed);
        return wanted_.fetch_add(1, std::memory_order_release) + 1;
    }

private:
    static constexpr double faded = 1e-24; // -240 dB

    void startAgainIfTold() noexcept {
        const auto wanted = wanted_.load(std::memory_order_acquire);
        if (wanted == sums_.mark) return;
        sums_.mark = wanted;
        sums_.plain = sums_.peaks = {};
        span_ = {from_.load(std::memory_order_relaxed), to_.load(std::memory_order_relaxed)};
    }

    double framesPerSecond_ = 1.0;
    std::array<HandWeighting, static_cast<std::size_t>(limits::maxEnchanters)> weightings_;
    std::array<bool, static_cast<std::size_t>(limits::maxEnchanters)> isAtRest_{};
    ExposureSums sums_;
    LatestValue<ExposureSums> published_;
    std::atomic<std::uint32_t> wanted_{0};
    std::atomic<std::int64_t> from_{0}, to_{0}; // of the wanted mark
    SampleSpan span_;
};

} // namespace physvib
