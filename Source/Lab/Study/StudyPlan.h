// SPDX-License-Identifier: MIT
// What a protocol will ask for: its stimuli at their highest levels, its trials, its time, and how its orders
// balance.
#pragma once
#include "Lab/Study/Trial.h"
#include <functional>
#include <string>
#include <vector>

namespace physvib {

/// A stimulus of a condition, or one part of it, at the highest level that any session can set.
struct PlannedStimulus {
    std::size_t condition = 0, session = 0; ///< the session is the one that sets the level
    std::string label, part;                ///< no part: empty
    double highestDb = 0.0;

    /// What it is made by. Any thread (allocates).
    TrialJob job(const Protocol& protocol) const;
};

/// All of them, conditions in their order. Any thread (allocates).
std::vector<PlannedStimulus> plannedStimuli(const Protocol& protocol);

/// How often one participant feels one part of a stimulus, at one play per trial.
struct PlannedTrials {
    std::size_t condition = 0;
    std::string label, part;
    double count = 0.0; ///< a share of a trial where 100 touches meet 35 places
};

/// Of all conditions and sessions. Where a level follows the answers, the most that there can be. Any thread
/// (allocates).
std::vector<PlannedTrials> plannedTrials(const Protocol& protocol);

/// How long a study takes one participant.
struct PlannedTime {
    int trials = 0;       ///< of all conditions; where levels follow the answers, the most that there can be
    double seconds = 0.0; ///< with breaks, at one play of each part and answerSeconds per answer
    double longestStretchSeconds = 0.0; ///< without a break
    static constexpr double answerSeconds = 5.0;
};

/// `secondsOf`: of a stimulus and part. A world with hands lasts as long as the session asks. Any thread
/// (allocates).
PlannedTime plannedTime(const Protocol& protocol,
                        const std::function<double(std::size_t condition, const std::string& label,
                                                   const std::string& part)>& secondsOf);

/// How the conditions of participants 1 to `participants` are ordered.
struct OrderBalance {
    int fewestAtPlace = 0, mostAtPlace = 0;       ///< how often one condition is at one place
    int successions = 0, possibleSuccessions = 0; ///< of one condition after another: how many occur
    bool isBalanced() const noexcept {
        return fewestAtPlace == mostAtPlace && successions == possibleSuccessions;
    }
};

/// Any thread (allocates).
OrderBalance orderBalance(const Protocol& protocol, int participants);

} // namespace physvib
