// SPDX-License-Identifier: MIT
// Makes a resonant actuator flat within its band: what goes in is what is felt, in units of the full scale at
// resonance.
//
// The inverse of the resonance (Core/Actuators/Resonator.h) alone would boost without end: E(s) = HP(s) LP(s)
// / H(s), with Butterworth slopes of fourth order whose edges lie outside the band, so that the band is flat
// and what lies beyond is not driven. All four sections have their zeros and poles in the unit circle (or at
// its ends): stable and minimal-phase.
#pragma once
#include "Core/Actuators/Biquad.h"
#include "Core/Actuators/Resonator.h"
#include "Core/Limits.h"
#include <array>

namespace physvib {

/// What a channel is equalised for; without its figures: nothing.
struct EqualisedActuator {
    Resonator resonator;
    FrequencyBand band;
    bool isKnown() const noexcept { return resonator.isKnown() && band.isKnown(); }
    bool operator==(const EqualisedActuator&) const = default;
};
using EqualisedActuators = std::array<EqualisedActuator, limits::maxEnchanters>;

/// One channel. R only, but for prepare and the figures: any thread.
class ActuatorEqualiser {
public:
    /// Passes everything unchanged.
    ActuatorEqualiser() = default;

    /// Without figures, or with a band that does not lie below half the rate, all passes.
    ActuatorEqualiser(const EqualisedActuator& actuator, int sampleRateHz) noexcept;

    bool isOn() const noexcept { return sections_ > 0; }

    /// In place. `isSilent`: all of it is 0. True if there is nothing to hear.
    bool process(float* io, int frames, bool isSilent) noexcept;

    /// E at a frequency.
    std::complex<double> at(double frequencyHz) const noexcept;

    /// The largest amplitude, in units of full scale at resonance, that every frequency of the band can have
    /// while its drive stays within `driveLimit`; 0 if it is off.
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
