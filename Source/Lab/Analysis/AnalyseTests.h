// SPDX-License-Identifier: MIT
// Tests over participants on any long table: ANOVA with repeated measures, rank tests, normality, pairs.
#pragma once

namespace physvib {

struct AnalysisJob;
struct AnalysisReport;

AnalysisReport analyseAnova(const AnalysisJob& options);
AnalysisReport analyseFriedman(const AnalysisJob& options);
AnalysisReport analyseWilcoxon(const AnalysisJob& options);
AnalysisReport analyseMannWhitney(const AnalysisJob& options);
AnalysisReport analyseKruskalWallis(const AnalysisJob& options);
AnalysisReport analyseShapiro(const AnalysisJob& options);
AnalysisReport analysePairs(const AnalysisJob& options);

} // namespace physvib
