// SPDX-License-Identifier: MIT
// Draws study results, for the pictures of `analyse` and for reports.
#include "Lab/Analysis/StudyCharts.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace physvib {
namespace {

PlaceChart makePlaceChart(ChartFrame frame, const ConditionResolution& condition) {
    PlaceChart chart{std::move(frame), condition.normals.rows, condition.normals.columns};
    const auto& normals = condition.normals.normals;
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (normals[i].responses > 0)
            chart.ellipses.push_back({i, normals[i].meanX, normals[i].meanY, normals[i].varianceX,
                                      normals[i].varianceY, normals[i].covariance});
    return chart;
}

std::vector<std::string> numberLabels(std::size_t count) {
    std::vector<std::string> numbers;
    for (std::size_t i = 1; i <= count; ++i) numbers.push_back(std::to_string(i));
    return numbers;
}

} // namespace

std::string confusionChart(ChartFrame frame, const ConfusionMatrix& matrix) {
    GridChart chart{std::move(frame), "stimulus", "response"};
    for (std::size_t i = 0; i < matrix.stimuli(); ++i) chart.rows.push_back(matrix.label(i));
    for (std::size_t j = 0; j < matrix.responses(); ++j) chart.columns.push_back(matrix.label(j));
    const auto totals = matrix.stimulusTotals();
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            const double share = 100.0 * matrix.count(i, j) / static_cast<double>(totals[i]);
            chart.values.push_back(share > 0.0 ? std::optional{share} : std::nullopt);
        }
    chart.max = 100.0;
    return gridChart(chart);
}

std::string responsesChart(ChartFrame frame, const ConditionResolution& condition,
                           const std::vector<LocationTrial>& trials) {
    PlaceChart chart = makePlaceChart(std::move(frame), condition);
    for (const LocationTrial& trial : trials)
        chart.places.push_back({static_cast<std::size_t>(trial.targetRow - 1) * chart.columns +
                                    static_cast<std::size_t>(trial.targetColumn - 1),
                                trial.x, trial.y});
    return placeChart(chart);
}

std::string territoryChart(ChartFrame frame, const ConditionResolution& condition) {
    constexpr std::size_t columns = 164, rows = 85; // enough for a page; percent counts use every pixel
    PlaceChart chart = makePlaceChart(std::move(frame), condition);
    for (const auto target : likelihoodMap(condition.normals, columns, rows))
        chart.territory.push_back(target);
    chart.mapColumns = columns;
    for (const PlaceEllipse& e : chart.ellipses) chart.labels.push_back({e.target, e.x, e.y});
    chart.ellipses.clear();
    return placeChart(chart);
}

std::string countsChart(ChartFrame frame, const PercentCounts& counts) {
    GridChart chart{std::move(frame),
                    "row",
                    "column",
                    numberLabels(counts.rows),
                    numberLabels(counts.columns),
                    {counts.percent.begin(), counts.percent.end()}};
    chart.max = 10.0;
    chart.cellAspect = 0.6;
    chart.decimals = 2;
    chart.framedBelow = defaultPercentThreshold;
    return gridChart(chart);
}

std::string mergedChart(ChartFrame frame, const ConditionResolution& condition) {
    const GridMerge& merge = condition.resolution.ties.front();
    frame.title +=
        ": " + std::to_string(merge.columnGroups.size()) + " x " + std::to_string(merge.rowGroups.size());
    return countsChart(std::move(frame), mergedCounts(condition.counts, merge));
}

std::string sharesChart(ChartFrame frame, const std::vector<ChoiceSummary>& summaries) {
    BarChart chart{std::move(frame), "condition", "chosen (%)"};
    std::set<std::string> alternatives;
    for (const ChoiceSummary& summary : summaries)
        for (const ChoiceShare& share : summary.shares) alternatives.insert(share.alternative);
    for (const std::string& alternative : alternatives) chart.series.push_back({alternative, {}});
    for (const ChoiceSummary& summary : summaries) {
        chart.groups.push_back(summary.condition);
        for (BarSeries& series : chart.series) {
            const ChoiceShare* const share = summary.findShare(series.name);
            auto& bar = series.bars.emplace_back(); // none: not offered
            if (share != nullptr && !std::isnan(share->share))
                bar = ChartValue::withMargin(100.0 * share->share);
        }
    }
    chart.max = 100.0;
    return barChart(chart);
}

