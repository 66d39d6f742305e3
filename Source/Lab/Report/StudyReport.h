// SPDX-License-Identifier: MIT
// The report of one study, as files in memory.
#pragma once
#include "Lab/Report/ReportTrials.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

struct StudyReport {
    std::map<std::string, std::string> files; ///< names within the report's folder, and their bytes:
                                              ///< index.html, tables, report.R
    std::vector<std::string> notes;           ///< a line each: what no analysis is known for
    std::vector<std::string> tests;           ///< the calls of all tests
    bool isSimulated = false;                 ///< a simulated observer answered, not a person
};

/// The same trials give the same bytes. M only.
StudyReport studyReport(const ReportTrials& trials);

} // namespace physvib
