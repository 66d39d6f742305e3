// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of places: from pointing responses or percent counts to a perceptual resolution.
#pragma once

namespace physvib {

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analyseResolution(const AnalyseOptions& options);
AnalysisReport analysePercentCounts(const AnalyseOptions& options);

} // namespace physvib
