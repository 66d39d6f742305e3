// SPDX-License-Identifier: MIT
// Resonance, Q, gain and delay of an actuator, or of a cable, from a sweep that was played and what was
// recorded of it.
#pragma once
#include "Core/Actuators/Resonator.h"
#include "Io/Result.h"
#include <vector>

namespace physvib {

/// A sine whose frequency rises exponentially, with soft ends and the silence in which the actuator rings
/// down.
struct SweepSettings {
    FrequencyBand band{20.0, 1000.0};
    double seconds = 5.0;      ///< of the sine
    double restSeconds = 1.0;  ///< after it: longest delay and ring-down that can be measured
    double level = 0.25118864; ///< peak; -12 dB of full scale, as everything starts here
};

/// Samples in [-1, 1]. M only.
std::vector<float> sweepOf(const SweepSettings& settings, double rateHz);

/// What a linear actuator and everything between the two recordings do: gain e^(-i w delay) H(f), see
/// Core/Actuators/Resonator.h.
struct MeasuredActuator {
    Resonator resonator;
    double gain = 0.0;          ///< recorded over played at the resonance; negative: turned polarity
    double delaySeconds = 0.0;  ///< 0 to SweepSettings::restSeconds
    double residualShare = 0.0; ///< of the response's energy over the band: what the model does not explain
    double rateHz = 0.0;

    /// Where the response is within `decibels` of its peak, cut to `swept`.
    FrequencyBand bandWithin(double decibels, const FrequencyBand& swept) const;
};

/// What a plain cable in the actuator's place does: gain e^(-i w delay), the device's and its driver's
/// latency there and back.
struct MeasuredLoopback {
    double gain = 0.0;          ///< recorded over played; negative: turned polarity
    double delaySeconds = 0.0;  ///< 0 to SweepSettings::restSeconds
    double residualShare = 0.0; ///< as MeasuredActuator's
};

/// Fits the model to the transfer function between two recordings that begin together, over `band` and once
/// more around the resonance. One line without a file's name if one of them is no such recording, or the
/// model explains less than half of it. M only.
Result<MeasuredActuator> fitActuator(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band = SweepSettings{}.band);

/// The same with a cable for a model; refused if it explains less than nine tenths. M only.
Result<MeasuredLoopback> fitLoopback(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band = SweepSettings{}.band);

} // namespace physvib
