// SPDX-License-Identifier: MIT
// Averages adjusted levels, with equal weight for each participant regardless of repetitions.
#include "Lab/Study/StimulusLevels.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <map>
#include <utility>

namespace physvib {

std::vector<StimulusLevel> averageLevels(const std::vector<LevelTrial>& trials,
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

const StimulusLevel* levelOf(const std::vector<StimulusLevel>& levels, const std::string& condition,
                             const std::string& stimulus) {
    const auto found = std::ranges::find_if(levels, [&](const StimulusLevel& level) {
        return level.condition == condition && level.stimulus == stimulus;
    });
    return found == levels.end() ? nullptr : &*found;
}

} // namespace physvib
