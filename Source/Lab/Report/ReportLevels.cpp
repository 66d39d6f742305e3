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
double sessionGuessRate(const ReportTrials& trials) {
    const auto adaptive = std::ranges::find_if(trials.sessions(), &SessionPlan::adaptedAlternative);
    return adaptive != trials.sessions().end() ? adaptive->guessRate() : trials.guess;
}

/// Fits for tables that do not say how levels were chosen.
void addFits(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.model.guess = report.trials.guess;
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"level_db", "correct", false});
    if (!data) return report.noteFailedAnalysis(data.error);
    addPsychometricFunctions(report, data.value, fit, "psychometric.csv");
}

/// Percent correct to which the protocol's staircases converge (Levitt 1971; Kaernbach 1991).
std::string convergenceText(const ReportTrials& trials) {
    std::set<std::string> shares;
    for (const SessionPlan& session : trials.sessions())
        if (const auto& rule = session.staircase; rule && !session.isTraining)
            shares.insert(numberText(
                std::round(1000.0 * std::pow(rule->upRatio / (1.0 + rule->upRatio), 1.0 / rule->down)) /
                10.0));
    return shares.empty() ? "." : "; converges to " + joinNames(shares, " or ") + " % correct.";
}

/// The answers by level, and the threshold that the method found.
void addThresholds(ReportBuilder& report, const std::vector<LevelTrial>& trials,
                   const std::vector<LevelSummary>& summaries) {
    std::vector<std::string> charts;
    PsychometricModel model;
    model.guess = sessionGuessRate(report.trials);
    for (const LevelSummary& s : summaries) {
        if (s.thresholds.empty()) continue;
        std::vector<LevelAnswer> answers;
        for (const LevelTrial& t : trials)
            if (t.kind == s.kind && t.condition == s.condition)
                answers.push_back({t.participant, t.levelDb, t.value});
        charts.push_back(psychometricChart(
            report.nextFrame(s.condition +
                             (s.kind == LevelTrial::Kind::quest ? " by QUEST+" : " by staircase") +
                             ", n = " + std::to_string(s.thresholds.size())),
            answers, model, FitLabels{}, &s));
    }
    const auto isOf = [&](LevelTrial::Kind kind) {
        return std::ranges::count(summaries, kind, &LevelSummary::kind) > 0;
    };
    if (!charts.empty())
        report.page.addFigure(
            charts,
            std::string{"Share of correct answers by level, of all trials that are analysed, also of who has "
                        "no threshold. Circles: "
                        "larger of more trials. Dotted: mean threshold of the n participants who have one."} +
                (isOf(LevelTrial::Kind::staircase) ? " Threshold of a staircase: mean of the later half of "
                                                     "the reversals that a trial follows (of 7 the last 4)" +
                                                         convergenceText(report.trials)
                                                   : "") +
                (isOf(LevelTrial::Kind::quest)
                     ? " Threshold by QUEST+: mean of its posterior, widths of all participants together."
                     : ""));
}

void addMagnitudes(ReportBuilder& report, const std::vector<LevelSummary>& summaries) {
    report.page.addSubheading("Power law");
    const auto data = report.read(readLevelAnswers, LevelAnswerColumns{"stimulus", "value", true});
    if (!data) return report.noteFailedAnalysis(data.error);
    if (!report.addAnalysis("power-law", report.options(), "power-law.csv").error.empty()) return;
    std::vector<std::string> charts;
    std::vector<std::size_t> people;
    for (const LevelSummary& summary : summaries)
        if (summary.kind == LevelTrial::Kind::magnitude) people.push_back(summary.participants);
    for (const auto& condition : data.value.groups)
        charts.push_back(
            powerLawChart(report.nextFrame(condition.name.empty() ? "Magnitudes" : condition.name),
                          condition.trials, "stimulus"));
    report.page.addFigure(charts,
                          "Geometric mean magnitudes, each divided by its participant's geometric mean in "
                          "the condition, and mean power law" +
                              participantCountText(people) + ". Both axes are logarithmic.");
}

/// Adjustments at an end of their range.
void noteEndsOfRanges(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    for (const SessionPlan& plan : report.trials.sessions()) {
        std::size_t trials = 0, endCount = 0;
        for (const CsvRow& row : report.trials.all.rows) {
            if (!plan.adjustment || cell(row, "session") != plan.name) continue;
            const auto db = parseNumber<double>(cell(row, "value"));
            ++trials;
            endCount += db && (*db <= plan.adjustment->minDb || *db >= plan.adjustment->maxDb);
        }
        if (endCount > 0)
            report.page.addNote(std::to_string(endCount) + " of " + std::to_string(trials) + " levels of " +
                                plan.name + " were set to an end of their range");
    }
}

