// SPDX-License-Identifier: MIT
// Groups trials by participant and fits each group.
#include "Lab/Statistics/LevelFits.h"
#include "Lab/Statistics/ByParticipant.h"
#include <map>

namespace physvib {
std::vector<ParticipantPsychometric> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                               const PsychometricModel& model) {
    std::vector<ParticipantPsychometric> fits;
    for (const auto& [participant, own] : byParticipant(trials)) {
        std::map<double, LevelCount> byLevel;
        for (const LevelAnswer& trial : own) {
            LevelCount& count = byLevel[trial.level];
            count.level = trial.level;
            ++count.trials;
            count.hits += trial.answer > 0.5;
        }
        std::vector<LevelCount> counts;
        for (const auto& [level, count] : byLevel) counts.push_back(count);
        fits.push_back({participant, own.size(), fitPsychometric(counts, model)});
    }
    return fits;
}

std::vector<ParticipantPowerLaw> powerLawByParticipant(const std::vector<LevelAnswer>& trials) {
    std::vector<ParticipantPowerLaw> laws;
    for (const auto& [participant, own] : byParticipant(trials)) {
        std::vector<MagnitudeTrial> magnitudes;
        for (const LevelAnswer& trial : own) magnitudes.push_back({trial.level, trial.answer});
        laws.push_back({participant, own.size(), fitPowerLaw(magnitudes)});
    }
    return laws;
}

} // namespace physvib
