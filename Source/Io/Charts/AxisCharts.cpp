// SPDX-License-Identifier: MIT
// Draws charts with axes as SVG: barChart() (groups of bars with intervals and ceilings) and lineChart()
// (lines and points on linear or logarithmic axes). Lengths are CSS pixels, chosen by eye.
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace physvib {
namespace {

using namespace detail;

constexpr double chartWidth = 680.0, plotHeight = 250.0, leftMargin = 66.0, narrowGroup = 30.0;

ChartAxis valueAxis(const BarChart& chart) {
    const double line = chart.reference ? chart.reference->first : chart.min;
    double min = std::min(chart.min, line), max = std::max(chart.min, line);
    for (const BarSeries& series : chart.series)
        for (const auto& bar : series.bars)
            if (bar) {
                min = std::min({min, bar->value, bar->min});
                max = std::max({max, bar->value, bar->max});
            }
    for (const double ceiling : chart.ceilings) max = std::max(max, ceiling);
    if (chart.max) max = std::max(*chart.max, max > *chart.max * 1.2 ? max : 0.0);
    return ChartAxis::linear(min, max, chart.min > 0.0 ? static_cast<int>(std::ceil(max - min)) : 5);
}

std::vector<LegendItem> legendItems(const BarChart& chart) {
    std::vector<LegendItem> items;
    for (std::size_t s = 0; s < chart.series.size(); ++s)
        if (!chart.series[s].name.empty()) items.push_back({chart.series[s].name, s, LegendItem::Kind::bar});
    return items;
}

struct BarDrawing {
    const BarChart& chart;
    Svg& svg;
    PlotArea area;
    ChartAxis axis;

    double groupWidth() const {
        return area.width() / static_cast<double>(std::max<std::size_t>(1, chart.groups.size()));
    }
    double middle(std::size_t group) const {
        return area.left + groupWidth() * (static_cast<double>(group) + 0.5);
    }

    void bars() const {
        const double width = std::min(44.0, 0.8 * groupWidth() / static_cast<double>(chart.series.size()));
        for (std::size_t s = 0; s < chart.series.size(); ++s)
            for (std::size_t g = 0; g < chart.series[s].bars.size(); ++g) {
                const auto& bar = chart.series[s].bars[g];
                if (!bar) continue;
                const double x = middle(g) + width * (static_cast<double>(s) -
                                                      0.5 * static_cast<double>(chart.series.size()));
                const double zero = area.y(axis, std::clamp(chart.min, axis.min, axis.max)),
                             y = area.y(axis, bar->value);
                svg.bar({x + 1.0, std::min(zero, y)}, width - 2.0, std::abs(zero - y), s);
                if (bar->min < bar->max)
                    svg.whisker({x + 0.5 * width, area.y(axis, bar->min)},
                                {x + 0.5 * width, area.y(axis, bar->max)}, {"#000", 1.4});
            }
    }
    void groupLabels(bool isTurned, bool isVertical) const {
        for (std::size_t g = 0; g < chart.groups.size(); ++g) {
            if (isVertical)
                svg.text({middle(g) + 4.0, area.bottom + 6.0}, chart.groups[g],
                         {smallSize, Anchor::end, -90.0});
            else if (isTurned)
                svg.text({middle(g) + 4.0, area.bottom + 14.0}, chart.groups[g],
                         {smallSize, Anchor::end, -35.0});
            else
                svg.text({middle(g), area.bottom + 16.0}, chart.groups[g], {labelSize, Anchor::middle});
        }
    }
    void ceilings() const {
        for (std::size_t g = 0; g < chart.ceilings.size(); ++g) {
            const double y = area.y(axis, chart.ceilings[g]), half = 0.45 * groupWidth();
            svg.line({middle(g) - half, y}, {middle(g) + half, y}, {"#000", 1.6, "2 3"});
            if (g == 0 && !chart.ceilingLabel.empty())
                svg.text({middle(g) - half, y - 5.0}, chart.ceilingLabel, {smallSize});
        }
    }
    void reference() const {
        if (!chart.reference) return;
        const double y = area.y(axis, chart.reference->first);
        svg.line({area.left, y}, {area.right, y}, {"#000", 1.2, "6 4"});
        svg.text({area.right + 4.0, y + 4.0}, chart.reference->second, {smallSize});
    }
};

} // namespace

std::string barChart(const BarChart& chart) {
    const auto legend = legendItems(chart);
    const double right = chart.reference ? chartWidth - 10.0 - textWidth(chart.reference->second, smallSize)
                                         : chartWidth - 14.0;
    const double maxTextWidth = detail::maxTextWidth(chart.groups, labelSize);
    const auto groups = static_cast<double>(std::max<std::size_t>(1, chart.groups.size()));
    const bool isTurned = maxTextWidth > 0.95 * (right - leftMargin) / groups;
    const double turnedEdge =
        isTurned ? std::max(leftMargin, 0.8 * textWidth(chart.groups.front(), smallSize) - 10.0) : leftMargin;
    const bool isVertical = isTurned && (right - turnedEdge) / groups < narrowGroup;
    const double labels = isVertical ? 14.0 + maxTextWidth : isTurned ? 18.0 + 0.60 * maxTextWidth : 22.0;
    const double leftEdge = isVertical ? leftMargin : turnedEdge;
    const double titleBottom = titleHeight(chart.frame.title, chartWidth);
    const double top = titleBottom + legendHeight(legend, right - leftEdge) + 8.0;
    const PlotArea area{leftEdge, top + 8.0, right, top + 8.0 + plotHeight};
    Svg svg{chart.frame, chartWidth, area.bottom + labels + 24.0};
    drawLegend(svg, legend, {leftEdge, titleBottom}, right - leftEdge);
    const BarDrawing drawing{chart, svg, area, valueAxis(chart)};
    drawYAxis(svg, area, drawing.axis, chart.valueAxisLabel);
    drawing.bars();
    const double zero = area.y(drawing.axis, std::clamp(chart.min, drawing.axis.min, drawing.axis.max));
    svg.line({area.left, zero}, {area.right, zero});
    drawing.ceilings();
    drawing.reference();
    drawing.groupLabels(isTurned, isVertical);
    svg.text({0.5 * (area.left + area.right), area.bottom + labels + 16.0}, chart.groupAxisLabel,
             {labelSize, Anchor::middle});
    return svg.finish();
}

namespace {

using namespace detail;

ChartAxis axisOf(bool isLogarithmic, const std::optional<std::pair<double, double>>& range, double min,
                 double max, int approximateTicks = 5) {
    if (range) std::tie(min, max) = *range;
    return isLogarithmic ? ChartAxis::logarithmic(min, max) : ChartAxis::linear(min, max, approximateTicks);
}

struct Extent {
    double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();
    void include(double value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

std::vector<LegendItem> legendItems(const LineChart& chart) {
    std::vector<LegendItem> items;
    for (const LineSeries& series : chart.series)
        if (!series.name.empty())
            items.push_back({series.name, series.style,
                             series.hasMarkers ? LegendItem::Kind::marker
                             : series.isThin   ? LegendItem::Kind::solid
                                               : LegendItem::Kind::dashes});
    return items;
}

struct LineDrawing {
    const LineChart& chart;
    Svg& svg;
    PlotArea area;
    ChartAxis x, y;

    ChartPoint toPixels(const LinePoint& point) const {
        return {area.x(x, point.x), area.y(y, point.y.value)};
    }

    void drawLine(const LineSeries& series) const {
        std::string pathData;
        for (const LinePoint& point : series.points)
            appendPoint(pathData, pathData.empty() ? 'M' : 'L', toPixels(point));
        if (series.isFaint)
            svg.path(pathData, "none", {"#aaa", 0.8});
        else
            svg.path(pathData, "none",
                     series.isThin ? Stroke{seriesColour(series.style), 1.0}
                                   : Stroke{seriesColour(series.style), 2.0, seriesDash(series.style)});
    }
    void draw(const LineSeries& series) const {
        if (series.points.empty()) return;
        if (series.hasLine) drawLine(series);
        if (!series.hasMarkers) return;
        for (const LinePoint& point : series.points) {
            const ChartPoint centre = toPixels(point);
            if (point.y.min < point.y.max)
                svg.whisker({centre.x, area.y(y, point.y.min)}, {centre.x, area.y(y, point.y.max)},
                            {"#222", 1.2});
            svg.marker(centre, series.style, 4.0 * point.size);
        }
    }
    void references() const {
        for (const auto& [value, label] : chart.references) {
            const double level = area.y(y, value);
            svg.line({area.left, level}, {area.right, level}, {"#000", 1.0, "6 4"});
            svg.text({area.right - 4.0, level - 4.0}, label, {smallSize, Anchor::end});
        }
    }
    void threshold() const {
        if (!chart.threshold) return;
        const double middle = area.x(x, chart.threshold->value);
        svg.line({middle, area.top}, {middle, area.bottom}, {"#000", 1.4, "3 3"});
        if (chart.threshold->min < chart.threshold->max) {
            const double from = std::max(area.left, area.x(x, chart.threshold->min)),
                         to = std::min(area.right, area.x(x, chart.threshold->max));
            svg.rect({from, area.top}, to - from, area.height(), "rgba(0,0,0,0.08)");
        }
        const bool isLeft = middle > 0.5 * (area.left + area.right);
        svg.text({middle + (isLeft ? -6.0 : 6.0), area.bottom - 8.0}, chart.thresholdLabel,
                 {smallSize, isLeft ? Anchor::end : Anchor::start});
    }
};

} // namespace

std::string lineChart(const LineChart& chart) {
    Extent xs, ys;
    for (const LineSeries& series : chart.series)
        for (const LinePoint& point : series.points) {
            xs.include(point.x);
            for (const double value : {point.y.value, point.y.min, point.y.max}) ys.include(value);
        }
    const auto legend = legendItems(chart);
    const double left = 66.0, right = chart.width - 16.0;
    const double titleBottom = titleHeight(chart.frame.title, chart.width);
    const double top = titleBottom + legendHeight(legend, right - left) + 10.0;
    const PlotArea area{left, top, right, std::max(top + 160.0, chart.height - 48.0)};
    Svg svg{chart.frame, chart.width, area.bottom + 48.0};
    drawLegend(svg, legend, {left, titleBottom}, right - left);
    const LineDrawing drawing{chart, svg, area, axisOf(chart.isLogarithmic, chart.xRange, xs.min, xs.max, 8),
                              axisOf(chart.isLogarithmic, chart.yRange, ys.min, ys.max)};
    drawYAxis(svg, area, drawing.y, chart.yLabel);
    drawXAxis(svg, area, drawing.x, chart.xLabel);
    drawing.references();
    drawing.threshold();
    for (const LineSeries& series : chart.series) drawing.draw(series);
    return svg.finish();
}

} // namespace physvib
