// SPDX-License-Identifier: MIT
// Report section on levels: thresholds with psychometric functions, adjusted levels, and magnitude estimates.
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/StudyTasks.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace physvib {
namespace {

/// Two alternatives, unless the protocol has more.
double guessOf(const ReportTrials& trials) {
    if (!trials.protocol) return trials.guess;
    const auto& sessions = trials.protocol->sessions;
    const auto adaptive = std::ranges::find_if(sessions, &SessionPlan::adaptedAlternative);
    return adaptive != sessions.end() ? adaptive->guessRate() : trials.guess;
}

/// Of tables that do not say how levels were chosen.
void tellFits(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.model.guess = report.trials.guess;
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"level_db", "correct", false});
    if (!data) return report.tellFault(data.error);
    tellFunctions(report, data.value, fit, "psychometric.csv");
}

/// The answers by level, and the threshold that the method found.
void tellThresholds(ReportBuilder& report, const std::vector<LevelTrial>& trials,
                    const std::vector<LevelSummary>& summaries) {
    std::vector<std::string> charts;
    std::string without;
    PsychometricModel model;
    model.guess = guessOf(report.trials);
    bool isOfMany = false;
    for (const LevelSummary& s : summaries) {
        if (s.thresholds.empty()) continue;
        std::vector<LevelAnswer> own;
        for (const LevelTrial& t : trials)
            if (t.kind == s.kind && t.condition == s.condition)
                own.push_back({t.participant, t.levelDb, t.value});
        charts.push_back(psychometricChart(
            report.frame(s.condition + (s.kind == LevelTrial::Kind::quest ? " by QUEST+" : " by staircase")),
            own, model, FitWords{}, &s));
        isOfMany |= s.participants > 1;
        for (const auto& [who, answers] : byParticipant(own))
            if (std::ranges::find(s.thresholds, who, &std::pair<std::string, double>::first) ==
                s.thresholds.end())
                without += (without.empty() ? "" : ", ") + inSession(who, s.condition);
    }
    if (charts.empty()) return;
    report.page.subheading("Answers by level");
    report.page.figure(
        charts, std::string{"Share of answers \u201ccorrect\u201d by level (dB). Circles: "} +
                    (report.people() > 1 ? "all participants' " : "") +
                    "trials, larger where there were more. Dotted: " +
                    (isOfMany ? "mean threshold, shaded its 95 % interval over participants" : "threshold") +
                    (without.empty() ? "" : ", without " + without) + " (levels.csv).");
}

void tellMagnitudes(ReportBuilder& report) {
    report.page.subheading("Power law");
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"stimulus", "value", true});
    if (!data) return report.page.note("no power law is fitted: " + report.said(data.error));
    const auto words = report.analysis("power-law", report.options(), "power-law.csv");
    if (!words.error.empty()) return;
    std::vector<std::string> charts;
    for (const auto& condition : data.value.conditions)
        charts.push_back(powerLawChart(report.frame(condition.name.empty() ? "Magnitudes" : condition.name),
                                       condition.trials, "level"));
    report.page.figure(charts, "Magnitude estimations: geometric means" + report.intervals() +
                                   ", and the mean power law, both axes logarithmic. Each participant's "
                                   "numbers are divided by their own geometric mean in that condition first" +
                                   (charts.size() > 1 ? ": conditions cannot be compared here." : "."));
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

/// What all adjustments are compared with, where that has one name and one level.
std::optional<std::pair<double, std::string>> comparedLevel(const ReportTrials& trials) {
    std::set<std::pair<double, std::string>> all;
    if (trials.protocol)
        for (const SessionPlan& plan : trials.protocol->sessions)
            for (const Alternative& one : plan.alternatives)
                if (plan.adjustment && one.name != plan.adjustment->alternative)
                    all.emplace(one.levelDb, one.name);
    return all.size() == 1 ? std::optional{*all.begin()} : std::nullopt;
}

} // namespace

void tellFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, AnalysisJob fit,
                   const std::string& name) {
    fit.columns = report.trials.columns; // whose words it uses
    report.page.subheading("Psychometric functions");
    const bool isFitted = report.analysis("psychometric", fit, name).error.empty();
    const FitWords words = fitWords(report.trials.columns, fit.level, fit.measure);
    const PsychometricModel& model = fit.model;
    const std::string half = report.half = words.half(model);
    report.functions =
        std::string(psychometricShapeNames[static_cast<std::size_t>(model.shape)]) + ", with " +
        (model.guess > 0.0
             ? "a guess rate of " + numberText(std::round(1000.0 * model.guess) / 10.0) + " % and "
             : "") +
        "lapse rates of up to " + numberText(100.0 * model.mostLapses()) +
        (model.guess > 0.0 ? " %" : " % at both ends, the same at each");
    std::vector<std::string> charts;
    std::string without;
    for (const auto& condition : data.conditions) {
        std::vector<std::string> leftOut;
        charts.push_back(psychometricChart(
            report.frame(condition.name.empty() ? "Psychometric functions" : condition.name),
            condition.trials, model, words, nullptr, &leftOut));
        if (!leftOut.empty())
            without += (without.empty() ? "" : "; ") + inSession(joined(leftOut, ", "), condition.name);
    }
    const std::string caption =
        "Share of answers \u201c" + words.answer + "\u201d by " + words.level +
        ". Circles: " + (report.people() > 1 && without.empty() ? "all participants' trials" : "trials") +
        (without.empty() ? "" : " of those who have a function, so not of " + without) +
        ", larger where there were more";
    if (!isFitted) return report.page.figure(charts, caption + ".");
    report.page.figure(
        charts,
        caption +
            (report.people() > 1
                 ? "; thin lines: the function of each participant who has one; thick: that of the mean " +
                       half + " and of the mean of the widths that there are. Dotted: mean " + half +
                       ", shaded its 95 % interval over participants where there are several. "
                 : "; line: the function. Dotted: " + half + ". ") +
            "The functions are " + report.functions +
            ". The JND is half of what lies between a quarter and three quarters.");
}

void tellLevels(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    const bool isOfNumbers = report.trials.knowTasks() && !hasAdaptiveRows(report.trials) &&
                             std::ranges::none_of(report.trials.all.rows, [&](const CsvRow& row) {
                                 return answerOf(cell(row, trialColumns::task)) == AnswerKind::level;
                             });
    report.page.heading(isOfNumbers ? "Magnitudes" : "Levels");
    if (!report.trials.knowTasks() && !report.trials.all.column("value")) {
        report.page.note("the tables do not say how levels were chosen: functions are fitted to the answers, "
                         "reversals are not looked for");
        return tellFits(report);
    }
    AnalysisJob options = report.options();
    options.protocol = report.trials.protocol;
    const auto data = readFinishedLevels(options);
    if (!data) return report.tellFault(data.error);
    const auto& trials = data.value.conditions.front().trials;
    const auto has = [&](LevelTrial::Kind kind) {
        return std::ranges::any_of(trials, [=](const LevelTrial& trial) { return trial.kind == kind; });
    };
    const auto words = report.analysis("levels", options, "levels.csv");
    if (!words.error.empty()) return;
    const auto summaries = summariseLevels(trials);
    if (has(LevelTrial::Kind::staircase) || has(LevelTrial::Kind::quest))
        report.addTable("thresholds.csv", words.participants);
    tellEndsOfRanges(report);
    if (std::ranges::count(summaries, LevelTrial::Kind::adjustment, &LevelSummary::kind) > 1) {
        const auto reference = comparedLevel(report.trials);
        report.page.figure(
            {levelChart(report.frame("Matched levels"), summaries, LevelTrial::Kind::adjustment, reference)},
            "Levels that were set by adjustment: means" + report.intervals() +
                (reference ? "; dashed: the level of " + reference->second : std::string{}) + ".");
    }
    tellThresholds(report, report.read(readLevels).value.conditions.front().trials, summaries);
    if (has(LevelTrial::Kind::magnitude) && report.trials.all.column("stimulus")) tellMagnitudes(report);
}

} // namespace physvib
