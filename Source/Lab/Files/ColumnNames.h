// SPDX-License-Identifier: MIT
// Other programs' tables under our columns' names: the one place that maps them.
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

/// A column of ours, and what a table calls it.
struct ColumnName {
    std::string ours, theirs;
    std::optional<std::pair<double, double>> range{}; ///< the table's numbers that are 0 and 1 here; none:
                                                      ///< cells stay as they are
    bool operator==(const ColumnName&) const = default;
};

/// Of words like `response=key_resp.keys` or, of places, `x=touch_x:0:1230` (0 is the left edge, 1230 the
/// right one), each of ours once; or one line on the first that is none. Any thread.
Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words);

/// Empty, or that of an answered and a true place only one has a range: they are in different units. Any
/// thread (allocates).
std::string unitFault(std::span<const ColumnName> names);

/// Makes `table` one of the named columns alone, under our names; `observer` stays, as it may mark a
/// simulation. Rows with nothing in one of the columns (instructions, fixations, trials without an answer)
/// are left out and counted. Of columns target_x and target_y (true places, as numbers) come target_column
/// and target_row, in their order from 1, if there are at most mostGridLines of them along each axis. What is
/// wrong: a line; empty names: nothing happens. Any thread.
std::string takeColumns(CsvTable& table, std::span<const ColumnName> names, std::size_t& rowsLeftOut);

} // namespace physvib
