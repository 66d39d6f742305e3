// SPDX-License-Identifier: MIT
// Tables of trials, ours and other programs': names of columns, rows with checked access to their cells,
// people who are in several tables, and limits.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

// Maps column names of other programs' tables to the names used here.

namespace physvib {
/// A column's name in this program, and its name in another program's table.
struct ColumnName {
    std::string ours, theirs;
    std::optional<std::pair<double, double>> range{}; ///< numbers that become 0 and 1; none: no change
    bool operator==(const ColumnName&) const = default;
};

/// Parses words like `response=key_resp.keys` or, for places, `x=touch_x:0:1230` (0 is the left edge, 1230
/// the right one), with each of our names once. Otherwise one line on the first invalid word. Any thread.
Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words);

/// Empty, or an error if only one of an answered and a true place, or of both axes, has a range, because
/// their units then differ. Any thread (allocates).
std::string unitError(std::span<const ColumnName> names);

/// Columns of answers, beside those of scales.
inline constexpr std::string_view answerColumns[] = {"response", "choice", "correct", "value", "x", "y"};

/// Rows, columns and answers of other programs' tables that are not used.
struct ExcludedRows {
    std::size_t rowCount = 0; ///< instructions, fixations, trials without an answer
    /// Trials without an answer by participant: main trials, and trainings.
    std::map<std::string, std::array<std::size_t, 2>> unanswered;
    std::set<std::string> columns; ///< columns without a mapping
    std::set<std::string> stimuli; ///< stimuli with a name like NA; such an answer is not missing
    /// True for other programs' words for a missing value (null, NA) in a column without codes.
    bool isMissingAnswer(std::string_view column, const std::string& cell) const;
    std::string stimuliNote() const; ///< a note on `stimuli`; empty if there are none
};

/// Reads a table in UTF-8 with one row per trial, or returns an error line. With `names` the result has only
/// these columns, under our names, and `observer`; rows without a value in one of them are dropped and
/// counted in `excluded`. Values of target_x and target_y, if at most maxGridLines, are numbered from 1 in
/// target_column and target_row. In other programs' tables, missing answers (null, NA) become empty, right
/// and wrong 1 and 0, and phases like practice training. Two equal rows are an error. Any thread.
Result<CsvTable> readStudyTable(std::string_view text, std::string_view name,
                                std::span<const ColumnName> names, ExcludedRows& excluded);

/// "low in second": a condition in one of several sessions; analysis.R splits such names. Any thread.
inline std::string nameInSession(std::string condition, const std::string& session) {
    return session.empty() ? condition : condition + " in " + session;
}

/// Whether a simulated observer gave one of the answers. Any thread.
bool hasSimulatedAnswers(const CsvTable& table);
} // namespace physvib
namespace physvib::detail {
/// Error in a study file; caught within Lab/Files.
struct StudyTableError {
    std::string message;
};

/// One table with access by column name. Every member throws StudyTableError.
class StudyRows {
public:
    enum class RowFilter { answered, all }; ///< answered: without undelivered and timed-out trials
    StudyRows(std::string_view text, std::string_view name, std::span<const ColumnName> columns = {},
              RowFilter filter = RowFilter::answered) {
        auto read = readStudyTable(text, name, columns, excluded_);
        if (!read) throw StudyTableError{std::move(read.error)};
        table_ = std::move(read.value);
        if (filter == RowFilter::all) return;
        std::erase_if(table_.rows, [&](const CsvRow& row) {
            const bool hasTimedOut = cellOrEmpty(row, trialColumns::timedOut) == "1";
            timedOutTrials_ += hasTimedOut && cellOrEmpty(row, trialColumns::phase) != trialColumns::training;
            return hasTimedOut;
        });
        undeliveredTrials_ =
            std::erase_if(table_.rows, [&](const CsvRow& row) { return wasNotDelivered(table_, row); });
    }

    /// Appends a line for each kind of rows that are left out.
    void addWarnings(std::vector<std::string>& warnings) const {
        if (excluded_.rowCount > 0)
            warnings.push_back(table_.name + ": rows left out, with nothing in one of the named columns: " +
                               std::to_string(excluded_.rowCount));
        if (std::string words = excluded_.stimuliNote(); !words.empty()) warnings.push_back(std::move(words));
        if (undeliveredTrials_ > 0)
            warnings.push_back(table_.name + ": " + undeliveredNote(undeliveredTrials_));
        if (timedOutTrials_ > 0)
            warnings.push_back(table_.name + ": left out: " + timeOutNote(timedOutTrials_));
    }

    const CsvTable& table() const { return table_; }

    std::optional<std::size_t> findColumn(std::string_view column) const { return table_.column(column); }

    std::size_t requireColumn(std::string_view column) const {
        if (const auto found = table_.column(column)) return *found;
        throw StudyTableError{table_.name + ": expected a column " + std::string(column) + ", found none"};
    }

