// SPDX-License-Identifier: MIT
// Charts of study reports: data of bar, line, grid and place charts, and functions that return them as SVG.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// Name and title, which every chart has.
struct ChartFrame {
    std::string name;  ///< letters, digits, -; unique on the page
    std::string title; ///< describes the chart
    bool isSimulated = false;
};

/// A value with its interval.
struct ChartValue {
    double value = 0.0, min = 0.0, max = 0.0; ///< equal: no interval is drawn

    static ChartValue withMargin(double value, double halfInterval = 0.0) noexcept {
        return {value, value - halfInterval, value + halfInterval};
    }
};

struct BarSeries {
    std::string name;                            ///< empty in a chart of one series
    std::vector<std::optional<ChartValue>> bars; ///< one per group
};

struct BarChart {
    ChartFrame frame;
    std::string groupAxisLabel, valueAxisLabel; ///< with units
    std::vector<std::string> groups{};
    std::vector<BarSeries> series{};
    std::optional<std::pair<double, std::string>> reference{}; ///< a line across all groups, and its label
    std::vector<double> ceilings{};                            ///< per group: the maximum possible value
    std::string ceilingLabel{};
    double min = 0.0;            ///< start of the bars; the axis extends below it for lower values
    std::optional<double> max{}; ///< end of the axis; nullopt: from the values

    /// Adds a group with one bar to a chart of one series.
    void add(std::string group, ChartValue value) {
        groups.push_back(std::move(group));
        series.resize(1);
        series.front().bars.emplace_back(value);
    }
};

struct LinePoint {
    double x = 0.0;
    ChartValue y{};
    double size = 1.0; ///< factor on the marker's size
};

struct LineSeries {
    std::string name; ///< empty: not in the legend
    std::vector<LinePoint> points{};
    bool hasLine = true, hasMarkers = true;
    bool isFaint = false; ///< thin and grey: one of many
    bool isThin = false;  ///< thin and without dashes: a waveform
    std::size_t style = 0;
};

struct LineChart {
    ChartFrame frame;
    std::string xLabel, yLabel;
    std::vector<LineSeries> series{};
    bool isLogarithmic = false; ///< both axes
    std::optional<std::pair<double, double>> xRange{}, yRange{};
    std::vector<std::pair<double, std::string>> references{}; ///< horizontal lines
    std::optional<ChartValue> threshold{};                    ///< a vertical line with its interval
    std::string thresholdLabel{};
    double width = 680.0, height = 380.0;
};

struct GridChart {
    ChartFrame frame;
    std::string rowAxisLabel, columnAxisLabel;
    std::vector<std::string> rows{}, columns{};  ///< labels
    std::vector<std::optional<double>> values{}; ///< row by row
    double max = 1.0;                            ///< value of the darkest shade
    int decimals = 0;                            ///< of the numbers in the cells
    std::optional<double> framedBelow{};         ///< cells below are framed
    double width = 330.0;
    double cellAspect = 1.0; ///< height / width of a cell
};

/// A marked place of the response field, usually where a stimulus was felt.
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

// Each returns the chart as SVG text, equal bytes for equal input. Any thread (allocates).

std::string barChart(const BarChart& chart);
std::string lineChart(const LineChart& chart);
std::string gridChart(const GridChart& chart);
std::string placeChart(const PlaceChart& chart);

/// Combines charts in one picture: side by side as far as they fit, then in further rows.
std::string chartSheet(const std::vector<std::string>& charts);

} // namespace physvib
