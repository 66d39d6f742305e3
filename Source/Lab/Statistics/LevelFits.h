// SPDX-License-Identifier: MIT
// Functions fitted to the trials of each participant by themselves.
#pragma once
#include "Lab/Statistics/PowerLaw.h"
#include "Lab/Statistics/Psychometric.h"
#include <string>
#include <vector>

namespace physvib {

/// What a participant answered at a level: 1 or 0, or a magnitude.
struct LevelAnswer {
    std::string participant;
    double level = 0.0, answer = 0.0;
};

struct ParticipantPsychometric {
    std::string participant;
    std::size_t trials = 0;
    PsychometricFit fit;
};

struct ParticipantPowerLaw {
    std::string participant;
    std::size_t trials = 0;
    PowerLaw law;
};

// In the order of their first trial. Any thread (allocates).
std::vector<ParticipantPsychometric> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                               const PsychometricModel& model);
std::vector<ParticipantPowerLaw> powerLawByParticipant(const std::vector<LevelAnswer>& trials);

} // namespace physvib
