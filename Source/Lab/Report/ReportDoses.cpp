// SPDX-License-Identifier: MIT
// Report section on levels and exposure, from the columns level_db, peak_g, rms_g and a8_m_per_s2.
#include "Io/Text/CsvText.h"
#include "Io/Text/NameList.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/LevelChain.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <map>
#include <tuple>

namespace physvib {
namespace {

/// Numbers of a cell such as "0.5|0.3", which has two parts.
std::vector<double> numbersOf(std::string_view cell) {
    std::vector<double> numbers;
    while (!cell.empty())
        if (const auto number = parseNumber<double>(takeUntil('|', cell))) numbers.push_back(*number);
    return numbers;
}

/// A sentence on a column of the table of tellDoses(), followed by a space.
std::string meaningOf(std::string_view column, const std::vector<std::string>& moved) {
    if (column == "level_db")
        return "level_db: in dB of " +
               (moved.empty() ? "the condition's own level, or of a call's full scale"
                              : listed(moved) + " at 0 dB (a ratio: 20 dB is 10 times as much)") +
               "; where participants set a level, that at the start. ";
    if (column == trialColumns::peakG)
        return "peak_g: the peak of the signal that left for the strongest actuator, of each part of a "
               "trial, "
               "times the full scale that its layout states, in g. ";
    if (column == trialColumns::rmsG) return "rms_g: its root mean square, likewise. ";
    if (column == trialColumns::exposure)
        return "a8_m_per_s2: the participant's exposure up to there, A(8) by ISO 5349-1. ";
    return {};
}

/// How the columns in g come about.
std::string chainOf(const ReportTrials& trials) {
    if (trials.protocol) return levelChain(*trials.protocol, "as they left (measured)");
    return "Levels in g are samples as they left (measured), times a full scale that is assumed, as the "
           "layouts are "
           "not known here: no accelerometer measured them.";
}

/// Table of the levels of every part of every stimulus, where they are in the rows.
void tellStimuli(ReportBuilder& report) {
    using Key = std::tuple<std::string, std::string, std::string, std::string, std::string_view>;
    const Cells cell{report.trials.all};
    std::map<Key, std::vector<double>> values;
    for (const CsvRow& row : report.trials.all.rows)
        for (const std::string_view column : {trialColumns::peakG, trialColumns::rmsG}) {
            std::string_view parts = cell(row, "parts");
            for (const double value : numbersOf(cell(row, column)))
                values[{cell(row, "condition"), cell(row, "session"), cell(row, "stimulus"),
                        std::string{takeUntil('|', parts)}, column}]
                    .push_back(value);
        }
    if (values.empty()) return;
    ExportTable table{"levels-by-stimulus", report.isSimulated(),
                      "condition,session,stimulus,part,measure,values,least,mean,most"};
    for (const auto& [key, own] : values) {
        const auto& [condition, session, stimulus, part, measure] = key;
        table.row(condition, session, stimulus, part, measure, own.size(), *std::ranges::min_element(own),
                  Moments(own).mean, *std::ranges::max_element(own));
    }
    report.addTable("levels-by-stimulus.csv", table.text());
    report.page.table(table.text(), "levels-by-stimulus.csv", 200, true);
}

} // namespace

void tellDoses(ReportBuilder& report) {
    if (!report.trials.knowTasks()) return; // units of other programs are unknown
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    ExportTable table{"levels-and-exposure", report.isSimulated(),
                      "condition,session,measure,values,least,mean,most"};
    std::string meanings;
    const auto moved =
        report.trials.protocol ? movedBesideStrength(*report.trials.protocol) : std::vector<std::string>{};
    for (const std::string& column : all.columns) {
        if (column != "level_db" && !trialColumns::isMeasured(column)) continue;
        std::map<std::pair<std::string, std::string>, std::vector<double>> values;
        for (const CsvRow& row : all.rows)
            for (const double value : numbersOf(cell(row, column)))
                values[{cell(row, "condition"), cell(row, "session")}].push_back(value);
        if (column == "level_db" && std::ranges::all_of(values, [](const auto& v) {
                return std::ranges::all_of(v.second, [](double db) { return db == 0.0; });
            }))
            continue;
        if (!values.empty()) meanings += meaningOf(column, moved);
        for (const auto& [key, own] : values) {
            double sum = 0.0;
            for (const double value : own) sum += value;
            // means of adaptive levels and accumulated exposure have no meaning
            const bool hasMean = column == trialColumns::peakG || column == trialColumns::rmsG;
            table.row(key.first, key.second, column, own.size(), *std::ranges::min_element(own),
                      hasMean ? std::optional{sum / static_cast<double>(own.size())} : std::nullopt,
                      *std::ranges::max_element(own));
        }
    }
    report.page.subheading("Levels and exposure");
    if (meanings.empty())
        return report.page.paragraph("Every trial had the level of its call; nobody measured what was felt.");
    report.addTable("levels-and-exposure.csv", table.text());
    if (meanings.find(trialColumns::peakG) != std::string::npos) meanings += chainOf(report.trials) + " ";
    report.page.paragraph(meanings.substr(0, meanings.size() - 1));
    report.page.table(table.text(), "levels-and-exposure.csv");
    tellStimuli(report);
    if (meanings.find(trialColumns::exposure) == std::string::npos)
        report.page.note("exposure was not measured in these trials");
}

} // namespace physvib
