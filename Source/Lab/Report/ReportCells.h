// SPDX-License-Identifier: MIT
// Cells of a report's rows by the names of their columns.
#pragma once
#include "Io/Text/CsvTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Cells of a row by column name; an empty string for missing columns.
class Cells {
public:
    explicit Cells(const CsvTable& table)
        : table_{table} {}
    const std::string& operator()(const CsvRow& row, std::string_view column) const {
        static const std::string none;
        const auto at = table_.column(column);
        return at ? row.cells[*at] : none;
    }
    bool has(std::string_view column) const { return table_.column(column).has_value(); }

private:
    const CsvTable& table_;
};

} // namespace physvib
