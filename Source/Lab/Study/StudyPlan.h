// SPDX-License-Identifier: MIT
// Plan of a study from its protocol: stimuli at their maximum levels, trials, duration, balance of orders.
#pragma once
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Protocol.h"
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace physvib {
/// A stimulus of a condition, or one part of it, at a level that a session can reach.
struct PlannedStimulus {
    std::size_t condition = 0, session = 0; ///< the session is one that sets the level
    std::string label, part;                ///< part is empty if trials have none
    double levelDb = 0.0;
    bool isHighest = true;       ///< false: a lower level of the same samples
    bool isEvenlySpaced = false; ///< one of evenly spread levels that stand for all others

    /// The job that creates the stimulus. Any thread (allocates).
    TrialJob job(const Protocol& protocol) const;
};

/// If a part can have more levels than this, one more than this number is planned, evenly spaced.
inline constexpr std::size_t maxPlannedLevels = 512;

/// All planned stimuli in the order of conditions, each with its levels from the lowest. A level that is only
/// a gain scales the samples, so its lowest and its highest stand for all; any other use of it is listed
/// level by level. Any thread (allocates).
std::vector<PlannedStimulus> plannedStimuli(const Protocol& protocol);

/// Number of trials of a session; the maximum where answers decide. Any thread.
int maxSessionTrials(const SessionPlan& session, std::size_t stimuli);

/// Conditions in which no break of `break_every` comes before the last trial. Any thread (allocates).
std::vector<std::string> conditionsWithoutBreaks(const Protocol& protocol, const SessionPlan& session);

/// Number of plays of one part of a stimulus per participant, at one play per trial.
struct PlannedTrials {
    std::size_t condition = 0;
    std::string label, part;
    double count = 0.0; ///< not an integer if, for example, 100 touches are spread over 35 places
};

/// All conditions and sessions; the maximum where a level follows the answers. Any thread (allocates).
std::vector<PlannedTrials> plannedTrials(const Protocol& protocol);

/// Duration of a study for one participant.
struct PlannedTime {
    int trials = 0;                 ///< over all conditions; the maximum where levels follow the answers
    double seconds = 0.0;           ///< including breaks, one play of each part, and answerSeconds per answer
    double maxStretchSeconds = 0.0; ///< without a break in between
    static constexpr double answerSeconds = 5.0;
};

/// `secondsOf`: duration of a stimulus and part. An interactive world lasts as long as the session specifies.
/// Any thread (allocates).
PlannedTime plannedTime(const Protocol& protocol,
                        const std::function<double(std::size_t condition, const std::string& label,
                                                   const std::string& part)>& secondsOf);

/// Balance of the condition orders of participants 1 to `participants`.
struct OrderBalance {
    int minAtPosition = 0, maxAtPosition = 0;     ///< how often a condition has a position
    int successions = 0, possibleSuccessions = 0; ///< ordered pairs of neighbouring conditions: how many
                                                  ///< occur, and how many there are
    bool isBalanced() const noexcept {
        return minAtPosition == maxAtPosition && successions == possibleSuccessions;
    }
};

/// Counts positions and successions of conditions. Any thread (allocates).
OrderBalance orderBalance(const Protocol& protocol, int participants);

} // namespace physvib
