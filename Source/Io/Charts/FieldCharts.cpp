// SPDX-License-Identifier: MIT
// Charts of a field as SVG: a matrix of shaded cells (confusion matrices, shares by place), and the response
// field (indicated places, normal ellipse of each target, map of the nearest target).
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

using namespace detail;

/// Colour from white (0) to dark blue (1); its lightness is monotonic, so it also works in greyscale.
std::string shade(double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    const auto mixedChannel = [t](double dark) {
        return std::to_string(static_cast<int>(std::lround(255.0 + t * (dark - 255.0))));
    };
    return "rgb(" + mixedChannel(0) + "," + mixedChannel(60) + "," + mixedChannel(120) + ")";
}

struct GridDrawing {
    const GridChart& chart;
    Svg& svg;
    PlotArea area;

    double cellWidth() const { return area.width() / static_cast<double>(chart.columns.size()); }
    double cellHeight() const { return area.height() / static_cast<double>(chart.rows.size()); }

    void cell(std::size_t row, std::size_t column) const {
        const auto& value = chart.values[row * chart.columns.size() + column];
        if (!value) return;
        const ChartPoint corner{area.left + cellWidth() * static_cast<double>(column),
                                area.top + cellHeight() * static_cast<double>(row)};
        const double share = *value / chart.max;
        if (share > 0.0) svg.rect(corner, cellWidth(), cellHeight(), shade(share));
        if (chart.framedBelow && *value < *chart.framedBelow)
            svg.rect({corner.x + 1.5, corner.y + 1.5}, cellWidth() - 3.0, cellHeight() - 3.0, "none",
                     {"#D55E00", 2.0, "4 3"});
        numbers(corner, row * chart.columns.size() + column, share > 0.5);
    }
    void numbers(ChartPoint corner, std::size_t index, bool isDark) const {
        const std::string label = fixedNumber(*chart.values[index], chart.decimals);
        if (textWidth(label, smallSize) > cellWidth() - 4.0 || cellHeight() < 13.0) return;
        const std::string_view colour = isDark ? "#fff" : "#111";
        svg.text({corner.x + 0.5 * cellWidth(), corner.y + 0.5 * cellHeight() + 4.0}, label,
                 {smallSize, Anchor::middle, 0.0, false, colour});
    }
    /// Draws the labels, only every n-th if not all fit.
    void labels() const {
        const auto rowStep = static_cast<std::size_t>(std::ceil(11.0 / cellHeight())),
                   columnStep = static_cast<std::size_t>(std::ceil(13.0 / cellWidth()));
        for (std::size_t r = 0; r < chart.rows.size(); r += rowStep)
            svg.text({area.left - 5.0, area.top + cellHeight() * (static_cast<double>(r) + 0.5) + 3.5},
                     chart.rows[r], {10.0, Anchor::end});
        for (std::size_t c = 0; c < chart.columns.size(); c += columnStep) {
            const double x = area.left + cellWidth() * (static_cast<double>(c) + 0.5);
            if (isTurned())
                svg.text({x + 3.5, area.bottom + 6.0}, chart.columns[c], {10.0, Anchor::end, -90.0});
            else
                svg.text({x, area.bottom + 14.0}, chart.columns[c], {10.0, Anchor::middle});
        }
    }
    bool isTurned() const { return maxTextWidth(chart.columns, 10.0) > cellWidth() - 2.0; }
};

} // namespace

std::string gridChart(const GridChart& chart) {
    const double titleBottom = titleHeight(chart.frame.title, chart.width);
    const double left = 26.0 + maxTextWidth(chart.rows, 10.0) + 6.0, right = chart.width - 10.0,
                 top = titleBottom + 6.0;
    const double cell = std::min((right - left) / static_cast<double>(chart.columns.size()), 64.0);
    const double height = chart.cellAspect * cell * static_cast<double>(chart.rows.size());
    const PlotArea area{left, top, left + cell * static_cast<double>(chart.columns.size()), top + height};
    const double below =
        maxTextWidth(chart.columns, 10.0) > cell - 2.0 ? maxTextWidth(chart.columns, 10.0) + 10.0 : 18.0;
    Svg svg{chart.frame, chart.width, area.bottom + below + 20.0};
    const GridDrawing drawing{chart, svg, area};
    for (std::size_t r = 0; r < chart.rows.size(); ++r)
        for (std::size_t c = 0; c < chart.columns.size(); ++c) drawing.cell(r, c);
    svg.rect({area.left, area.top}, area.width(), area.height(), "none", {"#222", 1.0});
    drawing.labels();
    svg.text({14.0, 0.5 * (area.top + area.bottom)}, chart.rowAxisLabel, {labelSize, Anchor::middle, -90.0});
    svg.text({0.5 * (area.left + area.right), area.bottom + below + 12.0}, chart.columnAxisLabel,
             {labelSize, Anchor::middle});
    return svg.finish();
}

namespace {

using namespace detail;

constexpr double fieldShape = 635.0 / 1230.0; // height by width of the thesis' tablet

struct PlaceDrawing {
    const PlaceChart& chart;
    Svg& svg;
    PlotArea area;

    ChartPoint toPixels(double x, double y) const {
        return {area.left + x * area.width(), area.top + y * area.height()};
    }
    /// Neighbours in a row and in a column have different styles.
    std::size_t style(std::size_t target) const {
        return (target % chart.columns + 3 * (target / chart.columns)) % 7;
    }

