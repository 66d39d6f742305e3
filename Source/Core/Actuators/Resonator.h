// SPDX-License-Identifier: MIT
// Linear model of a resonant actuator: a mass on a spring, driven by a force; the output is the acceleration
// of its case.
#pragma once
#include <complex>
#include <numbers>

namespace physvib {

/// H(s) = (1/Q) s^2 / (s^2 + (w0/Q) s + w0^2), w0 = 2 pi resonanceHz: acceleration per drive, 1 at the
/// resonance. Above it H falls to the plateau 1/Q, below it by 12 dB per octave. Valid for LRA, voice coil
/// and loaded piezo bender.
struct Resonator {
    double resonanceHz = 0.0; ///< > 0; 0: not known
    double q = 0.0;           ///< > 0; 0: not known

    bool isKnown() const noexcept { return resonanceHz > 0.0 && q > 0.0; }

    /// H at a frequency > 0. Any thread.
    std::complex<double> at(double frequencyHz) const noexcept {
        const double ratio = frequencyHz / resonanceHz;
        return -ratio * ratio / q / std::complex<double>(1.0 - ratio * ratio, ratio / q);
    }

    /// After the drive ends the vibration falls by exp(-t ringDownPerSecond): shorter decays are impossible
    /// without braking.
    double ringDownPerSecond() const noexcept { return std::numbers::pi * resonanceHz / q; }

    bool operator==(const Resonator&) const = default;
};

/// The frequency range that an actuator is meant to play.
struct FrequencyBand {
    double lowHz = 0.0, highHz = 0.0; ///< 0 < lowHz < highHz; 0, 0: not known
    bool isKnown() const noexcept { return lowHz > 0.0 && highHz > lowHz; }
    bool operator==(const FrequencyBand&) const = default;
};

} // namespace physvib
