// SPDX-License-Identifier: MIT
// Every analysis: a function of its own, in the list of Analysis.cpp.
#pragma once
#include "Lab/Analysis/Analysis.h"

namespace physvib {

// Labels: confusion matrices, information transfer, icons.
AnalysisReport analyseConfusion(const AnalysisJob& job);
AnalysisReport analyseIcons(const AnalysisJob& job);

// Places: from pointing responses or percent counts to a perceptual resolution.
AnalysisReport analyseResolution(const AnalysisJob& job);
AnalysisReport analysePlaces(const AnalysisJob& job);
AnalysisReport analysePercentCounts(const AnalysisJob& job);

// Opinions and levels: forced choices, slider ratings, staircases, QUEST+, adjustments, magnitudes.
AnalysisReport analyseChoices(const AnalysisJob& job);
AnalysisReport analyseRatings(const AnalysisJob& job);
AnalysisReport analyseLevels(const AnalysisJob& job);

// Tests over participants, on any long table.
AnalysisReport analyseAnova(const AnalysisJob& job);
AnalysisReport analyseFriedman(const AnalysisJob& job);
AnalysisReport analyseWilcoxon(const AnalysisJob& job);
AnalysisReport analyseMannWhitney(const AnalysisJob& job);
AnalysisReport analyseKruskalWallis(const AnalysisJob& job);
AnalysisReport analyseShapiro(const AnalysisJob& job);
AnalysisReport analysePairs(const AnalysisJob& job);

// Functions fitted to each participant's trials.
AnalysisReport analysePsychometric(const AnalysisJob& job);
AnalysisReport analysePowerLaw(const AnalysisJob& job);

} // namespace physvib
