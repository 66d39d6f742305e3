// SPDX-License-Identifier: MIT
// The trial files of a report, as one study.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Files/TrialHead.h"
#include "Lab/Report/StudyFacts.h"
#include "Lab/Statistics/Psychometric.h"
#include "Lab/Study/Protocol.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

struct TrialFile {
    std::string name; ///< without its folder
    TrialHead head;
    CsvTable table;
};

struct ReportTrials {
    std::vector<TrialFile> files;
    CsvTable all; ///< every row of every file; file by file
    bool isSimulated = false;
    std::size_t rowsLeftOut = 0;       ///< with nothing in one of the columns that were asked for
    std::string sharedNote{};          ///< who is in several files (see SharedParticipants.h); empty: nobody
    std::vector<ColumnName> columns{}; ///< of another program's tables
    double guess = PsychometricModel{}.guess; ///< of psychometric functions, where no protocol knows it
    std::optional<Protocol> protocol{};       ///< that of the files, if it is known
    std::string protocolNote{};               ///< why it is not
    StudyFacts facts{};                       ///< what the user has given beside the trials

    /// Whether rows say what was asked, as ours do; of other programs' tables less is known.
    bool knowTasks() const;
    /// A value of the files' first lines if all say the same; else empty.
    std::string common(const std::string& key) const;
};

/// Empty, or why a call in a file is none that it may hold.
using CallCheck = std::function<std::string(std::string_view call)>;

/// Of texts by their names. Files of different studies, or with different columns, are refused by name.
/// `protocol`: given by the user; none: a built-in one is looked for. Any thread.
Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol,
                                      const CallCheck& callFault = {});

/// Takes the facts, and the rows of those who are excluded out of `all` (the files keep theirs); empty, or
/// one line if nobody is left. Any thread.
std::string takeFacts(ReportTrials& trials, StudyFacts facts);

/// All rows as one table, with that first line. Touches of a training without an answer are left out. Any
/// thread.
std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine);

} // namespace physvib
