// SPDX-License-Identifier: MIT
// Functions fitted to each participant's trials: psychometric functions, and the power law of magnitude
// estimations.
#pragma once

namespace physvib {

struct AnalysisJob;
struct AnalysisReport;

AnalysisReport analysePsychometric(const AnalysisJob& options);
AnalysisReport analysePowerLaw(const AnalysisJob& options);

} // namespace physvib
