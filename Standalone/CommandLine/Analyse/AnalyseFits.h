// SPDX-License-Identifier: GPL-3.0-or-later
// Functions fitted to each participant's trials: psychometric functions, and the power law of magnitude estimations.
#pragma once

namespace CLI {
class App;
}

namespace physvib {

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analysePsychometric(const AnalyseOptions& options);
AnalysisReport analysePowerLaw(const AnalyseOptions& options);

/// The options of either.
void declareFit(CLI::App& command, AnalyseOptions& options);

} // namespace physvib
