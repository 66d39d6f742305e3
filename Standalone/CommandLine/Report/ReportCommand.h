// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib report`: from trial files to a page, its tables and a script in R.
#pragma once
#include "CommandLine/Analyse/AnalyseCommand.h"
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct ReportOptions {
    AnalyseOptions sources; ///< files and columns of it
    std::string folder, protocol;
    bool wantsBids = false;
};

void declareReport(OptionTable& command, ReportOptions& options);

/// Does what `command` has parsed; the code to leave with.
int runReport(const ReportOptions& options);

} // namespace physvib
