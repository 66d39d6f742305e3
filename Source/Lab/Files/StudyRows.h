// SPDX-License-Identifier: MIT
// Rows of a study table with checked access to their cells. Private to the .cpp files of Lab/Files.
#pragma once
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Files/LeftRows.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace physvib::detail {

/// Error in a study file; caught within Lab/Files.
struct StudyFault {
    std::string message;
};

/// One table with access by column name. Every member throws StudyFault.
class StudyRows {
public:
    enum class Kept { left, all }; ///< left: without the trials that did not leave as planned
    StudyRows(std::string_view text, std::string_view name, std::span<const ColumnName> columns = {},
              Kept kept = Kept::left) {
        auto read = readCsvTable(text, name, columns.empty() ? CsvHeader::named : CsvHeader::loose);
        if (!read) throw StudyFault{read.error};
        table_ = std::move(read.value);
        if (std::string fault = takeColumns(table_, columns, leftOut_); !fault.empty())
            throw StudyFault{std::move(fault)};
        if (kept == Kept::all) return;
        const LeftRows rows{table_};
        notLeft_ = std::erase_if(table_.rows, [&](const CsvRow& row) { return rows.didNotLeave(row); });
    }

    std::size_t leftOut() const noexcept { return leftOut_; } ///< rows dropped for an empty mapped cell

    std::size_t notLeft() const noexcept {
        return notLeft_;
    } ///< rows dropped as they did not leave as planned

    const CsvTable& table() const { return table_; }

    std::optional<std::size_t> optional(std::string_view column) const { return table_.column(column); }

    std::size_t required(std::string_view column) const {
        if (const auto found = table_.column(column)) return *found;
        throw StudyFault{table_.name + ": expected a column " + std::string(column) + ", found none"};
    }

    /// Calls take(row) for each row that is not training and, if the table has tasks, has this kind of
    /// answer. nullopt selects rows without a task. Returns the number of rows taken.
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

    const std::string& text(const CsvRow& row, std::size_t column) const {
        if (row.cells[column].empty()) throw StudyFault{table_.fault(row, column, "a label")};
        return row.cells[column];
    }

    static std::string textIf(const CsvRow& row, std::optional<std::size_t> column) {
        return column ? row.cells[*column] : std::string{};
    }

    double number(const CsvRow& row, std::size_t column, double least, double most) const {
        const auto found = parseNumber<double>(row.cells[column]);
        if (!found || *found < least || *found > most)
            throw StudyFault{table_.fault(
                row, column, "a number from " + plainNumber(least) + " to " + plainNumber(most))};
        return *found;
    }

    int wholeNumber(const CsvRow& row, std::size_t column, int least, int most) const {
        const auto found = parseNumber<int>(row.cells[column]);
        if (!found || *found < least || *found > most)
            throw StudyFault{table_.fault(
                row, column, "a whole number from " + std::to_string(least) + " to " + std::to_string(most))};
        return *found;
    }

    bool isSimulated() const {
        const auto holds = [](const std::string& text) {
            return text.find(trialColumns::simulated) != std::string::npos;
        };
        const auto observer = optional(trialColumns::observer);
        return std::ranges::any_of(table_.comments,
                                   [&](const auto& line) {
                                       return line.find(" observer=") != std::string::npos && holds(line);
                                   }) ||
               (observer && std::ranges::any_of(
                                table_.rows, [&](const CsvRow& row) { return holds(row.cells[*observer]); }));
    }

private:
    CsvTable table_;
    std::size_t leftOut_ = 0, notLeft_ = 0;
};

} // namespace physvib::detail
