// SPDX-License-Identifier: MIT
// Second-order filter section (biquad), and the mapping of analogue roots to its coefficients.
#pragma once
#include <cmath>
#include <complex>
#include <numbers>

namespace physvib {

/// 1 + first z^-1 + second z^-2.
struct RootPair {
    double first = 0.0, second = 0.0;

    /// The roots of s^2 + (w0/q) s + w0^2, each mapped to exp(s / rate). They lie in the unit circle, so both
    /// the section with these poles and its inverse are stable. Frequency warping is smaller than under the
    /// bilinear transform.
    static RootPair of(double frequencyHz, double q, double sampleRateHz) noexcept {
        const double angle = 2.0 * std::numbers::pi * frequencyHz / sampleRateHz, decay = 0.5 * angle / q;
        const double turn = angle * angle - decay * decay; // < 0: two real roots
        const double cosine = turn >= 0.0 ? std::cos(std::sqrt(turn)) : std::cosh(std::sqrt(-turn));
        return {-2.0 * std::exp(-decay) * cosine, std::exp(-2.0 * decay)};
    }

    /// The same roots under the bilinear transform, exact at `frequencyHz`: for slopes that reach 0 at half
    /// the rate.
    static RootPair bilinear(double frequencyHz, double q, double sampleRateHz) noexcept {
        const double k = std::tan(std::numbers::pi * frequencyHz / sampleRateHz), whole = 1.0 + k / q + k * k;
        return {2.0 * (k * k - 1.0) / whole, (1.0 - k / q + k * k) / whole};
    }

    std::complex<double> at(std::complex<double> zInverse) const noexcept {
        return 1.0 + zInverse * (first + zInverse * second);
    }
};

/// y = gain (1 + zeros) / (1 + poles) x, transposed direct form II.
class Biquad {
public:
    Biquad() = default;
    Biquad(double gain, RootPair zeros, RootPair poles) noexcept
        : gain_{gain}
        , zeros_{zeros}
        , poles_{poles} {}

    double process(double x) noexcept {
        x *= gain_;
        const double y = x + past_;
        past_ = older_ + zeros_.first * x - poles_.first * y;
        older_ = zeros_.second * x - poles_.second * y;
        return y;
    }

    void clear() noexcept { past_ = older_ = 0.0; }
    bool isAtRest() const noexcept { return past_ == 0.0 && older_ == 0.0; }
    void scale(double factor) noexcept { gain_ *= factor; }

    std::complex<double> at(double frequencyHz, double sampleRateHz) const noexcept {
        const auto zInverse = std::polar(1.0, -2.0 * std::numbers::pi * frequencyHz / sampleRateHz);
        return gain_ * zeros_.at(zInverse) / poles_.at(zInverse);
    }

private:
    double gain_ = 1.0;
    RootPair zeros_, poles_;
    double past_ = 0.0, older_ = 0.0;
};

} // namespace physvib
