// SPDX-License-Identifier: MIT
// Line chart as SVG: lines and points with intervals, on linear or logarithmic axes.
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include <algorithm>
#include <limits>
#include <tuple>

namespace physvib {
namespace {

using namespace detail;

ChartAxis axisOf(bool isLogarithmic, const std::optional<std::pair<double, double>>& range, double least,
                 double most, int aboutTicks = 5) {
    if (range) std::tie(least, most) = *range;
    return isLogarithmic ? ChartAxis::logarithmic(least, most) : ChartAxis::around(least, most, aboutTicks);
}

struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
    void hold(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

std::vector<LegendItem> legendOf(const LineChart& chart) {
    std::vector<LegendItem> items;
    for (const LineSeries& series : chart.series)
        if (!series.name.empty())
            items.push_back({series.name, series.style,
                             series.isMarked ? LegendItem::Kind::marker : LegendItem::Kind::dashes});
    return items;
}

struct LineDrawing {
    const LineChart& chart;
    Svg& svg;
    PlotArea area;
    ChartAxis x, y;

    ChartPoint at(const LinePoint& point) const { return {area.x(x, point.x), area.y(y, point.y.value)}; }

    void through(const LineSeries& series) const {
        std::string d;
        for (const LinePoint& point : series.points) appendPoint(d, d.empty() ? 'M' : 'L', at(point));
        if (series.isFaint)
            svg.path(d, "none", {"#aaa", 0.8});
        else
            svg.path(d, "none", {seriesColour(series.style), 2.0, seriesDash(series.style)});
    }
    void draw(const LineSeries& series) const {
        if (series.points.empty()) return;
        if (series.isDrawnThrough) through(series);
        if (!series.isMarked) return;
        for (const LinePoint& point : series.points) {
            const ChartPoint place = at(point);
            if (point.y.least < point.y.most)
                svg.whisker({place.x, area.y(y, point.y.least)}, {place.x, area.y(y, point.y.most)},
                            {"#222", 1.2});
            svg.marker(place, series.style, 4.0 * point.size);
        }
    }
    void references() const {
        for (const auto& [value, words] : chart.references) {
            const double level = area.y(y, value);
            svg.line({area.left, level}, {area.right, level}, {"#000", 1.0, "6 4"});
            svg.text({area.right - 4.0, level - 4.0}, words, {smallSize, Anchor::end});
        }
    }
    void threshold() const {
        if (!chart.threshold) return;
        const double middle = area.x(x, chart.threshold->value);
        svg.line({middle, area.top}, {middle, area.bottom}, {"#000", 1.4, "3 3"});
        if (chart.threshold->least < chart.threshold->most) {
            const double from = std::max(area.left, area.x(x, chart.threshold->least)),
                         to = std::min(area.right, area.x(x, chart.threshold->most));
            svg.rect({from, area.top}, to - from, area.height(), "rgba(0,0,0,0.08)");
        }
        const bool isLeft = middle > 0.5 * (area.left + area.right);
        svg.text({middle + (isLeft ? -6.0 : 6.0), area.bottom - 8.0}, chart.thresholdWords,
                 {smallSize, isLeft ? Anchor::end : Anchor::start});
    }
};

} // namespace

std::string lineChart(const LineChart& chart) {
    Extent xs, ys;
    for (const LineSeries& series : chart.series)
        for (const LinePoint& point : series.points) {
            xs.hold(point.x);
            for (const double value : {point.y.value, point.y.least, point.y.most}) ys.hold(value);
        }
    const auto legend = legendOf(chart);
    const double left = 66.0, right = chart.width - 16.0;
    const double titleBottom = titleHeight(chart.frame.title, chart.width);
    const double top = titleBottom + legendHeight(legend, right - left) + 10.0;
    const PlotArea area{left, top, right, std::max(top + 160.0, chart.height - 48.0)};
    Svg svg{chart.frame.name, chart.width, area.bottom + 48.0};
    drawTitle(svg, chart.frame.title, chart.width);
    drawLegend(svg, legend, {left, titleBottom}, right - left);
    const LineDrawing drawing{chart, svg, area,
                              axisOf(chart.isLogarithmic, chart.xRange, xs.least, xs.most, 8),
                              axisOf(chart.isLogarithmic, chart.yRange, ys.least, ys.most)};
    drawValueAxis(svg, area, drawing.y, chart.yWords);
    drawAxisBelow(svg, area, drawing.x, chart.xWords);
    drawing.references();
    drawing.threshold();
    for (const LineSeries& series : chart.series) drawing.draw(series);
    return svg.finish(chart.frame.title, chart.frame.isSimulated);
}

} // namespace physvib
