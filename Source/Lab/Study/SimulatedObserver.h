// SPDX-License-Identifier: MIT
// An observer that answers by a model, to rehearse a study and to test its analysis. Never a person: whatever
// it answers is marked as simulated.
#pragma once
#include "Lab/Study/Experiment.h"
#include <string>
#include <string_view>

namespace physvib {

/// What goes wrong in perception, and what is preferred. Probabilities from 0 to 1.
struct ObserverSettings {
    std::string name = "simulated";
    double placeBlur = 0.15;   ///< standard deviation, share of the field's width and height
    double pullToMiddle = 0.0; ///< share of its distance by which a place is felt nearer to the middle
    double offsetX = 0.0, offsetY = 0.0;        ///< places are felt so far off, shares of the field
    double pulsePlaceConfusion = 0.01;          ///< a pulse is felt on another enchanter
    double durationConfusion = 0.03;            ///< a pattern's duration is taken for another of the set
    double numerosityConfusion = 0.02;          ///< one pulse too few is counted (underestimation is usual)
    double firstAlternativePreference = 0.59;   ///< of alternatives at equal levels
    double levelNoiseDb = 2.0;                  ///< of comparisons and adjustments
    double scoreBase = 38.0, scoreNoise = 14.0; ///< ratings
    /// more for AV, FV, DRV (thesis 5.3.2)
    double amplitudeScore = 8.0, frequencyScore = 23.2, decayScore = 2.0;
    double ringBlur = 0.0; ///< placeBlur where the layout's name begins with ring; 0: the same
    // Standard deviations between participants; 0: all are alike.
    double blurSpread = 0.0; ///< of the blurs' natural logarithms, each by itself
    double preferenceSpread = 0.0;
    double amplitudeSpread = 0.0, frequencySpread = 0.0, decaySpread = 0.0; ///< of the scores
};

/// What observerNamed() knows.
inline constexpr std::string_view observerNames =
    "simulated, simulated-PHONE, simulated-RING or simulated-thesis";

/// The observer of that name; none if there is none. The place blurs of simulated-PHONE and simulated-RING
/// are fitted to the exact percent correct of thesis 4.1.2, simulated-thesis to all that the five studies
/// print, spreads included (tests fit them again); other values are assumptions. Any thread.
std::optional<ObserverSettings> observerNamed(std::string_view name);

/// Answers depend on the seed, the participant and the trial alone, so a study that was cut off goes on as if
/// it had not been. M only.
class SimulatedObserver {
public:
    /// `protocol` outlives the observer.
    SimulatedObserver(ObserverSettings settings, const Protocol& protocol, const Participant& participant);

    /// What it answers to the experiment's trial, which is not done.
    Answer answer(const Experiment& experiment) const;

private:
    std::string explored(const Experiment& experiment, SeededRandom& random, Answer& answer) const;
    std::string identified(const ConditionPlan& condition, const Trial& trial, SeededRandom& random) const;
    PulsePattern feltPattern(PulsePattern pattern, const PatternSet& set, SeededRandom& random) const;
    double blurOf(const ConditionPlan& condition) const noexcept;
    FieldPlace feltPlace(const FieldPlace& place, double blur, SeededRandom& random) const;
    std::string chosen(const SessionPlan& session, const Trial& trial, SeededRandom& random) const;
    double scored(const Trial& trial, SeededRandom& random) const;
    double magnitude(const ConditionPlan& condition, const Trial& trial, SeededRandom& random) const;

    ObserverSettings settings_;
    const Protocol& protocol_;
    Participant participant_;
};

} // namespace physvib
