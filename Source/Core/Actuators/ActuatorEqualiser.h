// SPDX-License-Identifier: MIT
// Equaliser that makes a resonant actuator flat within its band: the input is the acceleration, in units of
// the full scale at resonance.
//
// The plain inverse of the resonance (Resonator) would boost without bound. So E(s) = HP(s)
// LP(s) / H(s), with Butterworth slopes whose corners lie outside the band: the band is flat and frequencies
// beyond it are not driven. All sections have their zeros and poles in the unit circle (or on it at 0 Hz and
// half the rate): stable and minimal-phase.
#pragma once
#include "Core/Limits.h"
#include "Core/PortableMath.h"
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace physvib {

/// Half of a second-order filter section (biquad): 1 + first z^-1 + second z^-2.
struct RootPair {
    double first = 0.0, second = 0.0;

    /// The roots of s^2 + (w0/q) s + w0^2, each mapped to exp(s / rate). They lie in the unit circle, so both
    /// the section with these poles and its inverse are stable. Frequency warping is smaller than under the
    /// bilinear transform.
    static RootPair exact(double frequencyHz, double q, double sampleRateHz) noexcept {
        const double angle = 2.0 * std::numbers::pi * frequencyHz / sampleRateHz, decay = 0.5 * angle / q;
        const double turn = angle * angle - decay * decay; // < 0: two real roots
        const double cosine = turn >= 0.0 ? portable::cos(std::sqrt(turn)) : portable::cosh(std::sqrt(-turn));
        return {-2.0 * portable::exp(-decay) * cosine, portable::exp(-2.0 * decay)};
    }

    /// The same roots under the bilinear transform, exact at `frequencyHz`: for slopes to 0 at half the rate.
    static RootPair bilinear(double frequencyHz, double q, double sampleRateHz) noexcept {
        const double k = portable::tan(std::numbers::pi * frequencyHz / sampleRateHz),
                     scale = 1.0 + k / q + k * k;
        return {2.0 * (k * k - 1.0) / scale, (1.0 - k / q + k * k) / scale};
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
        const double y = x + state1_;
        state1_ = state2_ + zeros_.first * x - poles_.first * y;
        state2_ = zeros_.second * x - poles_.second * y;
        return y;
    }

    void clear() noexcept { state1_ = state2_ = 0.0; }
    bool isAtRest() const noexcept { return state1_ == 0.0 && state2_ == 0.0; }
    void scale(double factor) noexcept { gain_ *= factor; }

    std::complex<double> at(double frequencyHz, double sampleRateHz) const noexcept {
        const auto zInverse =
            portable::exp(std::complex{0.0, -2.0 * std::numbers::pi * frequencyHz / sampleRateHz});
        return gain_ * portable::quotient(zeros_.at(zInverse), poles_.at(zInverse));
    }

private:
    double gain_ = 1.0;
    RootPair zeros_, poles_;
    double state1_ = 0.0, state2_ = 0.0;
};

/// Linear model of a resonant actuator: a mass on a spring, driven by a force. The output is its case's
/// acceleration. H(s) = (1/Q) s^2 / (s^2 + (w0/Q) s + w0^2), w0 = 2 pi resonanceHz: acceleration per drive, 1
/// at the resonance. Above it H falls to the plateau 1/Q, below it by 12 dB per octave. Valid for LRA, voice
/// coil and loaded piezo bender.
struct Resonator {
    double resonanceHz = 0.0; ///< > 0; 0: not known
    double q = 0.0;           ///< > 0; 0: not known

    bool isKnown() const noexcept { return resonanceHz > 0.0 && q > 0.0; }

    /// H at a frequency > 0. Any thread.
    std::complex<double> at(double frequencyHz) const noexcept {
        const double ratio = frequencyHz / resonanceHz;
        return portable::quotient(-ratio * ratio / q, {1.0 - ratio * ratio, ratio / q});
    }

    /// After the drive the vibration falls by exp(-t ringDownPerSecond): shorter decays would need braking.
    double ringDownPerSecond() const noexcept { return std::numbers::pi * resonanceHz / q; }

    bool operator==(const Resonator&) const = default;
};

/// The frequency range that an actuator is meant to play.
struct FrequencyBand {
    double lowHz = 0.0, highHz = 0.0; ///< 0 < lowHz < highHz; 0, 0: not known
    bool isKnown() const noexcept { return lowHz > 0.0 && highHz > lowHz; }
    bool operator==(const FrequencyBand&) const = default;
};

/// Resonance and band that a channel is equalised for; without figures it is not equalised.
struct EqualisedActuator {
    Resonator resonator;
    FrequencyBand band;
    bool isKnown() const noexcept { return resonator.isKnown() && band.isKnown(); }
    bool operator==(const EqualisedActuator&) const = default;
};
using EqualisedActuators = std::array<EqualisedActuator, limits::maxActuators>;

/// Equaliser of one channel. Render thread (R) only; construction and figures: any thread.
class ActuatorEqualiser {
public:
    ActuatorEqualiser() = default; ///< Passes everything unchanged.

    /// Without figures, or with a band that does not lie below half the rate, it passes everything unchanged.
    ActuatorEqualiser(const EqualisedActuator& actuator, int sampleRateHz) noexcept;

    bool isOn() const noexcept { return sectionCount_ > 0; }

    /// In place. `isSilent`: all input is 0. True if all output is 0.
    bool process(float* io, int frames, bool isSilent) noexcept;

    /// Frequency response E at a frequency.
    std::complex<double> at(double frequencyHz) const noexcept;

    /// The largest amplitude, in units of full scale at resonance, that every frequency of the band can have
    /// while its drive stays within `driveLimit`; 0 if the equaliser is off.
    double flatLevel(double driveLimit = 1.0) const noexcept;

private:
    static constexpr std::size_t maxSections = 6;
    bool isAtRest() const noexcept;
    std::array<Biquad, maxSections> sections_{};
    int sectionCount_ = 0;
    double sampleRateHz_ = 0.0;
    FrequencyBand band_;
};

} // namespace physvib
