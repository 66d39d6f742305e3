// SPDX-License-Identifier: MIT
// A CSV file as a table of words: columns by name, cells in quotes where they hold commas.
#pragma once
#include "Io/Result.h"
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct CsvRow {
    std::size_t line = 0; ///< of the file, from 1
    std::vector<std::string> cells;
};

struct CsvTable {
    std::string name;                  ///< of the file, for messages
    std::vector<std::string> comments; ///< lines before the header, without their #
    std::vector<std::string> columns;
    std::vector<CsvRow> rows; ///< each with as many cells as there are columns

    std::optional<std::size_t> column(std::string_view wanted) const noexcept;

    /// `name:17: column x: expected what, found "cell"`.
    std::string fault(const CsvRow& row, std::size_t column, std::string_view expected) const;
};

/// Whether every column must have a name of its own. Experiment programs end lines with a comma, or name
/// columns twice: of loose ones only those that are asked for matter, and of equal names the first counts.
enum class CsvHeader { named, loose };

/// The table that `text` holds, or one line naming file, line and expectation. A header line names the
/// columns, each once; comments (#) and blank lines may stand before it, blank lines at the end. A cell in
/// double quotes may hold commas and doubled quotes, no line end. Any thread.
Result<CsvTable> readCsvTable(std::string_view text, std::string_view name,
                              CsvHeader header = CsvHeader::named);

/// The same of a file. M only.
Result<CsvTable> loadCsvTable(const std::filesystem::path& path);

/// Row by row, for those who keep less than the table: `begin` gets it without rows, `take` one row at a
/// time. What either says is wrong ends the reading; it, or what is wrong with the text, comes back: a whole
/// line, empty if all is well. Any thread.
std::string eachCsvRow(std::string_view text, std::string_view name,
                       const std::function<std::string(const CsvTable&)>& begin,
                       const std::function<std::string(const CsvRow&)>& take);

/// Appends `text` as a cell, in quotes if it needs them, behind an apostrophe if a spreadsheet would take it
/// for a formula (the reader takes it off); control characters become spaces. Any thread.
void appendCell(std::string& line, std::string_view text);

} // namespace physvib
