// SPDX-License-Identifier: MIT
// The trial files of a report, combined into one study.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Files/StudyTimes.h"
#include "Lab/Files/TrialHead.h"
#include "Lab/Report/StudyFacts.h"
#include "Lab/Statistics/Psychometric.h"
#include "Lab/Study/Protocol.h"
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

struct TrialFile {
    std::string name; ///< without folder
    TrialHead head;
    CsvTable table;
    std::vector<StudyMoment> times{}; ///< of the file beside it; empty: there is none
};

struct ReportTrials {
    std::vector<TrialFile> files;
    CsvTable all;                ///< rows of all files, file by file, without `notLeft`
    std::vector<CsvRow> notLeft; ///< rows of trials that did not leave as planned, with the columns of `all`
    bool isSimulated = false;
    std::size_t rowsLeftOut = 0; ///< rows dropped for an empty cell in a mapped column
    std::string sharedNote{};    ///< participants in several files (see SharedParticipants.h); empty: none
    std::vector<ColumnName> columns{};        ///< column mapping for tables of another program
    double guess = PsychometricModel{}.guess; ///< guess rate of psychometric functions if no protocol
                                              ///< specifies it
    std::optional<Protocol> protocol{};       ///< protocol of the files, if known
    std::string protocolNote{};               ///< why the protocol is unknown
    StudyFacts facts{};                       ///< facts given by the user in addition to the trials

    /// True if rows have a task, as in our own files; tables of other programs have less information.
    bool knowTasks() const;
    /// The value of a key if the first lines of all files agree; else empty.
    std::string common(const std::string& key) const;
};

/// Returns an empty string, or why a call in a file is not allowed.
using CallCheck = std::function<std::string(std::string_view call)>;

/// Reads named texts. Files of different studies or with different columns give an error that names them.
/// `protocol`: given by the user; without it, a built-in one is looked up. Any thread.
Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol,
                                      const CallCheck& callFault = {});

/// Stores the facts and removes the rows of excluded participants from `all` (`files` keeps them). Returns a
/// line if no participant remains, else an empty string. Any thread.
std::string takeFacts(ReportTrials& trials, StudyFacts facts);

/// All rows as one table with that first line, without unanswered training touches. Any thread.
std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine);

} // namespace physvib
