// SPDX-License-Identifier: MIT
// Pictures of fits to each participant's trials.
#pragma once
#include "Io/Charts/Charts.h"
#include "Study/Statistics/LevelFits.h"
#include <string>
#include <vector>

namespace physvib {

// SVG; those who cannot be fitted are left out. Any thread (allocates).

std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials, PsychometricShape shape, double guess, const std::string& levelWords);
std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials, const std::string& levelWords);

} // namespace physvib
