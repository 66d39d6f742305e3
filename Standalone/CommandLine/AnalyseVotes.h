// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of opinions: forced choices and slider ratings.
#pragma once

namespace physvib {

struct AnalyseOptions;

int analyseChoices(const AnalyseOptions& options);
int analyseRatings(const AnalyseOptions& options);

} // namespace physvib
