// SPDX-License-Identifier: MIT
// A report on trial files: which, and into which folder.
#pragma once
#include "Lab/Files/ColumnNames.h"
#include "Lab/Report/StudyReport.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

struct ReportJob {
    std::vector<std::string> files;           ///< of one study
    std::vector<ColumnName> columns{};        ///< of another program's tables
    double guess = PsychometricModel{}.guess; ///< of psychometric functions, where no protocol knows it
    std::string folder;                       ///< all that is written lies in it
    bool wantsBids = false;                   ///< the trials as a BIDS dataset, too
    std::string peoplePath{}; ///< who the participants are (see StudyFacts.h); empty: nothing is known
    std::string ethics{}, consent{}, noise{}; ///< sentences for the page; empty: to be filled in

    bool operator==(const ReportJob&) const = default;
};

/// The report's files in memory, or one line. `protocol`: given by the user; none: a built-in one is looked
/// for. M only.
Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callFault);

} // namespace physvib