/// Level and name of the alternative that all adjustments are compared with, if they agree.
std::optional<std::pair<double, std::string>> comparedLevel(const ReportTrials& trials) {
    std::set<std::pair<double, std::string>> all;
    for (const SessionPlan& plan : trials.sessions())
        for (const Alternative& alternative : plan.alternatives)
            if (plan.adjustment && alternative.name != plan.adjustment->alternative)
                all.emplace(alternative.levelDb, alternative.name);
    return all.size() == 1 ? std::optional{*all.begin()} : std::nullopt;
}

} // namespace

void addPsychometricFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, AnalysisJob fit,
                              const std::string& name) {
    fit.columns = report.trials.columns; // for the labels
    report.page.addSubheading("Psychometric functions");
    const bool isFitted = report.addAnalysis("psychometric", fit, name).error.empty();
    if (isFitted) report.page.addTable(report.tableText(name), name, 200, true);
    const FitLabels labels = fitLabels(report.trials.columns, fit.level, fit.measure);
    const PsychometricModel& model = fit.model;
    report.midpointName = labels.midpointName(model), report.slopeName = labels.slopeName(model);
    report.functionsText =
        std::string(psychometricShapeNames[static_cast<std::size_t>(model.shape)]) +
        (model.guess > 0.0 ? ", guess rate " + numberText(std::round(1000.0 * model.guess) / 10.0) + " %"
                           : "") +
        ", lapse rate up to " + numberText(100.0 * model.maxFittedLapseRate()) + " %" +
        (model.guess > 0.0
             ? "; " + report.midpointName + ": " +
                   numberText(std::round(1000.0 * (0.5 + 0.5 * model.guess)) / 10.0) + " %, apart from lapses"
             : " at both ends");
    std::vector<std::string> charts;
    for (const auto& condition : data.groups)
        charts.push_back(psychometricChart(
            report.nextFrame(condition.name.empty() ? "Psychometric functions" : condition.name),
            condition.trials, model, labels));
    report.page.addFigure(
        charts,
        "Share of answers \u201c" + labels.answer + "\u201d by " + labels.level +
            ". Circles: " + (isFitted ? "trials of who has a function" : "all trials") + ", larger of more." +
            (isFitted
                 ? " Thin lines: participants' functions, " + report.functionsText + ". Thick: mean " +
                       report.midpointName +
                       ", and mean width of who has one (a step has none). Dotted: mean " +
                       report.midpointName +
                       ". Column jnd: half of what lies between 0.25 and 0.75 of the shape, without lapses" +
                       (model.guess > 0.0 ? ": a slope; no difference threshold of forced choices."
                                          : ": JND.")
                 : ""));
}

void addLevelsSection(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    if (!report.trials.hasTasks() && !report.trials.all.column("value")) {
        report.page.addHeading("Answers by level");
        return addFits(report);
    }
    const AnalysisJob options = report.options();
    const auto data = readFinishedLevels(options);
    using Kind = LevelTrial::Kind;
    const auto has = [&](Kind kind) {
        return data && std::ranges::any_of(data.value.groups.front().trials,
                                           [=](const LevelTrial& trial) { return trial.kind == kind; });
    };
    if (!data && !report.trials.hasTasks()) { // of other programs: numbers, which analysis.R compares
        report.page.addHeading("Values");
        return report.page.addNote("no power law: " + data.error);
    }
    const bool hasThresholds = has(Kind::staircase) || has(Kind::quest);
    std::vector<std::string> kinds;
    if (hasThresholds || !data) kinds.emplace_back("Thresholds");
    if (has(Kind::adjustment)) kinds.emplace_back("Levels that were set");
    if (has(Kind::magnitude)) kinds.emplace_back("Magnitudes");
    report.page.addHeading(joinNames(kinds, ", "));
    if (!data) return report.noteFailedAnalysis(data.error);
    const auto& trials = data.value.groups.front().trials;
    const auto analysis = report.addAnalysis("levels", options, "levels.csv");
    if (!analysis.error.empty()) return;
    const auto summaries = summariseLevels(trials);
    if (hasThresholds) report.addTable("thresholds.csv", analysis.participants);
    noteEndsOfRanges(report);
    if (std::ranges::count(summaries, LevelTrial::Kind::adjustment, &LevelSummary::kind) > 1) {
        const auto reference = comparedLevel(report.trials);
        std::vector<std::size_t> people;
        bool hasIntervals = false; // one participant has no intervals
        for (const LevelSummary& summary : summaries)
            if (summary.kind == Kind::adjustment)
                people.push_back(summary.participants), hasIntervals |= summary.halfInterval > 0.0;
        report.page.addFigure({levelChart(report.nextFrame("Matched levels"), summaries,
                                          LevelTrial::Kind::adjustment, reference)},
                              "Mean level that was set" + participantCountText(people) +
                                  (reference ? ". Dashed: level of " + reference->second : std::string{}) +
                                  intervalCaption(hasIntervals));
    }
    addThresholds(report, report.read(readLevels).value.groups.front().trials, summaries);
    if (has(LevelTrial::Kind::magnitude) && report.trials.all.column("stimulus"))
        addMagnitudes(report, summaries);
}

// Report sections on forced choices and ratings.

