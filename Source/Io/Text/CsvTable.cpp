// SPDX-License-Identifier: MIT
// Strict CSV parser: splits lines into cells, and reports errors by line.
#include "Io/Text/CsvTable.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <utility>

namespace physvib {
namespace {

/// Removes a cell from the front of `rest`; false if its quotes do not match.
bool readCell(std::string_view& rest, std::string& cell, char separator) {
    const std::size_t start = std::min(rest.find_first_not_of(separator == '\t' ? " " : " \t"), rest.size());
    if (start == rest.size() || rest[start] != '"') {
        cell = trimmed(takeUntil(separator, rest));
        return cell.find('"') == std::string::npos;
    }
    rest.remove_prefix(start + 1);
    cell.clear();
    for (;;) {
        const std::size_t quote = rest.find('"');
        if (quote == std::string_view::npos) return false;
        cell.append(rest.substr(0, quote));
        rest.remove_prefix(quote + 1);
        if (!rest.starts_with('"')) break;
        cell += '"';
        rest.remove_prefix(1);
    }
    return trimmed(takeUntil(separator, rest)).empty();
}

/// Replaces a decimal comma, which spreadsheets write where other characters separate cells, by a point.
void convertDecimalComma(std::string& cell) {
    const std::size_t comma = cell.find(',');
    if (comma == std::string::npos || cell.find('.') != std::string::npos) return;
    std::string number = cell;
    number[comma] = '.';
    if (parseNumber<double>(number)) cell = std::move(number);
}

/// True if a spreadsheet would evaluate the text as a formula, which a leading apostrophe prevents. Also true
/// if it has apostrophes before that: it gets one more, so that reading restores it.
bool isFormula(std::string_view text) noexcept {
    const std::size_t first = std::min(text.find_first_not_of('\''), text.size());
    constexpr std::string_view signs = "=+-@";
    return first < text.size() && signs.find(text[first]) != std::string_view::npos &&
           !parseNumber<double>(text);
}

class TableReader {
public:
    TableReader(std::string_view text, std::string_view name, CsvHeader header)
        : unread_{text}
        , header_{header} {
        table_.name = name;
        dropByteOrderMark(unread_);
    }
    Result<CsvTable> read() {
        if (!readHeader()) return Failure{errorLine()};
        for (CsvRow row; readRow(row) && addRow(row);) row.cells.reserve(table_.columns.size());
        if (error_.empty() && !table_.columns.empty() && table_.columns.back().empty()) dropLastColumn();
        if (error_.empty() && table_.rows.empty()) fail("expected rows after the header, found none");
        if (!error_.empty()) return Failure{errorLine()};
        return std::move(table_);
    }

private:
    std::string errorLine() const {
        return table_.name + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + error_;
    }

