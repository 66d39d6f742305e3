// SPDX-License-Identifier: MIT
// Levels that others have set: one for each stimulus, means over those who set it (thesis 5.2.1: three
// experts).
#pragma once
#include "Lab/Study/LevelTrials.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

struct StimulusLevel {
    std::string condition, stimulus, alternative; ///< the alternative that was moved
    double levelDb = 0.0;
    std::size_t participants = 0;
    double deviationDb = 0.0; ///< between participants; 0 of one
    bool operator==(const StimulusLevel&) const = default;
};

/// Means of the adjustments: of each participant's repetitions, then over participants. Any thread
/// (allocates).
std::vector<StimulusLevel> averageLevels(const std::vector<LevelTrial>& trials,
                                         const std::string& alternative);

/// The level of a stimulus; none if nobody set it. Any thread.
const StimulusLevel* levelOf(const std::vector<StimulusLevel>& levels, const std::string& condition,
                             const std::string& stimulus);

} // namespace physvib
