// SPDX-License-Identifier: MIT
// Maps column names of other programs' tables to the names used here.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// A column name used here, and its name in a table.
struct ColumnName {
    std::string ours, theirs;
    std::optional<std::pair<double, double>> range{}; ///< table values that map to 0 and 1; none: cells are
                                                      ///< unchanged
    bool operator==(const ColumnName&) const = default;
};

/// Parses words like `response=key_resp.keys` or, for places, `x=touch_x:0:1230` (0 is the left edge, 1230
/// the right one), with each of our names once. Otherwise one line on the first invalid word. Any thread.
Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words);

/// Empty, or an error if only one of an answered and a true place has a range, because their units then
/// differ. Any thread (allocates).
std::string unitFault(std::span<const ColumnName> names);

/// Reduces `table` to the named columns, under our names. The column `observer` stays, as it may mark
/// simulated data. Rows with an empty cell in one of the columns (instructions, fixations, trials without an
/// answer) are dropped and counted. From numeric true places target_x and target_y, columns target_column and
/// target_row are derived, ascending from 1, if each axis has at most mostGridLines of them. Returns an error
/// line or an empty string; without `names` it does nothing. Any thread.
std::string takeColumns(CsvTable& table, std::span<const ColumnName> names, std::size_t& rowsLeftOut);

} // namespace physvib
