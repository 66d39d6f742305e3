// SPDX-License-Identifier: MIT
// Runs the analyses of a report.
#include "Lab/Report/ReportBuilder.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <set>

namespace physvib {
ReportBuilder::ReportBuilder(const ReportTrials& of, std::string title)
    : trials{of}
    , page{std::move(title), of.isSimulated} {}

std::size_t ReportBuilder::people() const {
    const Cells cell{trials.all};
    std::set<std::string_view> codes;
    for (const CsvRow& row : trials.all.rows) codes.insert(cell(row, "participant"));
    return std::max<std::size_t>(1, codes.size());
}

std::string ReportBuilder::said(const std::string& words) const {
    std::string_view rest = words;
    if (!rest.starts_with(std::string{trialsTable} + ":")) return words;
    rest.remove_prefix(std::string_view{trialsTable}.size() + 1);
    if (rest.starts_with(' ')) return std::string{rest.substr(1)};
    const auto line = parseNumber<std::size_t>(takeUntil(':', rest));
    const auto table = readCsvTable(tableText(trialsTable), trialsTable);
    const Cells cell{table.value};
    for (const CsvRow& row : table.value.rows)
        if (row.line == line) {
            std::string where;
            for (const char* column : {"participant", "condition", "session", "stimulus"})
                if (!cell(row, column).empty())
                    where.append(where.empty() ? "" : ", ")
                        .append(column)
                        .append(" ")
                        .append(cleanLine(cell(row, column)));
            return where + ":" + std::string{rest};
        }
    return words;
}

void ReportBuilder::warn(const std::vector<std::string>& warnings) {
    std::vector<std::string> fresh;
    const std::string counted = std::string{trialsTable} + ": left out: "; // left-out.csv has them
    for (const std::string& words : warnings)
        if (!words.starts_with(counted) && std::ranges::find(warned_, words) == warned_.end())
            fresh.push_back(said(words));
    warned_.insert(warned_.end(), warnings.begin(), warnings.end());
    page.notes(fresh);
}

AnalysisReport ReportBuilder::analysis(const std::string& kind, const AnalysisJob& options,
                                       const std::string& name) {
    AnalysisReport report = analyse(kind, options);
    warn(report.warnings);
    if (!report.error.empty()) {
        tellFault(report.error);
        return report;
    }
    page.table(report.summary, name);
    tables_[name] = report.table;
    return report;
}

} // namespace physvib
