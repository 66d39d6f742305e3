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
/// A column name used here, and its name in a table.
struct ColumnName {
    std::string ours, theirs;
    std::optional<std::pair<double, double>> range{}; ///< what maps to 0 and 1; none: cells are unchanged
    bool operator==(const ColumnName&) const = default;
};

/// Parses words like `response=key_resp.keys` or, for places, `x=touch_x:0:1230` (0 is the left edge, 1230
/// the right one), with each of our names once. Otherwise one line on the first invalid word. Any thread.
Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words);

/// Empty, or an error if only one of an answered and a true place, or of both axes, has a range, because
/// their units then differ. Any thread (allocates).
std::string unitFault(std::span<const ColumnName> names);

/// Columns of answers, beside those of scales.
inline constexpr std::string_view answerColumns[] = {"response", "choice", "correct", "value", "x", "y"};

/// What is left out of other programs' tables.
struct RowsLeftOut {
    std::size_t rows = 0; ///< instructions, fixations, trials without an answer
    /// Trials without an answer by participant: main trials, and trainings.
    std::map<std::string, std::array<std::size_t, 2>> unanswered;
    std::set<std::string> columns; ///< columns without a mapping
    std::set<std::string> stimuli; ///< named like a missing answer; such an answer counts
    /// True for other programs' words for a missing value (null, NA) in a column without codes.
    bool isNoAnswer(std::string_view column, const std::string& cell) const;
    std::string stimuliWords() const; ///< on those; empty: there is none
};

/// A table in UTF-8, one row per trial; otherwise one line on what is not as expected. With `names` it has
/// these columns alone, under our names, and `observer`; rows that lack a cell of them are dropped and
/// counted. Numbers target_x and target_y make columns target_column and target_row, ascending from 1, of at
/// most mostGridLines. Of other programs, answers that are none (null, NA) become empty, right or wrong 1 or
/// 0, phases like practice training; codes stay. A row twice is an error. Any thread (allocates).
Result<CsvTable> readStudyTable(std::string_view text, std::string_view name,
                                std::span<const ColumnName> names, RowsLeftOut& leftOut);

/// "low in second": one of several sessions of a kind; analysis.R parts such names. Any thread (allocates).
inline std::string inSession(std::string condition, const std::string& session) {
    return session.empty() ? condition : condition + " in " + session;
}

/// Whether a simulated observer gave one of the answers. Any thread.
bool saysSimulated(const CsvTable& table);
} // namespace physvib
namespace physvib::detail {
/// Error in a study file; caught within Lab/Files.
struct StudyFault {
    std::string message;
};

/// One table with access by column name. Every member throws StudyFault.
class StudyRows {
public:
    enum class Kept { left, all }; ///< left: without trials that did not leave as planned, or ran out of time
    StudyRows(std::string_view text, std::string_view name, std::span<const ColumnName> columns = {},
              Kept kept = Kept::left) {
        auto read = readStudyTable(text, name, columns, leftOut_);
        if (!read) throw StudyFault{std::move(read.error)};
        table_ = std::move(read.value);
        if (kept == Kept::all) return;
        std::erase_if(table_.rows, [&](const CsvRow& row) {
            const bool isLate = named(row, trialColumns::ranOut) == "1";
            ranOut_ += isLate && named(row, trialColumns::phase) != trialColumns::training;
            return isLate;
        });
        notLeft_ = std::erase_if(table_.rows, [&](const CsvRow& row) { return didNotLeave(table_, row); });
    }

    /// Appends a line for each kind of rows that are left out.
    void warn(std::vector<std::string>& warnings) const {
        if (leftOut_.rows > 0)
            warnings.push_back(table_.name + ": rows left out, with nothing in one of the named columns: " +
                               std::to_string(leftOut_.rows));
        if (std::string words = leftOut_.stimuliWords(); !words.empty()) warnings.push_back(std::move(words));
        if (notLeft_ > 0) warnings.push_back(table_.name + ": " + notLeftWords(notLeft_));
        if (ranOut_ > 0) warnings.push_back(table_.name + ": left out: " + ranOutWords(ranOut_));
    }

