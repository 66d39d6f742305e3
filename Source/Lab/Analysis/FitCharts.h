// SPDX-License-Identifier: MIT
// Pictures of fits to each participant's trials.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Statistics/LevelFits.h"
#include <string>
#include <vector>

namespace physvib {

/// What a table calls the levels and the answers that are fitted.
struct FitWords {
    std::string level = "level (dB)", answer = "correct";
};

/// Of another program's table by its columns, or by the columns that were chosen (empty: none was). Any
/// thread.
FitWords fitWords(std::span<const ColumnName> columns, const std::string& level = {},
                  const std::string& measure = {});

/// Decimals that show two digits of a JND of that size: at least two. Any thread.
int decimalsOf(double jnd) noexcept;

// SVG; those who cannot be fitted are left out. Any thread (allocates).

std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                              const PsychometricModel& model, const FitWords& words);
std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                          const std::string& levelWords);

} // namespace physvib
