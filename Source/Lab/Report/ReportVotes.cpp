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
    for (const SessionPlan& plan :
         report.trials.protocol ? report.trials.protocol->sessions : std::vector<SessionPlan>{})
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
    report.addTable("descriptions.csv", table.text());
    report.page.heading("Answers in words");
    report.page.table(report.tableText("descriptions.csv"), "descriptions.csv");
    return true;
}

} // namespace physvib
