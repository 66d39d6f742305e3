// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of opinions and levels: forced choices, slider ratings, staircases, QUEST+, adjustments, magnitudes.
#pragma once

namespace physvib {

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analyseChoices(const AnalyseOptions& options);
AnalysisReport analyseRatings(const AnalyseOptions& options);
AnalysisReport analyseLevels(const AnalyseOptions& options);

} // namespace physvib
