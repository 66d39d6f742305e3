// SPDX-License-Identifier: MIT
// Stimulus levels from other participants' adjustments, averaged per stimulus (thesis 5.2.1: three experts).
#pragma once
#include "Lab/Statistics/Moments.h"
#include "Lab/Study/LevelTrials.h"
#include <algorithm>
#include <map>
#include <string>
#include <utility>
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
inline std::vector<StimulusLevel> averageLevels(const std::vector<LevelTrial>& trials,
                                                const std::string& alternative) {
    // (condition, stimulus), participant
    std::map<std::pair<std::string, std::string>, std::map<std::string, std::vector<double>>> settings;
    for (const LevelTrial& trial : trials)
        if (trial.kind == LevelTrial::Kind::adjustment)
            settings[{trial.condition, trial.stimulus}][trial.participant].push_back(trial.value);
    std::vector<StimulusLevel> levels;
    for (const auto& [place, participants] : settings) {
        std::vector<double> own;
        for (const auto& [participant, values] : participants) own.push_back(Moments{values}.mean);
        const Moments moments{own};
        levels.push_back(
            {place.first, place.second, alternative, moments.mean, own.size(), moments.deviation});
    }
    return levels;
}

/// The level of a stimulus; null if it has none. Any thread.
inline const StimulusLevel* levelOf(const std::vector<StimulusLevel>& levels, const std::string& condition,
                                    const std::string& stimulus) {
    const auto found = std::ranges::find_if(levels, [&](const StimulusLevel& level) {
        return level.condition == condition && level.stimulus == stimulus;
    });
    return found == levels.end() ? nullptr : &*found;
}

} // namespace physvib
