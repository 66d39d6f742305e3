// SPDX-License-Identifier: MIT
// Long tables for tests over participants, from any CSV whose columns can be named.
#pragma once
#include "Io/Result.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Statistics/LongTable.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// What is to be read, by the names of its columns.
struct LongTableColumns {
    std::string measure; ///< of numbers; `choice=RM` counts 1 where the column `choice` says RM, else 0
    std::vector<std::string> within; ///< a factor that is no column may be part of `condition` or `stimulus`:
                                     ///< `pair=wood size=small`
    std::string between;             ///< empty: no groups
    std::string participant; ///< empty: `participant` if there, else, without within-factors, every row is a
                             ///< participant
    std::vector<std::string> where{}; ///< `condition=RING`: rows that say otherwise are left out; columns or
                                      ///< factors as above
};

struct LongTableData {
    LongTable table;
    std::vector<std::string> warnings;
    bool isSimulated = false; ///< at least one row is a simulated observer's
};

/// The rows of all files; training and rows without the measure (an empty cell, NA) are left out. The first
/// thing that is wrong is told by line and column. Any thread.
Result<LongTableData> readLongTable(std::span<const NamedText> files, const LongTableColumns& columns);

} // namespace physvib
