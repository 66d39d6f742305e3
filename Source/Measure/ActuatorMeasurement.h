// SPDX-License-Identifier: MIT
// Measures resonance, Q, gain and delay of an actuator, or gain and delay of a loopback cable, from a played
// sweep and its recording.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Result.h"
#include <vector>

namespace physvib {

/// An exponential sine sweep with faded ends, followed by silence in which the actuator decays.
struct SweepSettings {
    FrequencyBand band{20.0, 1000.0};
    double seconds = 5.0;      ///< of the sine
    double tailSeconds = 1.0;  ///< silence after it: the longest delay and decay that can be measured
    double level = 0.25118864; ///< peak; -12 dB of full scale, the default start level
};

/// Samples in [-1, 1]. Message thread (M) only.
std::vector<float> makeSweep(const SweepSettings& settings, double rateHz);

/// Model of a linear actuator and everything between output and recording: gain e^(-i w delay) H(f), see
/// Core/Actuators/ActuatorEqualiser.h.
struct MeasuredActuator {
    Resonator resonator;
    double gain = 0.0;          ///< recorded over played at the resonance; negative: inverted polarity
    double delaySeconds = 0.0;  ///< 0 to SweepSettings::tailSeconds
    double residualShare = 0.0; ///< share of the response's energy that the model does not explain
    double rateHz = 0.0;

    /// The band in which the response is within `decibels` of its peak, clipped to `sweptBand`.
    FrequencyBand bandWithin(double decibels, const FrequencyBand& sweptBand) const;
};

/// Model of a plain cable in the actuator's place: gain e^(-i w delay), the device's and its driver's
/// round-trip latency.
struct MeasuredLoopback {
    double gain = 0.0;          ///< recorded over played; negative: inverted polarity
    double delaySeconds = 0.0;  ///< 0 to SweepSettings::tailSeconds
    double residualShare = 0.0; ///< share of the response's energy that the model does not explain
};

/// Fits the model to the transfer function between two recordings that begin together, over `band` and again
/// around the resonance. Returns a one-line error without a file's name if a recording is unsuitable, or if
/// the model explains less than half. Message thread only.
Result<MeasuredActuator> fitActuator(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band = SweepSettings{}.band);

/// Fits a cable as the model; an error if it explains less than nine tenths. Message thread only.
Result<MeasuredLoopback> fitLoopback(const std::vector<float>& played, const std::vector<float>& recorded,
                                     double rateHz, const FrequencyBand& band = SweepSettings{}.band);

} // namespace physvib
