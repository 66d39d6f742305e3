// SPDX-License-Identifier: MIT
// Draws study results, for the pictures of `analyse` and for reports.
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <map>

namespace physvib {
namespace {

PlaceChart fieldOf(ChartFrame frame, const ConditionResolution& one) {
    PlaceChart chart{std::move(frame), one.normals.rows, one.normals.columns};
    const auto& normals = one.normals.normals;
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (normals[i].responses > 0)
            chart.ellipses.push_back({i, normals[i].meanX, normals[i].meanY, normals[i].varianceX,
                                      normals[i].varianceY, normals[i].covariance});
    return chart;
}

std::vector<std::string> numbersTo(std::size_t most) {
    std::vector<std::string> numbers;
    for (std::size_t i = 1; i <= most; ++i) numbers.push_back(std::to_string(i));
    return numbers;
}

} // namespace

std::string confusionChart(ChartFrame frame, const ConfusionMatrix& matrix) {
    GridChart chart{std::move(frame), "stimulus", "response", {}, {}, {}};
    for (std::size_t i = 0; i < matrix.stimuli(); ++i) chart.rows.push_back(matrix.label(i));
    for (std::size_t j = 0; j < matrix.responses(); ++j) chart.columns.push_back(matrix.label(j));
    const auto totals = matrix.stimulusTotals();
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            const double share = 100.0 * matrix.count(i, j) / static_cast<double>(totals[i]);
            chart.values.push_back(share > 0.0 ? std::optional{share} : std::nullopt);
        }
    chart.most = 100.0;
    return gridChart(chart);
}

std::string responsesChart(ChartFrame frame, const ConditionResolution& one,
                           const std::vector<LocationTrial>& trials) {
    PlaceChart chart = fieldOf(std::move(frame), one);
    for (const LocationTrial& trial : trials)
        chart.places.push_back({static_cast<std::size_t>(trial.targetRow - 1) * chart.columns +
                                    static_cast<std::size_t>(trial.targetColumn - 1),
                                trial.x, trial.y});
    return placeChart(chart);
}

std::string territoryChart(ChartFrame frame, const ConditionResolution& one) {
    constexpr std::size_t columns = 164, rows = 85; // sufficient resolution for a page; percent counts use
                                                    // every pixel
    PlaceChart chart = fieldOf(std::move(frame), one);
    for (const std::uint16_t owner : likelihoodMap(one.normals, columns, rows))
        chart.territory.push_back(owner);
    chart.mapColumns = columns;
    for (const PlaceEllipse& e : chart.ellipses) chart.labels.push_back({e.target, e.x, e.y});
    chart.ellipses.clear();
    return placeChart(chart);
}

std::string countsChart(ChartFrame frame, const PercentCounts& counts) {
    GridChart chart{std::move(frame),
                    "row",
                    "column",
                    numbersTo(counts.rows),
                    numbersTo(counts.columns),
                    {counts.percent.begin(), counts.percent.end()}};
    chart.most = 10.0;
    chart.shape = 0.6;
    chart.decimals = 2;
    chart.markedBelow = defaultPercentThreshold;
    return gridChart(chart);
}

std::string mergedChart(ChartFrame frame, const ConditionResolution& one) {
    const GridMerge& merge = one.resolution.ties.front();
    frame.title +=
        ": " + std::to_string(merge.columnGroups.size()) + " x " + std::to_string(merge.rowGroups.size());
    return countsChart(std::move(frame), merged(one.counts, merge));
}

std::string sharesChart(ChartFrame frame, const std::string& groupsWords,
                        const std::vector<std::string>& groups,
                        const std::vector<const ChoiceSummary*>& summaries) {
    BarChart chart{std::move(frame), groupsWords, "chosen (%)", groups, {}};
    for (const ChoiceShare& share : summaries.front()->shares)
        chart.series.push_back({share.alternative, {}});
    for (std::size_t i = 0; i < summaries.size(); ++i)
        for (std::size_t s = 0; s < chart.series.size(); ++s) {
            const ChoiceShare& share = summaries[i]->shares[s];
            chart.series[s].bars.push_back(
                ChartValue{100.0 * share.share, 100.0 * share.least, 100.0 * share.most});
        }
    chart.most = 100.0;
    chart.reference = {100.0 / static_cast<double>(chart.series.size()), "chance"};
    return barChart(chart);
}

