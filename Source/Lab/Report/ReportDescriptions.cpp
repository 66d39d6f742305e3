// SPDX-License-Identifier: MIT
// Report section on answers in words, from the columns task, phase, condition, session, stimulus and
// response.
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Study/StudyTasks.h"
#include <array>

namespace physvib {

bool tellDescriptions(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    std::map<std::array<std::string, 4>, std::size_t> counts; // condition, session, stimulus, words
    std::size_t all = 0, empty = 0;
    for (const CsvRow& row : report.trials.all.rows) {
        if (answerOf(cell(row, trialColumns::task)) != AnswerKind::words ||
            cell(row, trialColumns::phase) == trialColumns::training)
            continue;
        ++all;
        empty += cell(row, "response").empty();
        ++counts[{cell(row, "condition"), cell(row, "session"), cell(row, "stimulus"),
                  cell(row, "response")}];
    }
    if (all == 0) return false;
    ExportTable table{"descriptions", report.isSimulated(), "condition,session,stimulus,response,trials"};
    for (const auto& [key, trials] : counts) table.row(key[0], key[1], key[2], key[3], trials);
    report.addTable("descriptions.csv", table.text());
    report.page.heading("Answers in words");
    report.page.paragraph(counted(all, "answer") + " in participants' own words" +
                          (empty > 0 ? ", " + std::to_string(empty) + " of them empty" : std::string{}) +
                          ": counted by stimulus, not analysed.");
    report.page.table(report.tableText("descriptions.csv"), "descriptions.csv");
    return true;
}

} // namespace physvib