    const CsvTable& table() const { return table_; }

    std::optional<std::size_t> optional(std::string_view column) const { return table_.column(column); }

    std::size_t required(std::string_view column) const {
        if (const auto found = table_.column(column)) return *found;
        throw StudyFault{table_.name + ": expected a column " + std::string(column) + ", found none"};
    }

    /// Calls `take` for each row outside trainings with this kind of answer; returns the number of such rows.
    template <class Take>
    std::size_t each(std::optional<AnswerKind> answer, Take take) const {
        const auto phase = optional(trialColumns::phase), tasks = optional(trialColumns::task);
        std::size_t taken = 0;
        for (const CsvRow& row : table_.rows) {
            if (phase && row.cells[*phase] == trialColumns::training) continue;
            if (tasks && (answer ? answerOf(row.cells[*tasks]) != answer : !row.cells[*tasks].empty()))
                continue;
            take(row);
            ++taken;
        }
        return taken;
    }

    const std::string& named(const CsvRow& row, std::string_view column) const {
        return table_.cell(row, column);
    }

    // Columns are given by index, or by a name that is required.
    const std::string& cell(const CsvRow& row, auto column) const { return row.cells[placeOf(column)]; }

    const std::string& text(const CsvRow& row, auto column) const {
        if (cell(row, column).empty()) throw StudyFault{table_.fault(row, placeOf(column), "a label")};
        return cell(row, column);
    }

    double number(const CsvRow& row, auto column, double least, double most) const {
        return numberIn(row, placeOf(column), least, most, "a number");
    }

    int wholeNumber(const CsvRow& row, auto column, int least, int most) const {
        return numberIn(row, placeOf(column), least, most, "a whole number");
    }

    /// Sessions by what their rows are: training, kind of answer, whether answers chose levels, by QUEST+.
    using Sessions = std::map<std::tuple<bool, std::optional<AnswerKind>, bool, bool>, std::set<std::string>>;
    void addSessions(Sessions& all) const {
        if (!optional(trialColumns::task)) return; // in tables of other programs it may be a date
        for (const CsvRow& row : table_.rows) all[kindOf(row)].insert(named(row, "session"));
    }
    /// If several sessions have rows of one kind, their conditions are kept apart by session.
    void partBy(const Sessions& all) { sessions_ = all; }

    /// The row's session where there are several; else empty.
    std::string sessionOf(const CsvRow& row) const {
        const auto own = sessions_.find(kindOf(row));
        return own != sessions_.end() && own->second.size() > 1 ? named(row, "session") : std::string{};
    }
    /// The name of the row's condition, empty if it has none.
    std::string conditionOf(const CsvRow& row) const {
        return inSession(named(row, "condition"), sessionOf(row));
    }

private:
    static std::size_t placeOf(std::size_t column) { return column; }
    std::size_t placeOf(std::string_view column) const { return required(column); }
    template <class Number>
    Number numberIn(const CsvRow& row, std::size_t column, Number least, Number most,
                    const std::string& what) const {
        const auto found = parseNumber<Number>(row.cells[column]);
        if (!found || *found < least || *found > most)
            throw StudyFault{
                table_.fault(row, column, what + " from " + plainNumber(least) + " to " + plainNumber(most))};
        return *found;
    }
    Sessions::key_type kindOf(const CsvRow& row) const {
        return {named(row, trialColumns::phase) == trialColumns::training,
                answerOf(named(row, trialColumns::task)),
                !named(row, "correct").empty() && !named(row, "level_db").empty(),
                !named(row, trialColumns::quest).empty()};
    }

    CsvTable table_;
    Sessions sessions_;
    RowsLeftOut leftOut_;
    std::size_t notLeft_ = 0, ranOut_ = 0;
};
} // namespace physvib::detail

// Participants in more than one table: one person with several files, or two people with the same code.

namespace physvib {
class SharedParticipants {
public:
    /// Adds a table by its head and its participants. Returns one line if it is a trial file of a participant
    /// of whom another file of the same protocol was added, else an empty string. Any thread (allocates).
    std::string add(const CsvTable& head, const std::set<std::string>& participants);
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
