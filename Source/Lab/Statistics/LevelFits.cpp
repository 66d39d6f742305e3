// SPDX-License-Identifier: MIT
// Groups trials by participant and fits each group.
#include "Lab/Statistics/LevelFits.h"
#include "Lab/Statistics/LongTable.h"
#include <map>

namespace physvib {
namespace {

struct OwnAnswers {
    std::string participant;
    std::vector<LevelAnswer> trials;
};

std::vector<OwnAnswers> answersByParticipant(const std::vector<LevelAnswer>& trials) {
    WordList participants;
    std::vector<OwnAnswers> own;
    for (const LevelAnswer& trial : trials) {
        const std::size_t at = participants.indexOf(trial.participant);
        if (at == own.size()) own.push_back({trial.participant, {}});
        own[at].trials.push_back(trial);
    }
    return own;
}

} // namespace

std::vector<ParticipantPsychometric> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                               const PsychometricModel& model) {
    std::vector<ParticipantPsychometric> fits;
    for (const OwnAnswers& own : answersByParticipant(trials)) {
        std::map<double, LevelCount> byLevel;
        for (const LevelAnswer& trial : own.trials) {
            LevelCount& count = byLevel[trial.level];
            count.level = trial.level;
            ++count.trials;
            count.hits += trial.answer > 0.5;
        }
        std::vector<LevelCount> counts;
        for (const auto& [level, count] : byLevel) counts.push_back(count);
        fits.push_back({own.participant, own.trials.size(), fitPsychometric(counts, model)});
    }
    return fits;
}

std::vector<ParticipantPowerLaw> powerLawByParticipant(const std::vector<LevelAnswer>& trials) {
    std::vector<ParticipantPowerLaw> laws;
    for (const OwnAnswers& own : answersByParticipant(trials)) {
        std::vector<MagnitudeTrial> magnitudes;
        for (const LevelAnswer& trial : own.trials) magnitudes.push_back({trial.level, trial.answer});
        laws.push_back({own.participant, own.trials.size(), fitPowerLaw(magnitudes)});
    }
    return laws;
}

} // namespace physvib
