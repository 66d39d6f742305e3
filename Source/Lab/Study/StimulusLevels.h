// SPDX-License-Identifier: MIT
// Stimulus levels from other participants' adjustments, averaged per stimulus (thesis 5.2.1: three experts).
#pragma once
#include "Lab/Study/LevelTrials.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

struct StimulusLevel {
    std::string condition, stimulus, alternative; ///< alternative: the one that was adjusted
    double levelDb = 0.0;
    std::size_t participants = 0;
    double deviationDb = 0.0; ///< between participants; 0 for one
    bool operator==(const StimulusLevel&) const = default;
};

/// Mean adjustments: over each participant's repetitions, then over participants. Any thread (allocates).
std::vector<StimulusLevel> averageLevels(const std::vector<LevelTrial>& trials,
                                         const std::string& alternative);

/// The level of a stimulus; null if it has none. Any thread.
const StimulusLevel* levelOf(const std::vector<StimulusLevel>& levels, const std::string& condition,
                             const std::string& stimulus);

} // namespace physvib