    /// Calls `visit` for each row outside trainings with this kind of answer; nullopt: rows without a task.
    /// Returns their number.
    template <class Visit>
    std::size_t forEachRow(std::optional<AnswerKind> answer, Visit visit) const {
        const auto phase = findColumn(trialColumns::phase), tasks = findColumn(trialColumns::task);
        std::size_t visited = 0;
        for (const CsvRow& row : table_.rows) {
            if (phase && row.cells[*phase] == trialColumns::training) continue;
            if (tasks && (answer ? answerKindOf(row.cells[*tasks]) != answer : !row.cells[*tasks].empty()))
                continue;
            visit(row);
            ++visited;
        }
        return visited;
    }

    const std::string& cellOrEmpty(const CsvRow& row, std::string_view column) const {
        return table_.cell(row, column);
    }

    // Columns are given by index, or by a name that must exist. A text must not be empty.
    const std::string& cell(const CsvRow& row, auto column) const { return row.cells[columnIndex(column)]; }

    const std::string& text(const CsvRow& row, auto column) const {
        if (cell(row, column).empty())
            throw StudyTableError{table_.cellError(row, columnIndex(column), "a label")};
        return cell(row, column);
    }

    double number(const CsvRow& row, auto column, double min, double max) const {
        return readNumber(row, columnIndex(column), min, max, "a number");
    }

    int wholeNumber(const CsvRow& row, auto column, int min, int max) const {
        return readNumber(row, columnIndex(column), min, max, "a whole number");
    }

    /// Sessions by the kind of their rows: training, kind of answer, whether levels adapt, whether by QUEST+.
    using Sessions = std::map<std::tuple<bool, std::optional<AnswerKind>, bool, bool>, std::set<std::string>>;
    void addSessions(Sessions& all) const {
        if (!findColumn(trialColumns::task)) return; // in tables of other programs it may be a date
        for (const CsvRow& row : table_.rows) all[sessionKind(row)].insert(cellOrEmpty(row, "session"));
    }
    /// If several sessions have rows of one kind, conditionOf() adds the session to the condition's name.
    void separateSessions(const Sessions& all) { sessions_ = all; }

    /// The row's session if several sessions have rows of its kind; else empty.
    std::string sessionOf(const CsvRow& row) const {
        const auto found = sessions_.find(sessionKind(row));
        return found != sessions_.end() && found->second.size() > 1 ? cellOrEmpty(row, "session")
                                                                    : std::string{};
    }
    /// The name of the row's condition, empty if it has none.
    std::string conditionOf(const CsvRow& row) const {
        return nameInSession(cellOrEmpty(row, "condition"), sessionOf(row));
    }

private:
    static std::size_t columnIndex(std::size_t column) { return column; }
    std::size_t columnIndex(std::string_view column) const { return requireColumn(column); }
    template <class Number>
    Number readNumber(const CsvRow& row, std::size_t column, Number min, Number max,
                      const std::string& expected) const {
        const auto found = parseNumber<Number>(row.cells[column]);
        if (!found || *found < min || *found > max)
            throw StudyTableError{table_.cellError(
                row, column, expected + " from " + plainNumber(min) + " to " + plainNumber(max))};
        return *found;
    }
    Sessions::key_type sessionKind(const CsvRow& row) const {
        return {cellOrEmpty(row, trialColumns::phase) == trialColumns::training,
                answerKindOf(cellOrEmpty(row, trialColumns::task)),
                !cellOrEmpty(row, "correct").empty() && !cellOrEmpty(row, "level_db").empty(),
                !cellOrEmpty(row, trialColumns::quest).empty()};
    }

    CsvTable table_;
    Sessions sessions_;
    ExcludedRows excluded_;
    std::size_t undeliveredTrials_ = 0, timedOutTrials_ = 0;
};
} // namespace physvib::detail

// Participants in more than one table: one person with several files, or two people with the same code.

namespace physvib {
class SharedParticipants {
public:
    /// Adds a table by its head and its participants. Returns one line if it is a trial file of a participant
    /// of whom another file of the same protocol was added, else an empty string. Any thread (allocates).
    std::string add(const CsvTable& table, const std::set<std::string>& participants);
    /// Adds a whole table, by its participant column if it has one.
    std::string add(const CsvTable& table, std::string_view column = "participant");

    /// Lists participants in several tables, who count as one person; empty if there are none.
    std::string note() const;

private:
    std::map<std::pair<std::string, std::string>, std::string> trialFiles_; // by protocol and participant
    std::map<std::string, std::vector<std::string>> tables_;                // by participant
    std::map<std::string, std::string> rows_;                               // by their hash
};
} // namespace physvib

// Size limits of study files, with the reason for each value.

namespace physvib::limits {
constexpr std::size_t maxProtocolFileBytes = 1'000'000; // a protocol with many conditions has a few kB
constexpr std::size_t maxCouplingFileBytes = 4'000'000; // four actuators need 1 kB per frequency, 64 need 100
constexpr std::size_t maxConditions = 4096;             // per analysis; they are searched linearly
constexpr std::size_t maxLabels = 2048; // stimuli and responses; five actuators have 1240 patterns
} // namespace physvib::limits