namespace {

constexpr std::size_t maxBars = 24; // bars side by side

/// True if the bars fit side by side; otherwise only the table is shown.
bool fitsSideBySide(const auto& summaries) { return summaries.size() <= maxBars; }

void addShares(ReportBuilder& report, const TrialGroup<ChoiceTrial>& session) {
    const auto summaries = summariseChoices(session.trials);
    const std::string title = nameInSession("Mean share of each alternative", session.name);
    std::vector<std::size_t> people;
    for (const ChoiceSummary& summary : summaries)
        for (const ChoiceShare& share : summary.shares) people.push_back(share.participants);
    if (fitsSideBySide(summaries))
        report.page.addFigure({sharesChart(report.nextFrame(title), summaries)},
                              title + participantCountText(people) + ".");
}

void addScores(ReportBuilder& report, const RatingData& data, const TrialGroup<RatingTrial>& session) {
    const auto summaries = withoutOrdinalIntervals(summariseRatings(session.trials), report.options(), data);
    std::set<int> pointCounts; // points of the scales of this session, or of all where they are not parted
    for (const SessionPlan& plan : report.trials.sessions())
        if (plan.answerKind() == AnswerKind::scores && !plan.isTraining &&
            (session.name.empty() || session.name == plan.name))
            pointCounts.insert(plan.points);
    const std::string title = nameInSession("Mean score of each scale", session.name);
    std::vector<std::size_t> people;
    for (const RatingSummary& summary : summaries)
        for (const std::size_t raterCount : summary.raterCounts)
            if (raterCount > 0) people.push_back(raterCount);
    const bool hasIntervals = std::ranges::any_of(summaries, [](const RatingSummary& summary) {
        return std::ranges::any_of(summary.halfIntervals, [](double half) { return half > 0.0; });
    });
    if (fitsSideBySide(summaries))
        report.page.addFigure({scoresChart(report.nextFrame(title), data.scales, summaries,
                                           pointCounts.size() == 1 ? *pointCounts.begin() : 0)},
                              title + participantCountText(people) + intervalCaption(hasIntervals));
}

/// Adds psychometric functions of the stimuli, if these are numbers and an alternative is correct.
void addConstantStimuli(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.level = "stimulus";
    for (const SessionPlan& session : report.trials.sessions()) {
        if (session.isTraining) continue;
        if (!session.correct.empty()) fit.model.guess = session.guessRate();
        if (session.answers.size() == 2) // yes or no: the midpoint is subjective equality
            fit.model.guess = 0.0, fit.measure = "choice=" + session.answers.back();
    }
    const auto data =
        report.read(readLevelAnswers,
                    LevelAnswerColumns{"stimulus", fit.measure.empty() ? "correct" : fit.measure, false});
    const auto hasLevels = [](const auto& one) { // a column with two levels is a factor
        return countByLevel(one.trials, [](const LevelAnswer& trial) { return trial.levelAndHit(); }).size() >
               2;
    };
    if (!data || !report.trials.hasTasks() || std::ranges::none_of(data.value.groups, hasLevels)) return;
    addPsychometricFunctions(report, data.value, fit, "psychometric-stimuli.csv");
}

} // namespace

void addChoicesSection(ReportBuilder& report) {
    report.page.addHeading("Choices");
    const auto data = report.read(readChoices);
    if (!data) return report.noteFailedAnalysis(data.error);
    if (const auto analysis = report.addAnalysis("choices", report.options(), "choices.csv");
        !analysis.error.empty())
        return;
    addConstantStimuli(report);
    for (const auto& session : data.value.groups) addShares(report, session);
}

void addRatingsSection(ReportBuilder& report) {
    report.page.addHeading("Ratings");
    const auto data = report.read(readRatings);
    if (!data) return report.noteFailedAnalysis(data.error);
    if (const auto analysis = report.addAnalysis("ratings", report.options(), "ratings.csv");
        !analysis.error.empty())
        return;
    report.scales = data.value.scales;
    for (const auto& session : data.value.groups) addScores(report, data.value, session);
}

// Report section on answers in words.

bool addDescriptionsSection(ReportBuilder& report) {
    const Cells cell{report.trials.all};
    std::map<std::array<std::string, 4>, std::size_t> counts; // condition, session, stimulus, words
    for (const CsvRow& row : report.trials.all.rows) {
        if (answerKindOf(cell(row, trialColumns::task)) != AnswerKind::words ||
            cell(row, trialColumns::phase) == trialColumns::training ||
            cell(row, trialColumns::timedOut) == "1")
            continue;
        ++counts[{cell(row, "condition"), cell(row, "session"), cell(row, "stimulus"),
                  cell(row, "response")}];
    }
    if (counts.empty()) return false;
    ExportTable table{"descriptions", report.isSimulated(), "condition,session,stimulus,response,trials"};
    for (const auto& [key, trials] : counts) table.row(key[0], key[1], key[2], key[3], trials);
    report.page.addHeading("Answers in words");
    report.show("descriptions.csv", table);
    return true;
}

} // namespace physvib
