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
#include <array>
#include <set>

namespace physvib {
namespace {

/// Factors in condition names like "pair=wood size=small", with their values in table order; empty if a
/// condition has another kind of name.
std::vector<std::pair<std::string, std::vector<std::string>>>
factorsOf(const std::vector<ChoiceTrial>& trials) {
    std::vector<std::pair<std::string, std::vector<std::string>>> factors;
    for (const ChoiceTrial& trial : trials)
        for (std::string_view rest = trial.condition; !rest.empty();) {
            const std::string_view word = takeUntil(' ', rest);
            const std::size_t equals = word.find('=');
            if (equals == std::string_view::npos) return {};
            const std::string name{word.substr(0, equals)}, value{word.substr(equals + 1)};
            auto found =
                std::ranges::find(factors, name, &std::pair<std::string, std::vector<std::string>>::first);
            if (found == factors.end()) found = factors.insert(factors.end(), {name, {}});
            if (std::ranges::find(found->second, value) == found->second.end())
                found->second.push_back(value);
        }
    return factors;
}

/// True if the condition contains `factor=value`.
bool hasWord(std::string_view condition, const std::string& factor, const std::string& value) {
    while (!condition.empty())
        if (takeUntil(' ', condition) == factor + "=" + value) return true;
    return false;
}

/// Shares of one participant have Wilson's interval over trials.
std::string shareIntervals(const ReportBuilder& report) {
    return report.people() > 1 ? report.intervals() : ", of one participant: 95 % intervals over trials";
}

/// Mean share of the first alternative for each combination of two factors, over the levels of the others.
std::string combinationChart(ReportBuilder& report, const std::vector<ChoiceTrial>& trials,
                             const std::pair<std::string, std::vector<std::string>>& first,
                             const std::pair<std::string, std::vector<std::string>>& second,
                             const std::string& alternative) {
    BarChart chart{report.frame("Chosen: " + alternative + ", by " + first.first + " and " + second.first),
                   second.first,
                   "chosen (%)",
                   second.second,
                   {}};
    for (const std::string& a : first.second) {
        chart.series.push_back({first.first + " " + a, {}});
        for (const std::string& b : second.second) {
            std::vector<ChoiceTrial> chosen;
            for (const ChoiceTrial& trial : trials) {
                if (hasWord(trial.condition, first.first, a) && hasWord(trial.condition, second.first, b))
                    chosen.push_back({trial.participant, "", trial.choice});
            }
            std::optional<ChartValue> bar;
            for (const ChoiceSummary& summary : summariseChoices(chosen))
                for (const ChoiceShare& share : summary.shares)
                    if (share.alternative == alternative)
                        bar = ChartValue{100.0 * share.share, 100.0 * share.least, 100.0 * share.most};
            chart.series.back().bars.push_back(bar);
        }
    }
    chart.most = 100.0;
    chart.reference = {50.0, "chance"};
    return barChart(chart);
}

// Ratings:

struct RatedFactor {
    const char* name;
    const char* words;
    const char* varied;
    const char* fixed;
};
constexpr RatedFactor ratedFactors[] = {
    {"A", "amplitude", "AV", "AF"}, {"F", "frequency", "FV", "FF"}, {"DR", "decay rate", "DRV", "DRF"}};

/// One panel per scale with the three factors of the thesis' methods.
std::vector<std::string> factorCharts(ReportBuilder& report, const std::vector<std::string>& scales,
                                      const std::vector<RatingSummary>& summaries) {
    std::vector<std::string> charts;
    for (std::size_t s = 0; s < scales.size(); ++s) {
        BarChart chart{
            report.frame(scales[s]), "", "mean score (0 to 100)", {}, {{"varied", {}}, {"fixed", {}}}};
        for (const RatedFactor& factor : ratedFactors) {
            const auto *const varied = conditionNamed(summaries, factor.varied), *const fixed =
                                                                                     conditionNamed(
                                                                                         summaries,
                                                                                         factor.fixed);
            if (!varied || !fixed) continue;
            chart.groups.emplace_back(factor.words);
            chart.series[0].bars.push_back(scoreOf(*varied, s));
            chart.series[1].bars.push_back(scoreOf(*fixed, s));
        }
        chart.most = 100.0;
        charts.push_back(barChart(chart));
    }
    return charts;
}

/// Psychometric functions over the stimuli, where these are numbers and an alternative is right.
void tellConstantStimuli(ReportBuilder& report, const NamedText& file) {
    const auto data = readLevelAnswers({&file, 1}, {"stimulus", "correct", false});
    if (!data || !report.trials.knowTasks()) return;
    AnalysisJob fit = report.optionsFor(trialsTable);
    fit.level = "stimulus";
    if (report.trials.protocol)
        for (const SessionPlan& session : report.trials.protocol->sessions)
            if (!session.correct.empty()) fit.model.guess = session.guessRate();
    report.page.subheading("Psychometric functions");
    if (const auto words = report.analysis("psychometric", fit, "psychometric-stimuli.csv");
        !words.error.empty())
        return;
    std::vector<std::string> charts;
    for (const auto& condition : data.value.conditions)
        charts.push_back(psychometricChart(report.frame("Right answers: " + condition.name), condition.trials,
                                           fit.model, fitWords(report.trials.columns, fit.level)));
    report.page.figure(
        charts, "Share of right answers by stimulus. Circles: all participants' trials; thin lines: the "
                "function of each participant; thick: their mean threshold and width.");
}

} // namespace

void tellChoices(ReportBuilder& report) {
    report.page.heading("Choices");
    const NamedText file{report.tableText(trialsTable), trialsTable};
    const auto data = readChoices({&file, 1});
    if (!data) return report.page.note(data.error);
    if (const auto words = report.analysis("choices", report.optionsFor(trialsTable), "choices.csv");
        !words.error.empty())
        return;
    tellConstantStimuli(report, file);
    const auto& trials = data.value.conditions.front().trials;
    const auto summaries = summariseChoices(trials);
    std::vector<std::string> groups{"all"};
    std::vector<const ChoiceSummary*> chosen{&summaries.front()};
    const auto factors = factorsOf(trials);
    for (const auto& [name, values] : factors)
        for (const std::string& value : values)
            if (const auto* const summary = conditionNamed(summaries, name + "=" + value);
                summary && values.size() > 1) {
                groups.push_back(value);
                chosen.push_back(summary);
            }
    if (factors.empty())
        for (std::size_t i = 1; i < std::min<std::size_t>(summaries.size(), 24); ++i) {
            groups.push_back(summaries[i].condition);
            chosen.push_back(&summaries[i]);
        }
    std::string names;
    for (const auto& [name, values] : factors) names.append(names.empty() ? "all; by " : ", ").append(name);
    report.page.figure({sharesChart(report.frame("Shares of the alternatives"),
                                    names.empty() ? "condition" : names, groups, chosen)},
                       "Mean of the participants' shares (as thesis Fig. 5.8, which has medians)" +
                           shareIntervals(report) + ".");
    if (summaries.front().shares.size() != 2) return;
    const std::string alternative = summaries.front().shares.front().alternative;
    std::vector<std::pair<std::string, std::vector<std::string>>> several;
    for (const auto& factor : factors)
        if (factor.second.size() > 1) several.push_back(factor);
    if (several.size() < 2) return;
    report.page.figure(
        {combinationChart(report, trials, several[several.size() - 2], several.back(), alternative)},
        "Shares by two factors (as thesis Fig. 5.9)" + shareIntervals(report) + ", within 0 and 100 %.");
}

void tellRatings(ReportBuilder& report) {
    report.page.heading("Ratings");
    const NamedText file{report.tableText(trialsTable), trialsTable};
    const auto data = readRatings({&file, 1});
    if (!data) return report.page.note(data.error);
    if (const auto words = report.analysis("ratings", report.optionsFor(trialsTable), "ratings.csv");
        !words.error.empty())
        return;
    const auto& trials = data.value.data.conditions.front().trials;
    const auto& scales = data.value.scales;
    const auto summaries = summariseRatings(trials);
    std::set<std::string> conditions;
    for (const RatingTrial& trial : trials) conditions.insert(trial.condition);
    const bool hasMethods = summaries.size() > conditions.size();
    if (hasMethods)
        report.page.figure(factorCharts(report, scales, summaries),
                           "Mean scores by factor (as thesis Fig. 5.13)" + report.intervals() + ".");
    std::vector<const RatingSummary*> shown;
    for (auto at = summaries.rbegin(); at != summaries.rend(); ++at) // reverse order, so that AV-FV-DRV comes
                                                                     // first
        if (conditions.contains(at->condition)) shown.push_back(&*at);
    report.page.figure({scoresChart(report.frame("Mean scores"), scales, shown)},
                       "Mean scores by condition (as thesis Fig. 5.14)" + report.intervals() + ".");
}

// Report section on answers in words, from the columns task, phase, condition, session, stimulus and
// response.

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
