// SPDX-License-Identifier: MIT
// Report sections on levels (thresholds, adjustments, magnitudes), choices, ratings, and answers in words.
#include "Io/Text/CsvText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/StudyTasks.h"
#include <array>
#include <cmath>
#include <set>

namespace physvib {
namespace {

/// Guess rate of the protocol's adaptive session, else that of the report.
double guessOf(const ReportTrials& trials) {
    const auto adaptive = std::ranges::find_if(trials.sessions(), &SessionPlan::adaptedAlternative);
    return adaptive != trials.sessions().end() ? adaptive->guessRate() : trials.guess;
}

/// Fits for tables that do not say how levels were chosen.
void tellFits(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.model.guess = report.trials.guess;
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"level_db", "correct", false});
    if (!data) return report.tellFault(data.error);
    tellFunctions(report, data.value, fit, "psychometric.csv");
}

/// Percent correct to which the protocol's staircases converge (Levitt 1971; Kaernbach 1991).
std::string converging(const ReportTrials& trials) {
    std::set<std::string> shares;
    for (const SessionPlan& session : trials.sessions())
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
    for (const SessionPlan& plan : report.trials.sessions()) {
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

/// Level and name of the alternative that all adjustments are compared with, if they agree.
std::optional<std::pair<double, std::string>> comparedLevel(const ReportTrials& trials) {
    std::set<std::pair<double, std::string>> all;
    for (const SessionPlan& plan : trials.sessions())
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

// Report sections on forced choices and ratings.

namespace {

constexpr std::size_t mostShown = 24; // bars side by side

/// Whether so many bars fit; of more the table alone tells.
bool hasRoom(const auto& summaries) { return summaries.size() <= mostShown; }

void tellShares(ReportBuilder& report, const StudyCondition<ChoiceTrial>& session) {
    const auto summaries = summariseChoices(session.trials);
    const std::string title = inSession("Mean share of each alternative", session.name);
    std::vector<std::size_t> people;
    for (const ChoiceSummary& one : summaries)
        for (const ChoiceShare& share : one.shares) people.push_back(share.participants);
    if (hasRoom(summaries))
        report.page.figure({sharesChart(report.frame(title), summaries)}, title + ofPeople(people) + ".");
}

void tellScores(ReportBuilder& report, const RatingData& data, const StudyCondition<RatingTrial>& session) {
    const auto summaries = withoutIntervalsOfPoints(summariseRatings(session.trials), report.options(), data);
    std::set<int> all; // points of the scales of this session, or of all where they are not parted
    for (const SessionPlan& plan : report.trials.sessions())
        if (plan.answer() == AnswerKind::scores && !plan.isTraining &&
            (session.name.empty() || session.name == plan.name))
            all.insert(plan.points);
    const std::string title = inSession("Mean score of each scale", session.name);
    std::vector<std::size_t> people;
    for (const RatingSummary& one : summaries)
        for (const std::size_t raters : one.raters)
            if (raters > 0) people.push_back(raters);
    const bool hasIntervals = std::ranges::any_of(summaries, [](const RatingSummary& one) {
        return std::ranges::any_of(one.halfIntervals, [](double half) { return half > 0.0; });
    });
    if (hasRoom(summaries))
        report.page.figure(
            {scoresChart(report.frame(title), data.scales, summaries, all.size() == 1 ? *all.begin() : 0)},
            title + ofPeople(people) + lastOfCaption(hasIntervals));
}

/// Psychometric functions over the stimuli, where these are numbers and an alternative is right.
void tellConstantStimuli(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.level = "stimulus";
    for (const SessionPlan& session : report.trials.sessions()) {
        if (session.isTraining) continue;
        if (!session.correct.empty()) fit.model.guess = session.guessRate();
        if (session.answers.size() == 2) // of one interval: half way is subjective equality
            fit.model.guess = 0.0, fit.measure = "choice=" + session.answers.back();
    }
    const auto data =
        report.read(readLevelAnswers,
                    LevelAnswerColumns{"stimulus", fit.measure.empty() ? "correct" : fit.measure, false});
    const auto hasLevels = [](const auto& one) { // two are a factor's
        return countByLevel(one.trials, [](const LevelAnswer& trial) { return trial.counted(); }).size() > 2;
    };
    if (!data || !report.trials.knowTasks() || std::ranges::none_of(data.value.conditions, hasLevels)) return;
    tellFunctions(report, data.value, fit, "psychometric-stimuli.csv");
}

} // namespace

void tellChoices(ReportBuilder& report) {
    report.page.heading("Choices");
    const auto data = report.read(readChoices);
    if (!data) return report.tellFault(data.error);
    if (const auto words = report.analysis("choices", report.options(), "choices.csv"); !words.error.empty())
        return;
    tellConstantStimuli(report);
    for (const auto& session : data.value.conditions) tellShares(report, session);
}

void tellRatings(ReportBuilder& report) {
    report.page.heading("Ratings");
    const auto data = report.read(readRatings);
    if (!data) return report.tellFault(data.error);
    if (const auto words = report.analysis("ratings", report.options(), "ratings.csv"); !words.error.empty())
        return;
    report.scales = data.value.scales;
    for (const auto& session : data.value.conditions) tellScores(report, data.value, session);
}

// Report section on answers in words.

bool tellDescriptions(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    std::map<std::array<std::string, 4>, std::size_t> counts; // condition, session, stimulus, words
    for (const CsvRow& row : report.trials.all.rows) {
        if (answerOf(cell(row, trialColumns::task)) != AnswerKind::words ||
            cell(row, trialColumns::phase) == trialColumns::training ||
            cell(row, trialColumns::ranOut) == "1")
            continue;
        ++counts[{cell(row, "condition"), cell(row, "session"), cell(row, "stimulus"),
                  cell(row, "response")}];
    }
    if (counts.empty()) return false;
    ExportTable table{"descriptions", report.isSimulated(), "condition,session,stimulus,response,trials"};
    for (const auto& [key, trials] : counts) table.row(key[0], key[1], key[2], key[3], trials);
    report.page.heading("Answers in words");
    report.show("descriptions.csv", table);
    return true;
}

} // namespace physvib
