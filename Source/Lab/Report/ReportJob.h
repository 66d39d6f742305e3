// SPDX-License-Identifier: MIT
// Options of a report on trial files: inputs, output folder and additional facts.
#pragma once
#include "Lab/Files/ColumnNames.h"
#include "Lab/Report/StudyReport.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

struct ReportJob {
    std::vector<std::string> files;           ///< trial files of one study
    std::vector<ColumnName> columns{};        ///< column mapping for tables of another program
    double guess = PsychometricModel{}.guess; ///< guess rate of psychometric functions if no protocol
                                              ///< specifies it
    std::string folder;                       ///< output folder
    bool wantsBids = false;                   ///< also export the trials as a BIDS dataset
    std::string peoplePath{}; ///< table of facts on the participants (see StudyFacts.h); empty: unknown
    std::string ethics{}, consent{}, noise{}; ///< sentences for the page; if empty, the page has a reminder

    std::string planPath{}; ///< plan of the study, made before it; empty: none

    bool operator==(const ReportJob&) const = default;
};

/// The report's files in memory, or an error line. `protocol`: given by the user; without it, a built-in one
/// is looked up. Message thread only.
Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callFault);

} // namespace physvib
