// SPDX-License-Identifier: MIT
// Analyses of places: from pointing responses or percent counts to a perceptual resolution.
#pragma once

namespace physvib {

struct AnalysisJob;
struct AnalysisReport;

AnalysisReport analyseResolution(const AnalysisJob& options);
AnalysisReport analysePlaces(const AnalysisJob& options);
AnalysisReport analysePercentCounts(const AnalysisJob& options);

} // namespace physvib
