// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of recordings with a table of their conditions.
#pragma once
#include "Core/Limits.h"
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneFileLimits.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// Message thread only.
class RecordingList {
public:
    static constexpr const char* fileName = "conditions.csv";

    /// Reads the folder's table; or one error line if it lacks `file` or one of the `required` columns.
    static Result<RecordingList> open(const std::filesystem::path& folder,
                                      const std::vector<std::string>& required) {
        RecordingList list;
        list.folder_ = folder;
        auto table = loadCsvTable(folder / fileName);
        if (!table) return Failure{table.error};
        list.table_ = std::move(table.value);
        for (const std::string& column : required)
            if (!list.table_.column(column))
                return Failure{list.table_.name + ": expected a column " + column + ", found none"};
        if (!list.table_.column("file"))
            return Failure{list.table_.name + ": expected a column file, found none"};
        if (list.table_.rows.empty())
            return Failure{list.table_.name + ": expected a row per recording, found none"};
        return list;
    }

    const std::vector<CsvRow>& rows() const noexcept { return table_.rows; }
    const CsvTable& table() const noexcept { return table_; }
    std::string path(const CsvRow& row) const { return (folder_ / cell(row, "file")).string(); }
    /// Empty if there is no such column.
    std::string cell(const CsvRow& row, std::string_view column) const {
        const auto at = table_.column(column);
        return at ? row.cells[*at] : std::string{};
    }
    Result<double> frequencyHz(const CsvRow& row) const {
        const auto hz = parseNumber<double>(cell(row, "frequency_hz"));
        if (hz && *hz >= limits::leastMeasuredHz && *hz <= limits::maxFrequencyHz) return *hz;
        return Failure{table_.fault(row, *table_.column("frequency_hz"),
                                    "a number from " + plainNumber(limits::leastMeasuredHz) + " to " +
                                        plainNumber(limits::maxFrequencyHz))};
    }

private:
    std::filesystem::path folder_;
    CsvTable table_;
};

} // namespace physvib
