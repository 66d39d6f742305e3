// SPDX-License-Identifier: GPL-3.0-or-later
// Check of a study before it is run: level of each stimulus, effect of limiter and guard, duration, and
// balance of orders.
#pragma once
#include "Lab/Study/Experiment.h"
#include "Lab/Study/StudyPlan.h"
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace physvib {
/// A stimulus of a condition, or a part of it (an alternative or object), at a level that its sessions reach.
struct CheckedStimulus : PlannedStimulus {
    double seconds = 0.0;     ///< duration
    double frequencyHz = 0.0; ///< of the strongest impact or pulse
    double peakShare = 0.0; ///< of the actuator with the largest share of its full scale; without the limiter
    double requiredFullScaleG = 0.0; ///< full scale that this actuator needs
    double peakG = 0.0, rmsG = 0.0;  ///< of the strongest actuator; rmsG over the duration
    double squareGSeconds = 0.0;     ///< hand-weighted sum over all actuators: see Exposure.h
    double minGuardGain = 1.0;       ///< minimum gain of OutputGuard; 1: unchanged
    bool isOpenEnded = false;        ///< an interactive world, measured with its own script
    std::uint64_t samplesHash = 0;   ///< hash of all actuators' samples: equal for equal samples
    std::string error;               ///< why it cannot be played, in one line
};

/// Hash of the call of a stimulus, used as its samplesHash if it is not rendered. Any thread.
std::uint64_t callHash(const TrialJob& job);

/// Results of a check. Message thread.
struct StudyCheck {
    std::vector<CheckedStimulus> stimuli;
    std::vector<std::string> errors;     ///< the study may not be run
    std::vector<std::string> warnings;   ///< to be decided by the experimenter
    std::vector<std::string> facts;      ///< trials, duration, exposure, orders
    std::vector<std::string> deviations; ///< of a built-in protocol from the thesis
};

/// The check as text: a line per stimulus, then facts, deviations, errors and warnings. Any thread.
std::string toText(const StudyCheck& check, const Protocol& protocol);

/// The check as a self-contained HTML page. Any thread (allocates).
std::string toHtml(const StudyCheck& check, const Protocol& protocol);

/// Renders every stimulus that a session can reach (see plannedStimuli), and judges the balance of orders for
/// so many participants (0: does not). Ends early once `keepGoing` returns false. One thread at a time.
StudyCheck checkStudy(const Protocol& protocol, int participants,
                      const std::function<bool()>& keepGoing = {});

/// The first error that checkStudy() would find; empty if there is none. Faster: lower levels of the same
/// samples, and interactive worlds, whose levels depend on the participant, are not rendered, and pulses and
/// phantoms only where their gains exceed the layout. Message thread.
std::string findStudyError(const Protocol& protocol);

/// Adds to the errors and warnings of a check whose stimuli have their hashes. Errors: a level, a factor,
/// alternatives or objects that change no sample; reversals, steps and times that cannot be reached.
/// Warnings: stimuli or conditions with the same samples, and settings that may be a mistake. Message thread.
void checkRules(const Protocol& protocol, StudyCheck& check);

} // namespace physvib
