// SPDX-License-Identifier: MIT
// Reads long tables for tests over participants from any CSV file, by column names.
#pragma once
#include "Io/Result.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Statistics/LongTable.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// Names of the columns to read.
struct LongTableColumns {
    std::string measure; ///< numeric column; `choice=RM` gives 1 where the column `choice` contains RM, else
                         ///< 0
    std::vector<std::string> within; ///< a factor without a column of its own may be part of `condition` or
                                     ///< `stimulus`: `pair=wood size=small`
    std::string between;             ///< empty: no groups
    std::string participant; ///< empty: `participant` if that column exists; else, without within-factors,
                             ///< each row is a participant
    std::vector<std::string> where{}; ///< filters like `condition=RING`, on columns or factors as above;
                                      ///< other rows are dropped
};

struct LongTableData {
    LongTable table;
    std::vector<std::string> warnings;
    bool isSimulated = false; ///< at least one row comes from a simulated observer
};

/// Reads the rows of all files, without training and rows without the measure (an empty cell, NA). The first
/// error names line and column. Any thread.
Result<LongTableData> readLongTable(std::span<const NamedText> files, const LongTableColumns& columns);

} // namespace physvib