std::string scoresChart(ChartFrame frame, const std::vector<std::string>& scales,
                        const std::vector<RatingSummary>& summaries, int points) {
    BarChart chart{std::move(frame), "condition", "mean score"};
    for (const std::string& scale : scales) chart.series.push_back({scale, {}});
    for (const RatingSummary& summary : summaries) {
        chart.groups.push_back(summary.condition);
        for (std::size_t s = 0; s < scales.size(); ++s)
            chart.series[s].bars.push_back(
                std::isnan(summary.means[s])
                    ? std::nullopt
                    : std::optional{ChartValue::withMargin(summary.means[s], summary.halfIntervals[s])});
        // scores of some points have an axis of their own
        if (std::ranges::any_of(summary.means, [](double mean) { return mean > 11.0; })) chart.max = 100.0;
    }
    if (points > 0) chart.min = 1.0, chart.max = points;
    std::erase_if(chart.series, [](const BarSeries& series) { // not asked in this session
        return std::ranges::none_of(series.bars, [](const auto& bar) { return bar.has_value(); });
    });
    return barChart(chart);
}

std::string levelChart(ChartFrame frame, std::span<const LevelSummary> summaries, LevelTrial::Kind kind,
                       const std::optional<std::pair<double, std::string>>& reference) {
    const bool isMagnitude = kind == LevelTrial::Kind::magnitude;
    BarChart chart{std::move(frame), "condition", isMagnitude ? "geometric mean" : "level (dB)"};
    chart.reference = reference;
    for (const LevelSummary& s : summaries)
        if (s.kind == kind && !std::isnan(s.estimate))
            chart.add(s.condition + (s.stimulus.empty() ? "" : ", " + s.stimulus),
                      ChartValue::withMargin(s.estimate, s.halfInterval));
    return chart.groups.empty() ? std::string{} : barChart(chart);
}

std::vector<std::string> isolationCharts(std::span<const IsolationResult> results) {
    // axis, layer, frequency -> gammas of all voltages; of one layer: axis, voltage, frequency
    std::map<std::string, std::map<std::string, std::map<double, std::vector<double>>>> axes;
    std::map<std::string, std::size_t> styles;
    const auto layerName = [](const IsolationCondition& c) {
        return c.material + (c.softener.empty() ? "" : ", " + c.softener + " %") +
               (c.thickness.empty() ? "" : ", " + c.thickness + " mm");
    };
    const bool hasOneLayer = std::ranges::all_of(results, [&](const IsolationResult& r) { // thesis Fig. 3.5
        return layerName(r.condition) == layerName(results.front().condition);
    });
    for (const IsolationResult& r : results) {
        const auto& c = r.condition;
        const std::string layer =
            layerName(c) + (hasOneLayer && !c.voltage.empty() ? ", " + c.voltage + " V" : "");
        styles.try_emplace(layer, styles.size());
        axes[c.axis][layer][c.frequencyHz].push_back(r.mean);
    }
    std::vector<std::string> charts;
    for (const auto& [axis, layers] : axes) {
        LineChart chart{
            {chartName(charts.size()), "Isolation, axis " + axis}, "frequency (Hz)", "gamma (Eq. 3.2), mean"};
        for (const auto& [layer, curve] : layers) {
            LineSeries series{layer};
            series.style = styles.at(layer);
            for (const auto& [hz, gammas] : curve)
                series.points.push_back({hz, ChartValue::withMargin(Moments(gammas).mean)});
            chart.series.push_back(std::move(series));
        }
        charts.push_back(lineChart(chart));
    }
    return charts;
}

namespace {

constexpr int curvePoints = 80;

LineSeries curve(const PsychometricFunction& f, double minLevel, double maxLevel) {
    LineSeries series{{}};
    series.hasMarkers = false;
    for (int i = 0; i <= curvePoints; ++i) {
        const double level = minLevel + (maxLevel - minLevel) * i / curvePoints,
                     p = 100.0 * f.probability(level);
        series.points.push_back({level, {p, p, p}});
    }
    return series;
}

double meanOf(const std::vector<double>& values) { return Moments(values).mean; }

} // namespace

FitLabels fitLabels(std::span<const ColumnName> columns, const std::string& level,
                    const std::string& measure) {
    FitLabels labels;
    for (const ColumnName& column : columns) {
        if (column.ours == "level_db") labels.level = column.theirs;
        if (column.ours == "correct") labels.answer = column.theirs;
    }
    if (!level.empty()) labels.level = level;
    if (!measure.empty()) labels.answer = measure;
    return labels;
}

