// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of recordings with a table of their conditions.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
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
                                      const std::vector<std::string>& required);

    const std::vector<CsvRow>& rows() const noexcept { return table_.rows; }
    const CsvTable& table() const noexcept { return table_; }
    std::string path(const CsvRow& row) const { return (folder_ / cell(row, "file")).string(); }
    /// Empty if there is no such column.
    std::string cell(const CsvRow& row, std::string_view column) const;
    Result<double> frequencyHz(const CsvRow& row) const;

private:
    std::filesystem::path folder_;
    CsvTable table_;
};

} // namespace physvib