    /// Programs that end every line with a separator have a last column without name and cells.
    void dropLastColumn() {
        for (CsvRow& row : table_.rows) {
            if (!row.cells.back().empty() && header_ == CsvHeader::named) {
                line_ = row.line;
                fail("expected nothing in the last column, which has no name");
                return;
            }
            row.cells.pop_back();
        }
        table_.columns.pop_back();
    }
    /// Sets the separator to the first of , ; and tab that the header has.
    void detectSeparator(std::string_view line) {
        for (const char candidate : {',', ';', '\t'})
            if (line.find(candidate) != std::string_view::npos) {
                separator_ = candidate;
                return;
            }
    }
    bool readHeader() {
        std::string_view header;
        if (unread_.starts_with("\xFF\xFE") || unread_.starts_with("\xFE\xFF") ||
            unread_.substr(0, 2).find('\0') < 2)
            return fail("expected UTF-8, found UTF-16: save it as CSV UTF-8");
        while (header.empty()) {
            if (unread_.empty()) return fail("expected a header line, found the end of the file");
            header = nextLine();
            if (table_.columns.empty() && header.starts_with("sep=") && header.size() == 5) {
                isSeparatorStated_ = true;
                separator_ = header.back();
                header = {};
            }
            if (!header.starts_with('#')) continue;
            if (table_.comments.size() < limits::maxTableColumns)
                table_.comments.emplace_back(trimmed(header.substr(1)));
            header = {};
        }
        if (!isSeparatorStated_) detectSeparator(header);
        if (!readCells(header, table_.columns)) return false;
        for (const std::string& column : table_.columns) {
            if (header_ == CsvHeader::loose) break;
            if (column.empty() && &column != &table_.columns.back())
                return fail("expected a name for every column");
            if (std::ranges::count(table_.columns, column) > 1)
                return fail("column " + printable(column) + " appears twice");
        }
        return true;
    }
    bool readRow(CsvRow& row) {
        if (unread_.find_first_not_of(" \t\r\n") == std::string_view::npos) return false;
        const std::string_view line = nextLine();
        row.cells.clear();
        row.line = line_;
        if (!readCells(line, row.cells)) return false;
        return row.cells.size() == table_.columns.size() ||
               fail("expected " + std::to_string(table_.columns.size()) + " cells, found " +
                    std::to_string(row.cells.size()) + " (a cell with a comma stands in quotes)");
    }
    bool addRow(CsvRow& row) {
        if (table_.rows.size() == limits::maxTableRows)
            return fail("expected at most " + std::to_string(limits::maxTableRows) + " rows");
        if ((table_.rows.size() + 1) * table_.columns.size() > limits::maxTableCells)
            return fail("expected at most " + std::to_string(limits::maxTableCells) + " cells in all");
        table_.rows.push_back({row.line, std::exchange(row.cells, {})});
        return true;
    }
    bool readCells(std::string_view line, std::vector<std::string>& cells) {
        for (bool hasMore = !line.empty(); hasMore;) {
            if (cells.size() == limits::maxTableColumns)
                return fail("expected at most " + std::to_string(limits::maxTableColumns) +
                            " cells in a row");
            const std::string_view unread = line;
            if (!readCell(line, cells.emplace_back(), separator_))
                return fail("expected quotes around whole cells, and in pairs");
            if (cells.back().starts_with('\'') && isFormula(cells.back())) cells.back().erase(0, 1);
            if (separator_ != ',') convertDecimalComma(cells.back());
            if (cells.back().size() > limits::maxCellBytes)
                return fail("expected cells of at most " + std::to_string(limits::maxCellBytes) + " bytes");
            const std::size_t cellBytes = unread.size() - line.size();
            hasMore = cellBytes > 0 && unread[cellBytes - 1] == separator_;
        }
        return true;
    }
    std::string_view nextLine() {
        ++line_;
        std::string_view line = takeUntil('\n', unread_);
        if (separator_ != '\t') return trimmed(line);
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }
    bool fail(std::string message) {
        error_ = std::move(message);
        return false;
    }

    std::string_view unread_;
    CsvHeader header_;
    char separator_ = ',';
    bool isSeparatorStated_ = false; // by a first line sep=;
    std::size_t line_ = 0;
    CsvTable table_;
    std::string error_;
};

} // namespace

std::optional<std::size_t> CsvTable::column(std::string_view columnName) const noexcept {
    const auto found = std::ranges::find(columns, columnName);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
}

const std::string& CsvTable::cell(const CsvRow& row, std::string_view columnName) const {
    static const std::string noCell;
    const auto index = column(columnName);
    return index ? row.cells[*index] : noCell;
}

std::string CsvTable::cellError(const CsvRow& row, std::size_t index, std::string_view expected) const {
    return name + ":" + std::to_string(row.line) + ": column " + printable(columns[index]) + ": expected " +
           std::string(expected) + ", found " + inQuotes(row.cells[index]);
}

Result<CsvTable> readCsvTable(std::string_view text, std::string_view name, CsvHeader header) {
    return TableReader{text, name, header}.read();
}

Result<CsvTable> loadCsvTable(const std::filesystem::path& path) {
    return loadText(path, limits::maxTableBytes,
                    [](std::string_view text, std::string_view name) { return readCsvTable(text, name); });
}

void appendCell(std::string& line, std::string_view text) {
    const bool needsQuotes =
        text.find_first_of(",\"#") != std::string_view::npos || text.starts_with(' ') || text.ends_with(' ');
    if (needsQuotes) line += '"';
    if (isFormula(text)) line += '\'';
    for (const char c : text) {
        if (c == '"') line += '"';
        line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    if (needsQuotes) line += '"';
}

} // namespace physvib
