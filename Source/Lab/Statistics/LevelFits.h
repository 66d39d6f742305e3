// SPDX-License-Identifier: MIT
// Psychometric functions and power laws, fitted to each participant's trials separately.
#pragma once
#include "Lab/Statistics/PowerLaw.h"
#include "Lab/Statistics/Psychometric.h"
#include <string>
#include <vector>

namespace physvib {

/// A participant's answer at a level: 1 or 0, or a magnitude.
struct LevelAnswer {
    std::string participant;
    double level = 0.0, answer = 0.0;
    bool isAdaptive = false; ///< earlier answers chose the level, so the answers do not tell the slope
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

// One result per participant, in the order of first trials. Any thread (allocates).
std::vector<ParticipantPsychometric> psychometricByParticipant(const std::vector<LevelAnswer>& trials,
                                                               const PsychometricModel& model);
std::vector<ParticipantPowerLaw> powerLawByParticipant(const std::vector<LevelAnswer>& trials);

} // namespace physvib
