// SPDX-License-Identifier: GPL-3.0-or-later
// Tests over participants on any long table: ANOVA with repeated measures, rank tests, normality, pairs.
#pragma once

namespace physvib {

class OptionTable;

struct AnalyseOptions;
struct AnalysisReport;

AnalysisReport analyseAnova(const AnalyseOptions& options);
AnalysisReport analyseFriedman(const AnalyseOptions& options);
AnalysisReport analyseWilcoxon(const AnalyseOptions& options);
AnalysisReport analyseMannWhitney(const AnalyseOptions& options);
AnalysisReport analyseKruskalWallis(const AnalyseOptions& options);
AnalysisReport analyseShapiro(const AnalyseOptions& options);
AnalysisReport analysePairs(const AnalyseOptions& options);

/// The options that all of them take.
void declareTest(OptionTable& command, AnalyseOptions& options);

} // namespace physvib
