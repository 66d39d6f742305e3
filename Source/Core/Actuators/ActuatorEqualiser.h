// SPDX-License-Identifier: MIT
// Equaliser that makes a resonant actuator flat within its band: the input is the acceleration, in units of
// the full scale at resonance.
//
// The plain inverse of the resonance (Core/Actuators/Resonator.h) would boost without bound. So E(s) = HP(s)
// LP(s) / H(s), with Butterworth slopes whose corners lie outside the band: the band is flat and frequencies
// beyond it are not driven. All sections have their zeros and poles in the unit circle (or on it at 0 Hz and
// half the rate): stable and minimal-phase.
#pragma once
#include "Core/Actuators/Biquad.h"
#include "Core/Actuators/Resonator.h"
#include "Core/Limits.h"
#include <array>

namespace physvib {

/// Resonance and band that a channel is equalised for; without figures it is not equalised.
struct EqualisedActuator {
    Resonator resonator;
    FrequencyBand band;
    bool isKnown() const noexcept { return resonator.isKnown() && band.isKnown(); }
    bool operator==(const EqualisedActuator&) const = default;
};
using EqualisedActuators = std::array<EqualisedActuator, limits::maxEnchanters>;

/// One channel. Render thread (R) only; construction and figures: any thread.
class ActuatorEqualiser {
public:
    /// Passes everything unchanged.
    ActuatorEqualiser() = default;

    /// Without figures, or with a band that does not lie below half the rate, it passes everything unchanged.
    ActuatorEqualiser(const EqualisedActuator& actuator, int sampleRateHz) noexcept;

    bool isOn() const noexcept { return sections_ > 0; }

    /// In place. `isSilent`: all input is 0. True if all output is 0.
    bool process(float* io, int frames, bool isSilent) noexcept;

    /// Frequency response E at a frequency.
    std::complex<double> at(double frequencyHz) const noexcept;

    /// The largest amplitude, in units of full scale at resonance, that every frequency of the band can have
    /// while its drive stays within `driveLimit`; 0 if the equaliser is off.
    double flatLevel(double driveLimit = 1.0) const noexcept;

private:
    static constexpr std::size_t most = 6;
    bool isAtRest() const noexcept;
    std::array<Biquad, most> section_{};
    int sections_ = 0;
    double sampleRateHz_ = 0.0;
    FrequencyBand band_;
};

} // namespace physvib
