// SPDX-License-Identifier: GPL-3.0-or-later
// Functions fitted to each participant's trials: psychometric functions, and the power law of magnitude estimations.
#pragma once

namespace physvib {

class OptionTable;

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analysePsychometric(const AnalyseOptions& options);
AnalysisReport analysePowerLaw(const AnalyseOptions& options);

/// The options of either.
void declareFit(OptionTable& command, AnalyseOptions& options);

} // namespace physvib
