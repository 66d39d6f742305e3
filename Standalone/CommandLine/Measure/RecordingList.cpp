// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the columns of a table of recordings by name.
#include "CommandLine/Measure/RecordingList.h"
#include "Core/Limits.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneFileLimits.h"

namespace physvib {

Result<RecordingList> RecordingList::open(const std::filesystem::path& folder,
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

std::string RecordingList::cell(const CsvRow& row, std::string_view column) const {
    const auto at = table_.column(column);
    return at ? row.cells[*at] : std::string{};
}

Result<double> RecordingList::frequencyHz(const CsvRow& row) const {
    const auto hz = parseNumber<double>(cell(row, "frequency_hz"));
    if (hz && *hz >= limits::leastMeasuredHz && *hz <= limits::maxFrequencyHz) return *hz;
    return Failure{table_.fault(row, *table_.column("frequency_hz"),
                                "a number from " + plainNumber(limits::leastMeasuredHz) + " to " +
                                    plainNumber(limits::maxFrequencyHz))};
}

} // namespace physvib
