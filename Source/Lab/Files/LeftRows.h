// SPDX-License-Identifier: MIT
// Tells which rows of a table are of trials that did not leave as planned, and so are evidence of nothing.
#pragma once
#include "Core/Limits.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialColumns.h"
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// By the column `left`. Of rows without it, by a part whose peak is 0 though a device was open and its call
/// does not ask for silence. Any thread; the table outlives it.
class LeftRows {
public:
    explicit LeftRows(const CsvTable& table)
        : left_{table.column(trialColumns::left)}
        , peaks_{table.column(trialColumns::peakG)}
        , device_{table.column(trialColumns::device)}
        , calls_{table.column(trialColumns::render)} {}

    bool didNotLeave(const CsvRow& row) const {
        if (left_ && !row.cells[*left_].empty()) return row.cells[*left_] == "0";
        if (!peaks_ || !device_ || row.cells[*device_].empty() || row.cells[*device_].starts_with("None:"))
            return false;
        std::string_view peaks = row.cells[*peaks_], calls = calls_ ? row.cells[*calls_] : std::string_view{};
        while (!peaks.empty()) {
            const std::string_view peak = takeUntil('|', peaks), call = calls.substr(0, calls.find(" ; "));
            calls.remove_prefix(std::min(call.size() + 3, calls.size()));
            if (parseNumber<double>(peak) == 0.0 && !asksForSilence(call)) return true;
        }
        return false;
    }

private:
    static bool asksForSilence(std::string_view call) {
        constexpr std::string_view option = "--level-db ";
        const auto at = call.find(option);
        if (at == std::string_view::npos) return false;
        std::string_view rest = call.substr(at + option.size());
        return parseNumber<double>(takeUntil(' ', rest)).value_or(0.0) <= -limits::maxLevelDb;
    }
    std::optional<std::size_t> left_, peaks_, device_, calls_;
};

/// "3 trials did not leave as planned and are left out". Any thread.
inline std::string notLeftWords(std::size_t trials) {
    return counted(trials, "trial") + " did not leave as planned (column left, or a peak of 0 g) and " +
           (trials == 1 ? "is" : "are") + " left out";
}

} // namespace physvib
