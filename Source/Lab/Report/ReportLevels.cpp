// SPDX-License-Identifier: MIT
// Report section on levels: thresholds with psychometric functions, adjusted levels, and magnitude estimates.
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace physvib {
namespace {

/// A staircase has no model of answers: the logistic with its guess rate.
PsychometricModel modelOf(const ReportTrials& trials) {
    PsychometricModel model;
    model.guess = trials.guess;
    if (!trials.protocol) return model;
    const auto& sessions = trials.protocol->sessions;
    if (const auto adaptive = std::ranges::find_if(sessions, &SessionPlan::adaptedAlternative);
        adaptive != sessions.end())
        model.guess = adaptive->guessRate();
    return model;
}

/// The table of trials, without those of staircases and QUEST+ that did not come to their end.
StudyFiles finishedTrials(const ReportBuilder& report) {
    std::set<std::array<std::string, 3>> unfinished;
    for (const UnfinishedRun& run : unfinishedRuns(report.trials))
        if (run.isAdaptive) unfinished.insert({run.participant, run.condition, run.session});
    const std::string& whole = report.tableText(trialsTable);
    if (unfinished.empty()) return {{trialsTable, whole}};
    ReportTrials kept = report.trials;
    const Cells cell{report.trials.all};
    std::erase_if(kept.all.rows, [&](const CsvRow& row) {
        return unfinished.contains({cell(row, "participant"), cell(row, "condition"), cell(row, "session")});
    });
    return {{trialsTable, trialsCsv(kept, whole.substr(0, whole.find('\n') + 1))}};
}

/// Of QUEST+ alone, `quest` has its thresholds: a second fit would only differ from them.
void tellThresholds(ReportBuilder& report, const StudyFiles& tables,
                    const std::vector<LevelSummary>& quest = {}) {
    report.page.subheading("Psychometric functions");
    AnalysisJob fit = report.optionsFor(trialsTable);
    fit.made = &tables;
    fit.model = modelOf(report.trials);
    const bool isFitted =
        !quest.empty() || report.analysis("psychometric", fit, "psychometric.csv").error.empty();
    const NamedText file{tables.at(trialsTable), trialsTable};
    const auto data = readLevelAnswers({&file, 1}, {"level_db", "correct", false});
    if (!data) return report.page.note(data.error);
    tellFunctions(report, data.value, fit.model, fitWords(report.trials.columns), isFitted, quest);
}

void tellMagnitudes(ReportBuilder& report) {
    report.page.subheading("Magnitudes");
    const NamedText file{report.tableText(trialsTable), trialsTable};
    const auto data = readLevelAnswers({&file, 1}, {"stimulus", "value", true});
    if (!data) return report.page.note("stimuli are no levels, so there is no power law: " + data.error);
    const auto words = report.analysis("power-law", report.optionsFor(trialsTable), "power-law.csv");
    if (!words.error.empty()) return;
    std::vector<std::string> charts;
    for (const auto& condition : data.value.conditions)
        charts.push_back(powerLawChart(report.frame(condition.name.empty() ? "Magnitudes" : condition.name),
                                       condition.trials, "level"));
    report.page.figure(charts, "Magnitude estimations: geometric means" + report.intervals() +
                                   ", and the mean power law, both axes logarithmic. Each participant's "
                                   "numbers are divided by their own geometric mean first.");
}

std::string matchesChart(ReportBuilder& report, const std::vector<LevelSummary>& summaries) {
    std::vector<LevelSummary> matches = summaries;
    std::erase_if(matches, [](const auto& s) { return s.kind != LevelTrial::Kind::adjustment; });
    if (matches.size() < 2) return {};
    const bool isOne = std::ranges::count(matches, matches.front().condition, &LevelSummary::condition) ==
                       std::ssize(matches);
    std::vector<std::pair<std::string, ChartValue>> bars;
    for (const LevelSummary& s : matches)
        bars.emplace_back(isOne ? s.stimulus : s.condition + ", " + s.stimulus,
                          ChartValue::around(s.estimate, s.halfInterval));
    return barsChart(report.frame("Matched levels"), isOne ? "stimulus" : "condition, stimulus", "level (dB)",
                     bars);
}

/// Warns about adjustments at the end of their range, which may have been limited by it.
void tellEndsOfRanges(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    if (!report.trials.protocol) return;
    for (const SessionPlan& plan : report.trials.protocol->sessions) {
        std::size_t trials = 0, atEnd = 0;
        for (const CsvRow& row : report.trials.all.rows) {
            if (!plan.adjustment || cell(row, "session") != plan.name) continue;
            const auto db = parseNumber<double>(cell(row, "value"));
            ++trials;
            atEnd += db && (*db <= plan.adjustment->leastDb || *db >= plan.adjustment->mostDb);
        }
        if (atEnd == 0) continue;
        report.page.note(std::to_string(atEnd) + " of " + std::to_string(trials) + " levels of the session " +
                         plan.name + " were set to an end of their range, " +
                         numberText(plan.adjustment->leastDb) + " to " + numberText(plan.adjustment->mostDb) +
                         " dB: the match may lie beyond it");
    }
}

} // namespace

void tellFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, const PsychometricModel& model,
                   const FitWords& words, bool isFitted, const std::vector<LevelSummary>& quest) {
    std::vector<std::string> charts;
    for (const auto& condition : data.conditions)
        if (const auto* const told = conditionNamed(quest, condition.name); told || quest.empty())
            charts.push_back(psychometricChart(
                report.frame(condition.name.empty() ? "Psychometric functions" : condition.name),
                condition.trials, model, words, told));
    std::string caption = "Share of answers \u201c" + words.answer + "\u201d by " + words.level +
                          ". Circles: all participants' trials, larger where there were more";
    if (!isFitted) return report.page.figure(charts, caption + ".");
    const bool isAdaptive = data.conditions.front().trials.front().isAdaptive;
    caption += isAdaptive ? "; no functions are drawn, as answers chose the levels. "
                          : "; thin lines: the function of each participant who has one; thick: the mean of "
                            "the thresholds and that of the widths that there are. ";
    caption += report.people() > 1 ? "Dotted: mean threshold, shaded its 95 % interval over participants. "
                                   : "Dotted: threshold. ";
    if (!quest.empty()) return report.page.figure(charts, caption + "It is that of QUEST+ (levels.csv).");
    if (isAdaptive)
        caption += "Thresholds are where the function is half way between guessing and certainty, which need "
                   "not be where the method ends (levels.csv); the functions are ";
    else
        caption += "The functions are ";
    report.page.figure(
        charts,
        caption + std::string(psychometricShapeNames[static_cast<std::size_t>(model.shape)]) + ", with " +
            (model.guess > 0.0
                 ? "a guess rate of " + numberText(std::round(1000.0 * model.guess) / 10.0) + " % and "
                 : "") +
            "lapse rates of up to " + numberText(100.0 * model.mostLapses()) +
            (model.guess > 0.0 ? " %." : " % at both ends, the same at each."));
}

