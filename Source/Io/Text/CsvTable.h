// SPDX-License-Identifier: MIT
// CSV files as tables of strings: columns by name, quoted cells where they contain commas.
#pragma once
#include "Io/Result.h"
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

struct CsvRow {
    std::size_t line = 0; ///< line number in the file, from 1
    std::vector<std::string> cells;
};

struct CsvTable {
    std::string name;                  ///< name of the file, for messages
    std::vector<std::string> comments; ///< lines before the header, without their #
    std::vector<std::string> columns;
    std::vector<CsvRow> rows; ///< each with as many cells as there are columns

    /// Index of the column; nullopt: there is none of that name.
    std::optional<std::size_t> column(std::string_view columnName) const noexcept;

    /// The row's cell of that column; empty if there is no such column.
    const std::string& cell(const CsvRow& row, std::string_view columnName) const;

    /// The error line `NAME:17: column x: expected EXPECTED, found "CELL"`.
    std::string cellError(const CsvRow& row, std::size_t column, std::string_view expected) const;
};

/// named: every column has a unique name. loose: names may be missing or repeated, as in files of experiment
/// programs; the first column of a name counts.
enum class CsvHeader { named, loose };

/// The table in `text`, or a one-line error naming file, line and expectation. A header line names the
/// columns; comments (#) and blank lines may precede it, blank lines may end the file. A cell in double
/// quotes may contain commas and doubled quotes, but no line end. As spreadsheets write them: semicolons
/// (with decimal commas) or tabs instead of commas, a first line sep=;, a separator after every last
/// cell. Any thread.
Result<CsvTable> readCsvTable(std::string_view text, std::string_view name,
                              CsvHeader header = CsvHeader::named);

/// Reads a file, with the checks and errors of readCsvTable(). Message thread only.
Result<CsvTable> loadCsvTable(const std::filesystem::path& path);

/// Appends `text` as a cell, quoted if necessary, with an apostrophe if a spreadsheet would evaluate it as a
/// formula (the reader removes it); control characters become spaces. Any thread.
void appendCell(std::string& line, std::string_view text);

/// The cells as a line of CSV with its newline. Any thread.
inline std::string csvLine(const auto& cells) {
    std::string line;
    bool isFirst = true;
    for (const auto& cell : cells) {
        if (!std::exchange(isFirst, false)) line += ',';
        appendCell(line, cell);
    }
    return line + "\n";
}

} // namespace physvib
