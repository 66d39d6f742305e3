// SPDX-License-Identifier: GPL-3.0-or-later
// Tests over participants on any long table: ANOVA with repeated measures, rank tests, normality, pairs.
#pragma once

namespace CLI {
class App;
}

namespace physvib {

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
void declareTest(CLI::App& command, AnalyseOptions& options);

} // namespace physvib
