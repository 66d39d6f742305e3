// SPDX-License-Identifier: MIT
// Digital filter design of the hand-arm weighting W_h. The bilinear transform would warp frequencies above a
// tenth of the rate, by a decibel and more at 5 kHz. So poles are mapped exactly, and zeros are chosen so
// that the magnitude matches at three frequencies (after Vicanek 2016).
#include "Core/Actuators/Exposure.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <numbers>

namespace physvib {
namespace {

using namespace handWeighting;
using Complex = std::complex<double>;

Complex pole(Complex s, double hz, double q) noexcept {
    const double w = 2.0 * std::numbers::pi * hz;
    return s * s + s * (w / q) + w * w;
}

Complex laplace(double hz) noexcept { return {0.0, 2.0 * std::numbers::pi * hz}; }

double highPass(double hz) noexcept {
    return std::abs(laplace(hz) * laplace(hz) / pole(laplace(hz), lowHz, bandQ));
}

double lowPass(double hz) noexcept {
    return std::abs(pole(0.0, highHz, bandQ) / pole(laplace(hz), highHz, bandQ));
}

double transition(double hz) noexcept {
    const double w = 2.0 * std::numbers::pi * transitionHz;
    return std::abs((laplace(hz) + w) * w / pole(laplace(hz), transitionHz, transitionQ));
}

/// Section with these poles whose magnitude matches at 0 Hz, `lowHz` and `highHz`.
Biquad matched(RootPair poles, double rateHz, double (*magnitude)(double), double lowHz,
               double highHz) noexcept {
    const auto squareAt = [&](double f) {
        const double target =
            magnitude(f) *
            std::abs(poles.at(portable::exp(std::complex{0.0, -2.0 * std::numbers::pi * f / rateHz})));
        return target * target;
    };
    // |b0 + b1 z^-1 + b2 z^-2|^2 = atZero (1 - p) + atTop p + 4 bend p (1 - p), p = sin^2(w / 2)
    const double atZero = squareAt(0.0),
                 low = portable::pow(portable::sin(std::numbers::pi * lowHz / rateHz), 2),
                 high = portable::pow(portable::sin(std::numbers::pi * highHz / rateHz), 2);
    const double lowRest = squareAt(lowHz) / low - atZero * (1.0 - low) / low,
                 highRest = squareAt(highHz) / high - atZero * (1.0 - high) / high;
    const double bend = 0.25 * (lowRest - highRest) / (high - low),
                 atTop = std::max(0.0, lowRest - 4.0 * bend * (1.0 - low));
    const double even = 0.5 * (std::sqrt(atZero) + std::sqrt(atTop)),
                 odd = 0.5 * (std::sqrt(atZero) - std::sqrt(atTop));
    const double first = 0.5 * (even + std::sqrt(std::max(0.0, even * even + bend)));
    return {first, {odd / first, -0.25 * bend / (first * first)}, poles};
}

} // namespace

double handWeighting::gain(double hz) noexcept { return highPass(hz) * lowPass(hz) * transition(hz); }

HandWeighting::HandWeighting(int sampleRateHz) noexcept
    : sampleRateHz_{static_cast<double>(sampleRateHz)} {
    const RootPair low = RootPair::bilinear(lowHz, bandQ, sampleRateHz_);
    // 1 at half the rate; warping is negligible at such low frequencies
    sections_ = {
        Biquad{0.25 * (1.0 - low.first + low.second), {-2.0, 1.0}, low},
        matched(RootPair::exact(highHz, bandQ, sampleRateHz_), sampleRateHz_, lowPass, 0.5 * highHz, highHz),
        matched(RootPair::exact(transitionHz, transitionQ, sampleRateHz_), sampleRateHz_, transition,
                transitionHz, highHz)};
}

double HandWeighting::gainAt(double hz) const noexcept {
    double product = 1.0;
    for (const Biquad& section : sections_) product *= std::abs(section.at(hz, sampleRateHz_));
    return product;
}

} // namespace physvib
