// SPDX-License-Identifier: MIT
// Analyses of identified labels: confusion matrices, information transfer, icons.
#pragma once

namespace physvib {

struct AnalysisJob;
struct AnalysisReport;

AnalysisReport analyseConfusion(const AnalysisJob& options);
AnalysisReport analyseIcons(const AnalysisJob& options);

} // namespace physvib