std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                              const PsychometricModel& model, const FitLabels& labels,
                              const LevelSummary* methodThreshold) {
    const auto fits = psychometricByParticipant(methodThreshold ? std::vector<LevelAnswer>{} : trials, model);
    std::vector<LevelAnswer> subset = trials; // people with a function, or all if nobody has one
    const auto hasNoFit = [](const auto& entry) { return !entry.fit.error.empty(); };
    if (!std::ranges::all_of(fits, hasNoFit))
        for (const auto& entry : fits)
            if (hasNoFit(entry))
                std::erase_if(subset,
                              [&](const auto& trial) { return trial.participant == entry.participant; });
    const auto counts = countByLevel(subset, [](const LevelAnswer& trial) { return trial.levelAndHit(); });
    const double minLevel = counts.front().level, maxLevel = counts.back().level;
    LineChart chart{std::move(frame), labels.level, labels.answer + " (%)"};
    chart.yRange = {0.0, 100.0};
    std::vector<double> thresholds, widths, lapses;
    for (const auto& entry : fits) {
        if (hasNoFit(entry)) continue;
        thresholds.push_back(entry.fit.function.threshold);
        if (entry.fit.hasJnd) widths.push_back(entry.fit.function.width);
        lapses.push_back(entry.fit.function.lapse);
        chart.series.push_back(curve(entry.fit.function, minLevel, maxLevel));
        chart.series.back().isFaint = true;
    }
    LineSeries answers{"trials"};
    answers.hasLine = false;
    const auto maxTrials = static_cast<double>(std::ranges::max(counts, {}, &LevelCount::trials).trials);
    for (const LevelCount& count : counts) {
        const auto n = static_cast<double>(count.trials);
        const double share = 100.0 * static_cast<double>(count.hits) / n;
        answers.points.push_back({count.level, {share, share, share}, 0.5 + 1.3 * std::sqrt(n / maxTrials)});
    }
    if (methodThreshold != nullptr) {
        chart.threshold = ChartValue::withMargin(methodThreshold->estimate);
        chart.thresholdLabel = "mean threshold";
    } else if (!thresholds.empty()) {
        if (!widths.empty()) {
            LineSeries mean = curve(model.functionWith(meanOf(thresholds), meanOf(widths), meanOf(lapses)),
                                    minLevel, maxLevel);
            mean.name = "mean function";
            mean.style = 4;
            chart.series.push_back(std::move(mean));
        }
        chart.threshold = ChartValue::withMargin(meanOf(thresholds));
        chart.thresholdLabel = std::string{"mean "} + labels.midpointName(model);
    }
    chart.series.push_back(std::move(answers));
    if (model.guess > 0.0) chart.references = {{100.0 * model.guess, "guessing"}};
    return lineChart(chart);
}

std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                          const std::string& levelLabel) {
    // by participant and level: log10 of magnitudes
    std::map<std::string, std::map<double, std::vector<double>>> people;
    for (const LevelAnswer& trial : trials)
        if (trial.answer > 0.0 && trial.level > 0.0)
            people[trial.participant][trial.level].push_back(std::log10(trial.answer));
    std::map<double, std::vector<double>> relative;
    std::map<std::string, double> meanLogs;
    for (const auto& [participant, levels] : people) {
        std::vector<double> means;
        for (const auto& [level, values] : levels) means.push_back(meanOf(values));
        const double mean = meanLogs[participant] = meanOf(means);
        std::size_t i = 0;
        for (const auto& [level, values] : levels) relative[level].push_back(means[i++] - mean);
    }
    LineChart chart{std::move(frame), levelLabel, "magnitude / participant's geometric mean"};
    chart.isLogarithmic = true;
    LineSeries points{"geometric mean of participants"};
    points.hasLine = false;
    for (const auto& [level, values] : relative)
        points.points.push_back({level, ChartValue::withMargin(std::pow(10.0, meanOf(values)))});
    // each law in units of its participant's geometric mean, as the points are: people may have other levels
    std::vector<double> exponents, intercepts;
    for (const auto& entry : powerLawByParticipant(trials))
        if (entry.fit.error.empty()) {
            exponents.push_back(entry.fit.exponent);
            intercepts.push_back(std::log10(entry.fit.factor) - meanLogs[entry.participant]);
        }
    if (!exponents.empty() && !points.points.empty()) {
        const double exponent = meanOf(exponents), intercept = meanOf(intercepts);
        LineSeries law{"mean power law"};
        law.hasMarkers = false;
        law.style = 4;
        for (const double level : {points.points.front().x, points.points.back().x}) {
            const double y = std::pow(10.0, intercept + exponent * std::log10(level));
            law.points.push_back({level, {y, y, y}});
        }
        chart.series.push_back(std::move(law));
    }
    chart.series.push_back(std::move(points));
    return lineChart(chart);
}

} // namespace physvib
