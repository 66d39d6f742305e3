// SPDX-License-Identifier: MIT
// Report sections on forced choices and ratings.
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/StudyTasks.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <array>
#include <set>

namespace physvib {
namespace {

constexpr std::size_t mostShown = 24; // bars side by side

/// As published; fewer people have no interval of 95 % by ranks.
bool showsMedians(const ReportBuilder& report) { return report.isAsPublished() && report.people() >= 6; }

/// Shares of one participant have Wilson's interval over trials.
std::string shareIntervals(const ReportBuilder& report, const std::vector<ChoiceSummary>& shown) {
    if (showsMedians(report)) return ", 95 % intervals by ranks of participants";
    return report.people() > 1 ? report.intervals() + intervalNotes(shown)
                               : ", of one participant: 95 % intervals over trials, Wilson's";
}

using SessionOfChoices = StudyCondition<ChoiceTrial>;

/// Shares by the last two factors of names like "pair=wood size=small", over the levels of the others.
void tellTwoFactors(ReportBuilder& report, SessionOfChoices session) {
    auto& trials = session.trials;
    std::set<std::string> both;
    for (ChoiceTrial& trial : trials) {
        const auto words = factorWords(trial.condition);
        if (words.size() < 2) return;
        trial.condition = words.end()[-2] + " " + words.back();
        both.insert(trial.condition);
    }
    if (both.size() > mostShown) return;
    auto summaries = summariseChoices(trials);
    std::erase_if(summaries, [&](const ChoiceSummary& each) { return !both.contains(each.condition); });
    report.page.figure(
        {sharesChart(report.frame(inSession("Shares by two factors", session.name)), summaries,
                     showsMedians(report))},
        inSession(showsMedians(report) ? "Median shares by two factors" : "Shares by two factors",
                  session.name) +
            report.asThesis("Fig. 5.9") + shareIntervals(report, summaries) + ".");
}

void tellShares(ReportBuilder& report, const SessionOfChoices& session) {
    auto summaries = summariseChoices(session.trials);
    std::set<std::string> conditions;
    for (const ChoiceTrial& trial : session.trials) conditions.insert(trial.condition);
    // Of factors their levels; else all trials, and conditions while there is room.
    const bool hasFactors = summaries.size() > conditions.size() + 1;
    std::erase_if(summaries, [&](const ChoiceSummary& each) {
        return hasFactors && conditions.contains(each.condition);
    });
    if (summaries.size() > mostShown) summaries.resize(mostShown);
    const bool areOfSome = std::ranges::any_of(summaries, [](const ChoiceSummary& one) {
        return std::ranges::any_of(one.shares, [&](const auto& share) { return share.trials < one.trials; });
    });
    report.page.figure(
        {sharesChart(report.frame(inSession("Shares of the alternatives", session.name)), summaries,
                     showsMedians(report))},
        inSession(report.people() < 2 ? std::string{"Shares of the alternatives"}
                                      : (showsMedians(report) ? "Median" : "Mean") +
                                            std::string{" of the participants' shares"},
                  session.name) +
            report.asThesis(showsMedians(report) ? "Fig. 5.8" : "Fig. 5.8, which has medians") +
            shareIntervals(report, summaries) + ". " +
            (alternativesOffered(summaries) > 0
                 ? "Chance: 1 of the " + std::to_string(alternativesOffered(summaries)) +
                       " alternatives offered or given"
                 : std::string{"Trials offered unequal numbers of alternatives, so chance has no line"}) +
            (areOfSome ? "; a share is of the trials that offered it." : "."));
    if (hasFactors) tellTwoFactors(report, session);
}

void tellScores(ReportBuilder& report, const RatingData& data, const StudyCondition<RatingTrial>& session) {
    const auto summaries = summariseRatings(session.trials);
    std::set<std::string> conditions;
    for (const RatingTrial& trial : session.trials) conditions.insert(trial.condition);
    const bool hasIntervals = std::ranges::any_of(summaries, [](const RatingSummary& one) {
        return std::ranges::any_of(one.halfIntervals, [](double half) { return half > 0.0; });
    });
    std::set<int> all; // points of the scales of this session, or of all where they are not parted
    for (const SessionPlan& plan :
         report.trials.protocol ? report.trials.protocol->sessions : std::vector<SessionPlan>{})
        if (plan.answer() == AnswerKind::scores && !plan.isTraining &&
            (session.name.empty() || session.name == plan.name))
            all.insert(plan.points);
    const int points = all.size() == 1 ? *all.begin() : 0;
    const auto draw = [&](const char* words, const char* figure, const std::vector<RatingSummary>& shown) {
        const std::string title = inSession(words, session.name);
        report.page.figure(
            {scoresChart(report.frame(title), data.scales, shown, points)},
            title + report.asThesis(figure) + report.intervals(hasIntervals) +
                (report.people() > 1 && std::ranges::count(shown, 1, &RatingSummary::participants) > 0
                     ? ", none of one alone"
                     : "") +
                ".");
    };
    // In reverse order, so that AV-FV-DRV comes first; of many combinations the levels of factors.
    const bool isMany = conditions.size() > mostShown && summaries.size() > conditions.size();
    std::vector<RatingSummary> shown, factors;
    for (const RatingSummary& each : summaries) {
        if (conditions.contains(each.condition) != isMany) shown.insert(shown.begin(), each);
        if (!conditions.contains(each.condition)) factors.push_back(each);
    }
    draw("Mean scores", "Fig. 5.14", shown);
    if (!factors.empty() && !isMany) // of many they are shown already
        draw("Mean scores by factor", "Fig. 5.13", factors);
}

/// Psychometric functions over the stimuli, where these are numbers and an alternative is right.
void tellConstantStimuli(ReportBuilder& report) {
    AnalysisJob fit = report.options();
    fit.level = "stimulus";
    const auto sessions =
        report.trials.protocol ? report.trials.protocol->sessions : std::vector<SessionPlan>{};
    for (const SessionPlan& session : sessions) {
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
    std::size_t all = 0, empty = 0;
    for (const CsvRow& row : report.trials.all.rows) {
        if (answerOf(cell(row, trialColumns::task)) != AnswerKind::words ||
            cell(row, trialColumns::phase) == trialColumns::training ||
            cell(row, trialColumns::ranOut) == "1")
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
