// SPDX-License-Identifier: MIT
// Simulated actuator to test equalisers and measurements with: drive in, acceleration out.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include <algorithm>

namespace physvib {

/// The drive is clipped at +-driveLimit, as by an amplifier's supply, and then drives the resonator. One
/// thread at a time.
class SimulatedActuator {
public:
    /// `resonator` known; sample rate in Hz, above twice its resonance.
    SimulatedActuator(const Resonator& resonator, double sampleRateHz, double driveLimit = 1.0) noexcept
        : driveLimit_{driveLimit}
        , response_{1.0, {-2.0, 1.0}, RootPair::exact(resonator.resonanceHz, resonator.q, sampleRateHz)} {
        response_.scale(1.0 / std::abs(response_.at(resonator.resonanceHz, sampleRateHz)));
    }

    /// One frame of drive in units of full scale to acceleration in units of that at the resonance for a
    /// drive of 1. Wait-free.
    double process(double drive) noexcept {
        return response_.process(std::clamp(drive, -driveLimit_, driveLimit_));
    }

    std::complex<double> at(double frequencyHz, double sampleRateHz) const noexcept {
        return response_.at(frequencyHz, sampleRateHz);
    }

private:
    double driveLimit_;
    Biquad response_;
};

} // namespace physvib
