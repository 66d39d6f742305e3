// SPDX-License-Identifier: MIT
// Charts of functions fitted to each participant's trials.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Statistics/LevelFits.h"
#include "Lab/Study/LevelTrials.h"
#include <string>
#include <vector>

namespace physvib {

/// Axis labels of the fitted levels and answers.
struct FitWords {
    std::string level = "level (dB)", answer = "correct";
};

/// Labels for another program's table, from its column mapping or the chosen columns (empty: none chosen).
/// Any thread.
FitWords fitWords(std::span<const ColumnName> columns, const std::string& level = {},
                  const std::string& measure = {});

/// Decimals that show two digits of such a JND; at least two. Any thread.
int decimalsOf(double jnd) noexcept;

// SVG. Participants without a fit are omitted. Any thread (allocates).

/// `told`: the threshold of the method that chose the levels, shown in place of those of the fits.
std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                              const PsychometricModel& model, const FitWords& words,
                              const LevelSummary* told = nullptr);
std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                          const std::string& levelWords);

} // namespace physvib
