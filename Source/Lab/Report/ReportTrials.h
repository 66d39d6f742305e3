// SPDX-License-Identifier: MIT
// The trial files of a report, combined into one study; facts on its participants, which the files do not
// contain; and the sessions that participants did not finish.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Psychometric.h"
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

// Facts of a study that trial files do not contain.

/// One participant; unknown fields are empty.
struct ParticipantFacts {
    std::string participant; ///< code, as in the trial files
    std::optional<double> ageYears;
    std::string sex, handedness;
    std::string excluded; ///< why all trials are excluded; empty: they count
    std::string group{};  ///< compared with the other groups
    bool operator==(const ParticipantFacts&) const = default;
};

/// Facts given by the user.
struct StudyFacts {
    std::vector<ParticipantFacts> people;
    std::string ethics, consent; ///< sentences for the report; if empty, the report has a reminder
    std::string noise;           ///< sentence on the noise level at the ear, likewise
    std::string plan{};          ///< text of the plan (StudyReport.h); empty: none was given
    bool operator==(const StudyFacts&) const = default;

    /// Facts of a participant; empty ones if the table has none. Any thread.
    const ParticipantFacts& person(std::string_view participant) const noexcept {
        static const ParticipantFacts none;
        const auto found = std::ranges::find(people, participant, &ParticipantFacts::participant);
        return found == people.end() ? none : *found;
    }
    bool isExcluded(std::string_view participant) const noexcept {
        return !person(participant).excluded.empty();
    }
};

/// A table with the column participant and any of age, sex, handedness, group, excluded; or one line
/// `people.csv:3: column age: expected ...`. Any thread.
Result<std::vector<ParticipantFacts>> readParticipantFacts(std::string_view text, std::string_view name);

struct TrialFile {
    std::string name; ///< without folder
    TrialHead head;
    CsvTable table;
    std::vector<StudyEvent> times{}; ///< events of the file of times beside it; empty: no such file
};

struct ReportTrials {
    std::vector<TrialFile> files;
    CsvTable all;                    ///< rows of all files, file by file, without `undelivered`
    std::vector<CsvRow> undelivered; ///< rows of trials that did not leave as planned, with the columns of
                                     ///< `all`
    bool isSimulated = false;
    ExcludedRows excluded;                    ///< what is not used of other programs' tables
    std::vector<std::string> notes{};         ///< participants in several files, columns not used
    std::vector<ColumnName> columns{};        ///< column mapping for tables of another program
    double guess = PsychometricModel{}.guess; ///< guess rate of functions, if no protocol gives it
    std::optional<Protocol> protocol{};       ///< protocol of the files, if known
    std::string protocolNote{};               ///< why the protocol is unknown
    StudyFacts facts{};                       ///< facts given by the user in addition to the trials

    /// True if rows have a task, as in our own files; tables of other programs have less information.
    bool hasTasks() const { return all.column(trialColumns::task).has_value(); }
    /// Sessions of the protocol; empty if it is not known.
    const std::vector<SessionPlan>& sessions() const {
        static const std::vector<SessionPlan> none;
        return protocol ? protocol->sessions : none;
    }
    /// The value of a key if the first lines of all files agree; else empty.
    std::string commonValue(const std::string& key) const;
};

/// Returns an empty string, or why a call in a file is not allowed.
using CallCheck = std::function<std::string(std::string_view call)>;

/// `texts`: file names and contents. `protocol`: the user's; else a built-in one is looked up. Any thread.
Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol,
                                      const CallCheck& callError = {});

/// Stores facts, and removes excluded people from `all`. Returns an error if nobody remains. Any thread.
std::string applyFacts(ReportTrials& trials, StudyFacts facts);

/// All rows except explorations as CSV; `parts` also lists the offered answers. Any thread.
std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine);

/// True if main trials of our own files have levels that followed the answers. Any thread.
bool hasAdaptiveRows(const ReportTrials& trials);

// Sessions of the protocol that a participant did not complete.

/// A session in a condition that ended before the protocol ends it, or lacks rows.
struct UnfinishedRun {
    std::string participant, condition, session;
    std::size_t trials = 0;  ///< number of its rows
    std::size_t planned = 0; ///< number of rows by the protocol; the maximum of an adaptive run
    bool isAdaptive = false; ///< levels follow the answers: its threshold lacks trials
    std::string missing{};   ///< "trials 3, 8 to 9": not in the file, though later ones are
    bool isComplete = false; ///< it reached its end, though rows are missing
    bool isTraining = false;
    bool hasFixedCount = true; ///< `planned` is exact; false: an upper limit
    std::string earlyEnd{}; ///< "a staircase ended at 40 trials with 5 of 6 reversals", without another error

    /// "not finished", "lacks trials 3, 8 to 9", or earlyEnd
    std::string reason() const {
        return !earlyEnd.empty() ? earlyEnd : missing.empty() ? "not finished" : "lacks " + missing;
    }
    /// "threshold", "tests that need what is lacking" or empty
    std::string excludedFrom() const {
        if (isComplete || isTraining) return {};
        return isAdaptive ? "threshold" : "tests that need what is lacking";
    }
};

/// Unfinished runs of people who are not excluded, no explorations; none without a protocol. Any thread.
std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials);

} // namespace physvib
