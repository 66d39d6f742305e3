// SPDX-License-Identifier: MIT
// Analyses of opinions and levels: forced choices, slider ratings, staircases, QUEST+, adjustments,
// magnitudes.
#pragma once

namespace physvib {

struct AnalysisJob;
struct AnalysisReport;

AnalysisReport analyseChoices(const AnalysisJob& options);
AnalysisReport analyseRatings(const AnalysisJob& options);
AnalysisReport analyseLevels(const AnalysisJob& options);

} // namespace physvib
