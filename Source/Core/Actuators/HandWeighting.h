// SPDX-License-Identifier: MIT
// Hand-arm vibration exposure: the frequency weighting W_h of ISO 5349-1 at any sample rate, and the daily
// exposure A(8).
#pragma once
#include "Core/Actuators/Biquad.h"
#include "Core/StandardGravity.h"
#include <array>
#include <cmath>

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

} // namespace physvib