ChartValue scoreOf(const RatingSummary& summary, std::size_t scale) {
    return ChartValue::around(summary.means[scale], summary.halfIntervals[scale]);
}

std::string scoresChart(ChartFrame frame, const std::vector<std::string>& scales,
                        const std::vector<const RatingSummary*>& summaries) {
    BarChart chart{std::move(frame), "condition", "mean score (0 to 100)", {}, {}};
    for (const std::string& scale : scales) chart.series.push_back({scale, {}});
    for (const RatingSummary* const summary : summaries) {
        chart.groups.push_back(summary->condition);
        for (std::size_t s = 0; s < scales.size(); ++s) chart.series[s].bars.push_back(scoreOf(*summary, s));
    }
    chart.most = 100.0;
    return barChart(chart);
}

std::string barsChart(ChartFrame frame, const std::string& groupsWords, const std::string& valueWords,
                      const std::vector<std::pair<std::string, ChartValue>>& bars,
                      std::optional<double> most) {
    BarChart chart{std::move(frame), groupsWords, valueWords, {}, {{"", {}}}};
    for (const auto& [group, value] : bars) {
        chart.groups.push_back(group);
        chart.series.front().bars.emplace_back(value);
    }
    chart.most = most;
    return barChart(chart);
}

std::vector<std::string> levelCharts(std::span<const LevelSummary> summaries, bool isSimulated) {
    using Kind = LevelTrial::Kind;
    struct Words {
        Kind kind;
        const char *title, *value;
    };
    constexpr Words kinds[] = {{Kind::staircase, "Thresholds", "level (dB), mean of the later reversals"},
                               {Kind::adjustment, "Matched levels", "level (dB)"},
                               {Kind::magnitude, "Magnitudes", "geometric mean"},
                               {Kind::quest, "Thresholds by QUEST+", "level (dB)"}};
    std::vector<std::string> charts;
    for (const Words& words : kinds) {
        std::vector<std::pair<std::string, ChartValue>> bars;
        for (const LevelSummary& s : summaries)
            if (s.kind == words.kind)
                bars.emplace_back(
                    s.condition + (s.stimulus.empty() ? "" : ", " + s.stimulus),
                    ChartValue::around(s.estimate, s.kind == Kind::magnitude ? 0.0 : s.deviation));
        if (bars.empty()) continue;
        const ChartFrame frame{chartName(charts.size()), words.title, isSimulated};
        charts.push_back(barsChart(frame, "lines: one standard deviation", words.value, bars));
    }
    return charts;
}

std::vector<std::string> isolationCharts(std::span<const IsolationResult> results) {
    // axis, layer, frequency -> gammas of all voltages
    std::map<std::string, std::map<std::string, std::map<double, std::vector<double>>>> axes;
    std::map<std::string, std::size_t> styles;
    for (const IsolationResult& r : results) {
        const auto& c = r.condition;
        const std::string layer = c.material + (c.thickness.empty() ? "" : ", " + c.thickness + " mm");
        styles.try_emplace(layer, styles.size());
        axes[c.axis][layer][c.frequencyHz].push_back(r.mean);
    }
    std::vector<std::string> charts;
    for (const auto& [axis, layers] : axes) {
        LineChart chart{{chartName(charts.size()), "Isolation, axis " + axis},
                        "frequency (Hz)",
                        "gamma (Eq. 3.2), mean of voltages and repetitions",
                        {}};
        for (const auto& [layer, curve] : layers) {
            LineSeries series{layer, {}};
            series.style = styles.at(layer);
            for (const auto& [hz, gammas] : curve)
                series.points.push_back({hz, ChartValue::around(Moments(gammas).mean)});
            chart.series.push_back(std::move(series));
        }
        charts.push_back(lineChart(chart));
    }
    return charts;
}

} // namespace physvib
