// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of opinions and levels: forced choices, slider ratings, staircases, adjustments, magnitudes.
#pragma once

namespace physvib {

struct AnalyseOptions;

int analyseChoices(const AnalyseOptions& options);
int analyseRatings(const AnalyseOptions& options);
int analyseLevels(const AnalyseOptions& options);

} // namespace physvib