void tellLevels(ReportBuilder& report) {
    report.page.heading("Levels");
    const StudyFiles tables = finishedTrials(report);
    if (!report.trials.knowTasks() && !report.trials.all.column("value")) {
        report.page.note("the tables do not say how levels were chosen: functions are fitted to the answers, "
                         "reversals are not looked for");
        return tellThresholds(report, tables);
    }
    const NamedText file{tables.at(trialsTable), trialsTable};
    const auto data = readLevels({&file, 1});
    if (!data) return report.page.note(data.error);
    const auto& trials = data.value.conditions.front().trials;
    const auto has = [&](LevelTrial::Kind kind) {
        return std::ranges::any_of(trials, [=](const LevelTrial& trial) { return trial.kind == kind; });
    };
    AnalysisJob options = report.optionsFor(trialsTable);
    options.made = &tables;
    const auto words = report.analysis("levels", options, "levels.csv");
    if (!words.error.empty()) return;
    auto summaries = summariseLevels(trials);
    if (has(LevelTrial::Kind::staircase) || has(LevelTrial::Kind::quest))
        report.addTable("thresholds.csv", words.participants);
    tellEndsOfRanges(report);
    if (const std::string chart = matchesChart(report, summaries); !chart.empty())
        report.page.figure({chart}, "Levels that were set by adjustment: means" + report.intervals() + ".");
    if (has(LevelTrial::Kind::staircase) && has(LevelTrial::Kind::quest))
        report.page.paragraph("Functions are of the staircases' trials: QUEST+ has thresholds of its own.");
    if (has(LevelTrial::Kind::staircase))
        tellThresholds(report, tables);
    else if (std::erase_if(
                 summaries,
                 [](const auto& s) { return s.kind != LevelTrial::Kind::quest || s.thresholds.empty(); });
             !summaries.empty())
        tellThresholds(report, tables, summaries);
    if (has(LevelTrial::Kind::magnitude)) tellMagnitudes(report);
}

} // namespace physvib
