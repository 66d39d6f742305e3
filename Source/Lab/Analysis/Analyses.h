// SPDX-License-Identifier: MIT
// The functions of all analyses, which the list in Analysis.cpp refers to.
#pragma once
#include "Lab/Analysis/Analysis.h"

namespace physvib {

// Labels: confusion matrices, information transfer, icons.
AnalysisReport analyseConfusion(const AnalysisJob& job);
AnalysisReport analyseIcons(const AnalysisJob& job);

// Places: perceptual resolution from pointing responses or percent counts, and pointing errors.
AnalysisReport analyseResolution(const AnalysisJob& job);
AnalysisReport analysePlaces(const AnalysisJob& job);
AnalysisReport analysePercentCounts(const AnalysisJob& job);

// Judgements and levels: forced choices, slider ratings, staircases, QUEST+, adjustments, magnitudes.
AnalysisReport analyseChoices(const AnalysisJob& job);
AnalysisReport analyseRatings(const AnalysisJob& job);
AnalysisReport analyseLevels(const AnalysisJob& job);

// Functions fitted to each participant's trials.
AnalysisReport analysePsychometric(const AnalysisJob& job);
AnalysisReport analysePowerLaw(const AnalysisJob& job);

} // namespace physvib
