// SPDX-License-Identifier: MIT
// Charts of study reports: data in, SVG text out.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// Common to every chart.
struct ChartFrame {
    std::string name;  ///< letters, digits, -; unique on the page
    std::string title; ///< describes the chart
    bool isSimulated = false;
};

/// A value with its interval.
struct ChartValue {
    double value = 0.0, least = 0.0, most = 0.0; ///< all equal: no interval is drawn

    static ChartValue around(double value, double halfInterval = 0.0) noexcept {
        return {value, value - halfInterval, value + halfInterval};
    }
};

struct BarSeries {
    std::string name;                            ///< empty in a chart of one series
    std::vector<std::optional<ChartValue>> bars; ///< one per group
};

struct BarChart {
    ChartFrame frame;
    std::string groupsWords, valueWords; ///< of the axes, with units
    std::vector<std::string> groups{};
    std::vector<BarSeries> series{};
    std::optional<std::pair<double, std::string>> reference{}; ///< a line across all groups, and its label
    std::vector<double> ceilings{};                            ///< per group: the maximum possible value
    std::string ceilingWords{};
    double least = 0.0;           ///< where bars begin; the axis begins lower if values do
    std::optional<double> most{}; ///< end of the axis; nullopt: from the values

    /// One more bar of a chart of one series.
    void add(std::string group, ChartValue value) {
        groups.push_back(std::move(group));
        series.resize(1);
        series.front().bars.emplace_back(value);
    }
};

struct LinePoint {
    double x = 0.0;
    ChartValue y{};
    double size = 1.0; ///< of the marker
};

struct LineSeries {
    std::string name; ///< empty: not in the legend
    std::vector<LinePoint> points{};
    bool isDrawnThrough = true, isMarked = true;
    bool isFaint = false; ///< thin and grey: one of many
    bool isThin = false;  ///< thin and without dashes: a waveform
    std::size_t style = 0;
};

struct LineChart {
    ChartFrame frame;
    std::string xWords, yWords;
    std::vector<LineSeries> series{};
    bool isLogarithmic = false; ///< both axes
    std::optional<std::pair<double, double>> xRange{}, yRange{};
    std::vector<std::pair<double, std::string>> references{}; ///< horizontal lines
    std::optional<ChartValue> threshold{};                    ///< a vertical line with its interval
    std::string thresholdWords{};
    double width = 680.0, height = 380.0;
};

struct GridChart {
    ChartFrame frame;
    std::string rowWords, columnWords;
    std::vector<std::string> rows{}, columns{};  ///< labels
    std::vector<std::optional<double>> values{}; ///< row by row
    std::vector<double> halfIntervals{};         ///< of the values; empty: none
    double most = 1.0;                           ///< value of the darkest shade
    int decimals = 0;                            ///< of the numbers in the cells
    std::optional<double> markedBelow{};         ///< cells below are framed
    double width = 330.0;
    double shape = 1.0; ///< of a cell: height / width
};

/// Where a stimulus was felt.
struct PlaceMark {
    std::size_t target = 0;  ///< row by row
    double x = 0.0, y = 0.0; ///< from 0 to 1, y downwards
};

struct PlaceEllipse {
    std::size_t target = 0;
    double x = 0.0, y = 0.0, varianceX = 0.0, varianceY = 0.0, covariance = 0.0;
};

struct PlaceChart {
    ChartFrame frame;
    std::size_t rows = 1, columns = 1;
    std::vector<PlaceMark> places{};
    std::vector<PlaceEllipse> ellipses{};             ///< of one standard deviation
    std::vector<std::pair<double, double>> targets{}; ///< row by row
    std::vector<PlaceMark> labels{};                  ///< "row,column" of the target
    std::vector<std::size_t> territory{}; ///< the target nearest to each point of a map, row by row
    std::size_t mapColumns = 0;
    double width = 335.0;
};

// Equal input gives equal bytes. Any thread (allocates).

std::string barChart(const BarChart& chart);
std::string lineChart(const LineChart& chart);
std::string gridChart(const GridChart& chart);
std::string placeChart(const PlaceChart& chart);

/// Charts as one picture: side by side where there is room, then in rows.
std::string chartSheet(const std::vector<std::string>& charts);

} // namespace physvib
