// SPDX-License-Identifier: MIT
// Columns are found once, then every row is shortened to them.
#include "Study/Files/ColumnNames.h"
#include "Io/Text/NumberText.h"
#include "Study/Files/TrialColumns.h"
#include <algorithm>

namespace physvib {

Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words) {
    std::vector<ColumnName> names;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
            return Failure{"expected NAME=COLUMN of the table, e.g. response=key_resp.keys, found " + inQuotes(word)};
        names.push_back({word.substr(0, equals), word.substr(equals + 1)});
        if (std::ranges::count(names, names.back().ours, &ColumnName::ours) > 1) return Failure{"expected each name once, found " + inQuotes(names.back().ours) + " twice"};
    }
    return names;
}

std::string takeColumns(CsvTable& table, std::span<const ColumnName> names, std::size_t& rowsLeftOut) {
    if (names.empty()) return {};
    std::vector<std::size_t> from;
    std::vector<std::string> columns;
    for (const ColumnName& name : names) {
        const auto found = table.column(name.theirs);
        if (!found) return table.name + ": expected a column " + printable(name.theirs) + ", found none";
        from.push_back(*found);
        columns.push_back(name.ours);
    }
    if (const auto observer = table.column(trialColumns::observer); observer && std::ranges::find(columns, trialColumns::observer) == columns.end()) {
        from.push_back(*observer);
        columns.emplace_back(trialColumns::observer);
    }
    const auto isWhole = [&](const CsvRow& row) {
        return std::ranges::none_of(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(names.size()), [&](std::size_t c) { return row.cells[c].empty(); });
    };
    rowsLeftOut += std::erase_if(table.rows, [&](const CsvRow& row) { return !isWhole(row); });
    for (CsvRow& row : table.rows) {
        std::vector<std::string> cells;
        for (const std::size_t c : from) cells.push_back(row.cells[c]);
        row.cells = std::move(cells);
    }
    table.columns = std::move(columns);
    if (table.rows.empty()) return table.name + ": expected rows with something in every named column, found none";
    return {};
}

} // namespace physvib
