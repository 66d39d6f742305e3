// SPDX-License-Identifier: MIT
// Simulated observer that answers trials by a perceptual model, to rehearse a study and test its analysis.
// Its answers are always marked as simulated.
#pragma once
#include "Lab/Study/Experiment.h"
#include <string>
#include <string_view>

namespace physvib {

/// Parameters of perception errors and preferences. Probabilities are in 0 to 1.
struct ObserverSettings {
    std::string name = "simulated";
    double placeBlur = 0.15;             ///< standard deviation, share of the field's width and height
    double centralTendency = 0.0;        ///< shift of places to the centre, as a share of their distance
    double offsetX = 0.0, offsetY = 0.0; ///< constant localisation error, as shares of the field
    double pulsePlaceConfusion = 0.01;   ///< probability that a pulse is felt at another actuator
    double durationConfusion = 0.03;     ///< probability that a pattern's duration is confused with another
    double numerosityConfusion = 0.02;   ///< probability that one pulse too few is counted
    double firstAlternativePreference = 0.59;   ///< probability, for alternatives at equal levels
    double levelNoiseDb = 2.0;                  ///< standard deviation of comparisons and adjustments
    double scoreBase = 38.0, scoreNoise = 14.0; ///< ratings
    /// Scores added for the methods AV, FV and DRV (thesis 5.3.2).
    double amplitudeScore = 8.0, frequencyScore = 23.2, decayScore = 2.0;
    double ringBlur = 0.0; ///< placeBlur for layouts whose name begins with ring; 0: use placeBlur
    // Standard deviations between participants; 0: no differences.
    double blurSpread = 0.0; ///< spread of the natural logarithm of each blur, independently
    double preferenceSpread = 0.0;
    double amplitudeSpread = 0.0, frequencySpread = 0.0, decaySpread = 0.0; ///< spreads of the scores
};

/// Names that observerNamed() accepts.
inline constexpr std::string_view observerNames =
    "simulated, simulated-PHONE, simulated-RING or simulated-thesis";

/// The observer with that name; nullopt if unknown. simulated-PHONE and simulated-RING are fitted to thesis
/// 4.1.2, simulated-thesis to all printed results (tests repeat the fits); others are assumed. Any thread.
std::optional<ObserverSettings> observerNamed(std::string_view name);

/// Answers depend only on seed, participant and trial: also when a study resumes. Message thread only.
class SimulatedObserver {
public:
    /// `protocol` must outlive the observer.
    SimulatedObserver(ObserverSettings settings, const Protocol& protocol, const Participant& participant);

    /// The answer to the experiment's current trial. Precondition: the experiment is not done.
    Answer answer(const Experiment& experiment) const;

private:
    ObserverSettings settings_;
    const Protocol& protocol_;
    Participant participant_;
};

} // namespace physvib
