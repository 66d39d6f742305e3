// SPDX-License-Identifier: MIT
// The trial files of a report, combined into one study, with what the files do not contain: facts of its
// people, and who did not finish.
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
struct PersonFacts {
    std::string participant; ///< code, as in the trial files
    std::optional<double> ageYears;
    std::string sex, handedness;
    std::string excluded; ///< why all trials are excluded; empty: they count
    std::string group{};  ///< compared with the other groups
    bool operator==(const PersonFacts&) const = default;
};

/// Facts given by the user.
struct StudyFacts {
    std::vector<PersonFacts> people;
    std::string ethics, consent; ///< sentences for the report; if empty, the report has a reminder
    std::string noise;           ///< sentence on the noise level at the ear, likewise
    std::string plan{};          ///< text of the plan (StudyReport.h); empty: none was given
    bool operator==(const StudyFacts&) const = default;

    /// Facts of a participant; empty ones if the table has none. Any thread.
    const PersonFacts& person(std::string_view participant) const noexcept {
        static const PersonFacts none;
        const auto found = std::ranges::find(people, participant, &PersonFacts::participant);
        return found == people.end() ? none : *found;
    }
    bool isExcluded(std::string_view participant) const noexcept {
        return !person(participant).excluded.empty();
    }
};

/// A table with the column participant and any of age, sex, handedness, group, excluded; or one line
/// `people.csv:3: column age: expected ...`. Any thread.
Result<std::vector<PersonFacts>> readPeople(std::string_view text, std::string_view name);

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
    RowsLeftOut leftOut;                      ///< of other programs' tables
    std::vector<std::string> notes{};         ///< participants in several files, columns not used
    std::vector<ColumnName> columns{};        ///< column mapping for tables of another program
    double guess = PsychometricModel{}.guess; ///< of psychometric functions, if no protocol says it
    std::optional<Protocol> protocol{};       ///< protocol of the files, if known
    std::string protocolNote{};               ///< why the protocol is unknown
    StudyFacts facts{};                       ///< facts given by the user in addition to the trials

    /// True if rows have a task, as in our own files; tables of other programs have less information.
    bool knowTasks() const { return all.column(trialColumns::task).has_value(); }
    /// Those of the protocol; none if it is not known.
    const std::vector<SessionPlan>& sessions() const {
        static const std::vector<SessionPlan> none;
        return protocol ? protocol->sessions : none;
    }
    /// The value of a key if the first lines of all files agree; else empty.
    std::string common(const std::string& key) const;
};

/// Returns an empty string, or why a call in a file is not allowed.
using CallCheck = std::function<std::string(std::string_view call)>;

/// Texts by name. `protocol`: given by the user; without it, a built-in one is looked up. Any thread.
Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol,
                                      const CallCheck& callFault = {});

/// Stores facts, and removes excluded people from `all`, not `files`. Error if nobody remains. Any thread.
std::string takeFacts(ReportTrials& trials, StudyFacts facts);

/// All rows but unanswered training touches; `parts` has the answers that there were. Any thread.
std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine);

/// True if a main trial of our own files was right or wrong at a level that followed the answers.
bool hasAdaptiveRows(const ReportTrials& trials);

// Sessions of the protocol that a participant's rows do not bring to their end.

/// A session in a condition that ended before the protocol ends it, or lacks rows.
struct UnfinishedRun {
    std::string participant, condition, session;
    std::size_t trials = 0;  ///< rows of it
    std::size_t planned = 0; ///< of the protocol; of a staircase or a precision: the most
    bool isAdaptive = false; ///< its threshold rests on too few trials
    std::string missing{};   ///< "trials 3, 8 to 9": not in the file, though later ones are
    bool isOver = false;     ///< its other rows bring it to its end
    bool isTraining = false;
    bool isFixed = true;    ///< so many are planned
    std::string cutShort{}; ///< "a staircase ended at 40 trials with 5 of 6 reversals": nothing else is amiss

    /// "not finished", "lacks trials 3, 8 to 9", or cutShort
    std::string why() const {
        return !cutShort.empty() ? cutShort : missing.empty() ? "not finished" : "lacks " + missing;
    }
    /// "threshold", "tests that need what is lacking" or empty
    std::string leftOut() const {
        if (isOver || isTraining) return {};
        return isAdaptive ? "threshold" : "tests that need what is lacking";
    }
};

/// Of people who are not excluded; none without a protocol. Explorations end when people like. Any thread.
std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials);

} // namespace physvib
