// SPDX-License-Identifier: GPL-3.0-or-later
// Accelerometer recordings: a folder of them with a table of their conditions, the levels and tones of their
// channels, and frequency bands as text.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/Limits.h"
#include "Io/Disk/FileClash.h"
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <complex>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// The recordings of a folder, one per row of its conditions.csv. Message thread.
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
        return list;
    }

    const std::vector<CsvRow>& rows() const noexcept { return table_.rows; }
    const CsvTable& table() const noexcept { return table_; }
    std::string path(const CsvRow& row) const { return (folder_ / cell(row, "file")).string(); }
    /// Empty, or one line on an output that is the table of conditions or one of its recordings.
    std::string clashError(std::span<const std::string> outputs) const {
        std::vector<std::string> inputs{(folder_ / fileName).string()};
        for (const CsvRow& row : rows()) inputs.push_back(path(row));
        return fileClashError(outputs, inputs);
    }
    /// Empty if there is no such column.
    std::string cell(const CsvRow& row, std::string_view column) const {
        const auto index = table_.column(column);
        return index ? row.cells[*index] : std::string{};
    }
    /// The number in the column frequency_hz; or one error line if it is out of range.
    Result<double> frequencyHz(const CsvRow& row) const {
        const auto hz = parseNumber<double>(cell(row, "frequency_hz"));
        if (hz && *hz >= limits::minMeasuredHz && *hz <= limits::maxFrequencyHz) return *hz;
        return Failure{table_.cellError(row, *table_.column("frequency_hz"),
                                        "a number from " + plainNumber(limits::minMeasuredHz) + " to " +
                                            plainNumber(limits::maxFrequencyHz))};
    }

private:
    std::filesystem::path folder_;
    CsvTable table_;
};

/// Root mean square of each channel without its mean; or one error line with the file's name. Message thread.
Result<std::vector<double>> axisLevels(const std::string& path);

/// Complex amplitude of each channel of the row's recording at that frequency; or one error line, also if the
/// frequency is not below half the recording's sample rate. Message thread.
Result<std::vector<std::complex<double>>> channelTones(const RecordingList& list, const CsvRow& row,
                                                       double frequencyHz);

/// Parses what --band has: LO-HI in Hz, 0 < LO < HI; or one error line. Any thread.
inline Result<FrequencyBand> parseBand(std::string_view text) {
    const std::size_t dash = std::min(text.find('-'), text.size());
    const auto low = parseNumber<double>(text.substr(0, dash)),
               high = parseNumber<double>(text.substr(std::min(dash + 1, text.size())));
    if (low && high && FrequencyBand{*low, *high}.isKnown()) return FrequencyBand{*low, *high};
    return Failure{"--band: expected LO-HI in Hz like 90-1000, found " + inQuotes(text)};
}

} // namespace physvib
