// SPDX-License-Identifier: MIT
// The report of a study, as files in memory.
#pragma once
#include "Lab/Report/ReportTrials.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

struct StudyReport {
    std::map<std::string, std::string> files; ///< file names within the report's folder, and contents:
                                              ///< index.html, tables, analysis.R if there are tests
    std::vector<std::string> notes;           ///< one line each on trials without a known analysis
    std::vector<std::string> tests;           ///< all tests, in words
    bool isSimulated = false;                 ///< trials are of a simulated observer
};

/// Equal trials give identical bytes. Message thread only.
StudyReport studyReport(const ReportTrials& trials);

} // namespace physvib
