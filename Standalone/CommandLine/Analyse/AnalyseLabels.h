// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of identified labels: confusion matrices, information transfer, icons.
#pragma once

namespace physvib {

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analyseConfusion(const AnalyseOptions& options);
AnalysisReport analyseIcons(const AnalyseOptions& options);

} // namespace physvib
