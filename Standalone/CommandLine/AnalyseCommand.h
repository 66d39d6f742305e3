// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib analyse`: what the trials of a study say.
#pragma once
#include "Study/PercentCounts.h"
#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace physvib {

/// As given on the command line; each kind of analysis uses some of them.
struct AnalyseOptions {
    std::vector<std::string> files;
    int tolerance = 0;                                   ///< confusion: grid steps that still count as correct
    double thresholdPercent = defaultPercentThreshold;   ///< resolution, percent-counts
    std::size_t meanings = 8;                            ///< icons
    std::string picturePath, exportPath, countsPath;     ///< empty: not wanted
};

/// Declares the analyses as subcommands of `command`.
void declareAnalyse(CLI::App& command, AnalyseOptions& options);

/// Runs the one that `command` has parsed; the code to leave with.
int runAnalyse(const CLI::App& command, const AnalyseOptions& options);

} // namespace physvib
