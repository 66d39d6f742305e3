// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses of identified labels: confusion matrices, information transfer, icons.
#pragma once

namespace physvib {

struct AnalyseOptions;

int analyseConfusion(const AnalyseOptions& options);
int analyseIcons(const AnalyseOptions& options);

} // namespace physvib
