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

/// Where runs of right answers and the sizes of steps up and down balance (Levitt 1971; Kaernbach 1991).
std::string converging(const ReportTrials& trials) {
    std::set<std::string> shares;
    if (trials.protocol)
        for (const SessionPlan& session : trials.protocol->sessions)
            if (const auto& rule = session.staircase; rule && !session.isTraining)
                shares.insert(numberText(
                    std::round(1000.0 * std::pow(rule->upRatio / (1.0 + rule->upRatio), 1.0 / rule->down)) /
                    10.0));
    return shares.empty() ? "." : "; converges to " + joined(shares, " or ") + " % correct.";
}

/// The answers by level, and the threshold that the method found.
void tellThresholds(ReportBuilder& report, const std::vector<LevelTrial>& trials,
                    const std::vector<LevelSummary>& summaries) {
    std::vector<std::string> charts;
    PsychometricModel model;
    model.guess = guessOf(report.trials);
    for (const LevelSummary& s : summaries) {
        if (s.thresholds.empty()) continue;
        std::vector<LevelAnswer> own;
        for (const LevelTrial& t : trials)
            if (t.kind == s.kind && t.condition == s.condition)
                own.push_back({t.participant, t.levelDb, t.value});
        charts.push_back(psychometricChart(
            report.frame(s.condition + (s.kind == LevelTrial::Kind::quest ? " by QUEST+" : " by staircase") +
                         ", n = " + std::to_string(s.thresholds.size())),
            own, model, FitWords{}, &s));
    }
    const auto isOf = [&](LevelTrial::Kind kind) {
        return std::ranges::count(summaries, kind, &LevelSummary::kind) > 0;
    };
    if (!charts.empty())
        report.page.figure(
            charts,
            std::string{"Share of correct answers by level, of all trials that are analysed, also of who has "
                        "no threshold. Circles: "
                        "larger of more trials. Dotted: mean threshold of the n participants who have one."} +
                (isOf(LevelTrial::Kind::staircase) ? " Threshold of a staircase: mean of the later half of "
                                                     "the reversals that a trial follows (of 7 the last 4)" +
                                                         converging(report.trials)
                                                   : "") +
                (isOf(LevelTrial::Kind::quest)
                     ? " Threshold by QUEST+: mean of its posterior, widths of all participants together."
                     : ""));
}

void tellMagnitudes(ReportBuilder& report, const std::vector<LevelSummary>& summaries) {
    report.page.subheading("Power law");
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"stimulus", "value", true});
    if (!data) return report.tellFault(data.error);
    if (!report.analysis("power-law", report.options(), "power-law.csv").error.empty()) return;
    std::vector<std::string> charts;
    std::vector<std::size_t> people;
    for (const LevelSummary& one : summaries)
        if (one.kind == LevelTrial::Kind::magnitude) people.push_back(one.participants);
    for (const auto& condition : data.value.conditions)
        charts.push_back(powerLawChart(report.frame(condition.name.empty() ? "Magnitudes" : condition.name),
                                       condition.trials, "stimulus"));
    report.page.figure(charts,
                       "Geometric mean magnitudes, each divided by its participant's geometric mean in "
                       "the condition, and mean power law" +
                           ofPeople(people) + ". Both axes are logarithmic.");
}

/// Adjustments at an end of their range.
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
        if (atEnd > 0)
            report.page.note(std::to_string(atEnd) + " of " + std::to_string(trials) + " levels of " +
                             plan.name + " were set to an end of their range");
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
    if (isFitted) report.page.table(report.tableText(name), name, 200, true);
    const FitWords words = fitWords(report.trials.columns, fit.level, fit.measure);
    const PsychometricModel& model = fit.model;
    report.half = words.half(model), report.slope = words.slope(model);
    report.functions =
        std::string(psychometricShapeNames[static_cast<std::size_t>(model.shape)]) +
        (model.guess > 0.0 ? ", guess rate " + numberText(std::round(1000.0 * model.guess) / 10.0) + " %"
                           : "") +
        ", lapse rate up to " + numberText(100.0 * model.mostLapses()) + " %" +
        (model.guess > 0.0
             ? "; " + report.half + ": " + numberText(std::round(1000.0 * (0.5 + 0.5 * model.guess)) / 10.0) +
                   " %, apart from lapses"
             : " at both ends");
    std::vector<std::string> charts;
    for (const auto& condition : data.conditions)
        charts.push_back(psychometricChart(
            report.frame(condition.name.empty() ? "Psychometric functions" : condition.name),
            condition.trials, model, words));
    report.page.figure(
        charts,
        "Share of answers \u201c" + words.answer + "\u201d by " + words.level +
            ". Circles: " + (isFitted ? "trials of who has a function" : "all trials") + ", larger of more." +
            (isFitted
                 ? " Thin lines: participants' functions, " + report.functions + ". Thick: mean " +
                       report.half + ", and mean width of who has one (a step has none). Dotted: mean " +
                       report.half +
                       ". Column jnd: half of what lies between 0.25 and 0.75 of the shape, without lapses" +
                       (model.guess > 0.0 ? ": a slope; no difference threshold of forced choices."
                                          : ": JND.")
                 : ""));
}

void tellLevels(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    if (!report.trials.knowTasks() && !report.trials.all.column("value")) {
        report.page.heading("Answers by level");
        return tellFits(report);
    }
    const AnalysisJob options = report.options();
    const auto data = readFinishedLevels(options);
    using Kind = LevelTrial::Kind;
    const auto has = [&](Kind kind) {
        return data && std::ranges::any_of(data.value.conditions.front().trials,
                                           [=](const LevelTrial& trial) { return trial.kind == kind; });
    };
    if (!data && !report.trials.knowTasks()) { // of other programs: numbers, which analysis.R compares
        report.page.heading("Values");
        return report.page.note("no power law: " + data.error);
    }
    const bool hasThresholds = has(Kind::staircase) || has(Kind::quest);
    std::vector<std::string> kinds;
    if (hasThresholds || !data) kinds.emplace_back("Thresholds");
    if (has(Kind::adjustment)) kinds.emplace_back("Levels that were set");
    if (has(Kind::magnitude)) kinds.emplace_back("Magnitudes");
    report.page.heading(joined(kinds, ", "));
    if (!data) return report.tellFault(data.error);
    const auto& trials = data.value.conditions.front().trials;
    const auto words = report.analysis("levels", options, "levels.csv");
    if (!words.error.empty()) return;
    const auto summaries = summariseLevels(trials);
    if (hasThresholds) report.addTable("thresholds.csv", words.participants);
    tellEndsOfRanges(report);
    if (std::ranges::count(summaries, LevelTrial::Kind::adjustment, &LevelSummary::kind) > 1) {
        const auto reference = comparedLevel(report.trials);
        std::vector<std::size_t> people;
        bool hasIntervals = false; // of one participant there is none
        for (const LevelSummary& one : summaries)
            if (one.kind == Kind::adjustment)
                people.push_back(one.participants), hasIntervals |= one.halfInterval > 0.0;
        report.page.figure(
            {levelChart(report.frame("Matched levels"), summaries, LevelTrial::Kind::adjustment, reference)},
            "Mean level that was set" + ofPeople(people) +
                (reference ? ". Dashed: level of " + reference->second : std::string{}) +
                lastOfCaption(hasIntervals));
    }
    tellThresholds(report, report.read(readLevels).value.conditions.front().trials, summaries);
    if (has(LevelTrial::Kind::magnitude) && report.trials.all.column("stimulus"))
        tellMagnitudes(report, summaries);
}

} // namespace physvib
