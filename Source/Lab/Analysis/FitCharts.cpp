// SPDX-License-Identifier: MIT
// Charts of fits: answers as points, fitted functions as lines.
#include "Lab/Analysis/FitCharts.h"
#include "Io/Text/NumberText.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace physvib {
namespace {

constexpr int curvePoints = 80;

LineSeries curve(const PsychometricFunction& f, double least, double most) {
    LineSeries series{{}, {}};
    series.isMarked = false;
    for (int i = 0; i <= curvePoints; ++i) {
        const double level = least + (most - least) * i / curvePoints, p = 100.0 * f.probability(level);
        series.points.push_back({level, {p, p, p}});
    }
    return series;
}

double meanOf(const std::vector<double>& values) { return Moments(values).mean; }

} // namespace

int decimalsOf(double jnd) noexcept {
    int decimals = 2;
    for (double rest = std::abs(jnd) * 10.0; rest > 0.0 && rest < 1.0 && decimals < 12; rest *= 10.0)
        ++decimals;
    return decimals;
}

FitWords fitWords(std::span<const ColumnName> columns, const std::string& level, const std::string& measure) {
    FitWords words;
    for (const ColumnName& column : columns) {
        if (column.ours == "level_db") words.level = column.theirs;
        if (column.ours == "correct") words.answer = column.theirs;
    }
    if (!level.empty()) words.level = level;
    if (!measure.empty()) words.answer = measure;
    return words;
}

std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                              const PsychometricModel& model, const FitWords& words,
                              const LevelSummary* told) {
    std::map<double, std::pair<double, double>> counts; // level -> hits, trials
    for (const LevelAnswer& trial : trials) {
        counts[trial.level].first += trial.answer;
        counts[trial.level].second += 1.0;
    }
    const double least = counts.begin()->first, most = counts.rbegin()->first;
    LineChart chart{std::move(frame), words.level, words.answer + " (%)", {}};
    chart.yRange = {0.0, 100.0};
    std::vector<double> thresholds, widths, lapses;
    const bool isAdaptive = trials.front().isAdaptive; // the slopes of its functions are no result
    for (const auto& own : psychometricByParticipant(trials, model)) {
        if (!own.fit.fault.empty()) continue;
        thresholds.push_back(own.fit.function.threshold);
        widths.push_back(own.fit.function.width);
        lapses.push_back(own.fit.function.lapse);
        if (isAdaptive) continue;
        chart.series.push_back(curve(own.fit.function, least, most));
        chart.series.back().isFaint = true;
    }
    LineSeries answers{"trials of all participants", {}};
    answers.isDrawnThrough = false;
    double largest = 1.0;
    for (const auto& [level, count] : counts) largest = std::max(largest, count.second);
    for (const auto& [level, count] : counts) {
        const double share = 100.0 * count.first / count.second;
        answers.points.push_back(
            {level, {share, share, share}, 0.5 + 1.3 * std::sqrt(count.second / largest)});
    }
    if (told != nullptr) {
        chart.threshold =
            ChartValue::around(told->estimate, told->participants > 1 ? told->halfInterval : 0.0);
        chart.thresholdWords = "threshold " + fixedNumber(told->estimate, 1);
    } else if (!thresholds.empty()) {
        if (!isAdaptive) {
            LineSeries mean = curve(
                {model.shape, meanOf(thresholds), meanOf(widths), model.guess, meanOf(lapses)}, least, most);
            mean.name = "mean of the participants' functions";
            mean.style = 4;
            chart.series.push_back(std::move(mean));
        }
        const Moments own{thresholds};
        chart.threshold = ChartValue::around(own.mean, own.halfInterval());
        chart.thresholdWords = "threshold " + fixedNumber(own.mean, decimalsOf(0.2 * meanOf(widths)));
    }
    chart.series.push_back(std::move(answers));
    if (model.guess > 0.0) chart.references = {{100.0 * model.guess, "guessing"}};
    return lineChart(chart);
}

std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                          const std::string& levelWords) {
    // by participant and level: log10 of magnitudes
    std::map<std::string, std::map<double, std::vector<double>>> people;
    for (const LevelAnswer& trial : trials)
        if (trial.answer > 0.0 && trial.level > 0.0)
            people[trial.participant][trial.level].push_back(std::log10(trial.answer));
    std::map<double, std::vector<double>> relative;
    for (const auto& [who, levels] : people) {
        std::vector<double> means;
        for (const auto& [level, values] : levels) means.push_back(meanOf(values));
        const double own = meanOf(means);
        std::size_t i = 0;
        for (const auto& [level, values] : levels) relative[level].push_back(means[i++] - own);
    }
    LineChart chart{std::move(frame), levelWords, "magnitude / participant's mean", {}};
    chart.isLogarithmic = true;
    LineSeries points{"geometric mean of participants", {}};
    points.isDrawnThrough = false;
    double middle = 0.0;
    for (const auto& [level, values] : relative) {
        const Moments moments{values};
        points.points.push_back(
            {level,
             {std::pow(10.0, moments.mean), std::pow(10.0, moments.mean - moments.halfInterval()),
              std::pow(10.0, moments.mean + moments.halfInterval())}});
        middle += std::log10(level) / static_cast<double>(relative.size());
    }
    std::vector<double> exponents;
    for (const auto& own : powerLawByParticipant(trials))
        if (own.law.fault.empty()) exponents.push_back(own.law.exponent);
    if (!exponents.empty() && !points.points.empty()) {
        const double exponent = meanOf(exponents);
        LineSeries law{"power law, exponent " + fixedNumber(exponent, 3), {}};
        law.isMarked = false;
        law.style = 4;
        for (const double level : {points.points.front().x, points.points.back().x}) {
            const double y = std::pow(10.0, exponent * (std::log10(level) - middle));
            law.points.push_back({level, {y, y, y}});
        }
        chart.series.push_back(std::move(law));
    }
    chart.series.push_back(std::move(points));
    return lineChart(chart);
}

} // namespace physvib