    /// Fills the area of each target, in runs of equal map points, and outlines it.
    void territory() const {
        if (chart.mapColumns == 0) return;
        const std::size_t rows = chart.territory.size() / chart.mapColumns;
        const double width = area.width() / static_cast<double>(chart.mapColumns),
                     height = area.height() / static_cast<double>(rows);
        std::vector<std::string> fills(chart.rows * chart.columns);
        std::string edges;
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < chart.mapColumns;) {
                const std::size_t target = chart.territory[r * chart.mapColumns + c], from = c;
                while (c < chart.mapColumns && chart.territory[r * chart.mapColumns + c] == target) ++c;
                const double x = area.left + width * static_cast<double>(from),
                             y = area.top + height * static_cast<double>(r),
                             runWidth = width * static_cast<double>(c - from);
                std::string& pathData = fills[target];
                move(pathData, x, y);
                step(pathData, 'h', runWidth);
                step(pathData, 'v', height);
                step(pathData, 'h', -runWidth);
                pathData += 'z';
                if (c < chart.mapColumns) {
                    move(edges, x + runWidth, y);
                    step(edges, 'v', height);
                }
            }
        for (std::size_t target = 0; target < fills.size(); ++target)
            if (!fills[target].empty())
                svg.path(fills[target], seriesColour(style(target)), {seriesColour(style(target)), 0.4});
        svg.path(edges + edgesBelow(rows, width, height), "none", {"#222", 0.7});
    }
    std::string edgesBelow(std::size_t rows, double width, double height) const {
        std::string pathData;
        for (std::size_t r = 1; r < rows; ++r)
            for (std::size_t c = 0; c < chart.mapColumns; ++c)
                if (chart.territory[r * chart.mapColumns + c] !=
                    chart.territory[(r - 1) * chart.mapColumns + c]) {
                    move(pathData, area.left + width * static_cast<double>(c),
                         area.top + height * static_cast<double>(r));
                    step(pathData, 'h', width);
                }
        return pathData;
    }
    static void move(std::string& pathData, double x, double y) { appendPoint(pathData, 'M', {x, y}); }
    static void step(std::string& pathData, char direction, double length) {
        (pathData += direction) += svgNumbers({length});
    }
    /// Draws places as thesis Fig. 4.6 does: the target's row gives the symbol (dot, x, cross, circle,
    /// asterisk), its column the colour (blue, black, red, cyan).
    void places() const {
        constexpr std::array shapes{"h0", "m-2 -2l4 4m0 -4l-4 4", "m-2.5 0h5m-2.5 -2.5v5",
                                    "m-2 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0",
                                    "m-2 -2l4 4m0 -4l-4 4m2 -4.8v5.6m-2.8 -2.8h5.6"};
        constexpr std::array<std::string_view, 4> colours{"#00f", "#000", "#f00", "#0cc"};
        std::vector<std::string> dots(chart.rows * chart.columns);
        for (const PlaceMark& mark : chart.places) {
            const ChartPoint point = toPixels(mark.x, mark.y);
            move(dots[mark.target], point.x, point.y);
            dots[mark.target] += shapes[mark.target / chart.columns % shapes.size()];
        }
        for (std::size_t target = 0; target < dots.size(); ++target)
            if (!dots[target].empty())
                svg.path(dots[target], "none",
                         {colours[target % chart.columns % colours.size()],
                          target / chart.columns % shapes.size() == 0 ? 2.0 : 0.8});
    }
    void ellipses() const {
        for (const PlaceEllipse& e : chart.ellipses) {
            const double widthPixels = area.width(), heightPixels = area.height(); // pixels per unit of x and
                                                                                   // y
            const double a = e.varianceX * widthPixels * widthPixels,
                         b = e.covariance * widthPixels * heightPixels,
                         c = e.varianceY * heightPixels * heightPixels;
            const double middle = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
            const double degrees = 0.5 * std::atan2(2.0 * b, a - c) * 180.0 / std::numbers::pi;
            svg.ellipse(toPixels(e.x, e.y), std::sqrt(middle + spread),
                        std::sqrt(std::max(0.0, middle - spread)), degrees, "none", {"#000", 1.3});
        }
    }
    void labels() const {
        for (const PlaceMark& mark : chart.labels) {
            const ChartPoint place = toPixels(mark.x, mark.y);
            const std::string label = std::to_string(mark.target / chart.columns + 1) + "," +
                                      std::to_string(mark.target % chart.columns + 1);
            svg.rect({place.x - 8.0, place.y - 6.0}, 16.0, 11.0, "#fff");
            svg.text({place.x, place.y + 3.0}, label, {8.5, Anchor::middle});
        }
    }
    /// Draws targets as crosses, with lines to the indicated places.
    void targets() const {
        for (const PlaceEllipse& e : chart.ellipses)
            if (e.target < chart.targets.size())
                svg.line(toPixels(chart.targets[e.target].first, chart.targets[e.target].second),
                         toPixels(e.x, e.y), {"#000", 0.8, "2 2"});
        std::string crosses;
        for (const auto& [x, y] : chart.targets) {
            const ChartPoint p = toPixels(x, y);
            move(crosses, p.x - 3.0, p.y);
            step(crosses, 'h', 6.0);
            move(crosses, p.x, p.y - 3.0);
            step(crosses, 'v', 6.0);
        }
        if (!crosses.empty()) svg.path(crosses, "none", {"#000", 1.2});
    }
};

} // namespace

std::string placeChart(const PlaceChart& chart) {
    const double titleBottom = titleHeight(chart.frame.title, chart.width);
    const double width = chart.width - 16.0;
    const PlotArea area{8.0, titleBottom, 8.0 + width, titleBottom + width * fieldShape};
    Svg svg{chart.frame, chart.width, area.bottom + 8.0};
    const PlaceDrawing drawing{chart, svg, area};
    drawing.territory();
    drawing.places();
    drawing.targets();
    drawing.ellipses();
    drawing.labels();
    svg.rect({area.left, area.top}, area.width(), area.height(), "none", {"#222", 1.0});
    return svg.finish();
}

} // namespace physvib
