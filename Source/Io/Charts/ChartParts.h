// SPDX-License-Identifier: MIT
// Parts common to all charts: numeric axes, an SVG writer with the styles of series, and the layout of title,
// legend and plot area. Included by the .cpp files of Charts.
#pragma once
#include "Io/Charts/Charts.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {
/// A chart's numeric axis: range, ticks and tick labels.
struct ChartAxis {
    double min = 0.0, max = 1.0;
    bool isLogarithmic = false;  ///< then `min` and `max` are above 0
    std::vector<double> ticks{}; ///< from low to high, within the range
    std::vector<std::string> tickLabels{};

    /// Position on the axis: 0 at `min`, 1 at `max`, beyond these outside of the range. Any thread.
    double share(double value) const noexcept {
        if (!isLogarithmic) return (value - min) / (max - min);
        return std::log(value / min) / std::log(max / min);
    }

    /// An axis with about `approximateTicks` ticks at multiples of 1, 2 or 5 times a power of ten, which
    /// covers `min` to `max`; a range without length is widened. Any thread (allocates).
    static ChartAxis linear(double min, double max, int approximateTicks = 5) {
        if (!(max - min > 1e-12 * std::max(std::abs(min), std::abs(max)))) {
            const double spread = std::max(1.0, std::abs(min) * 0.1);
            min -= spread;
            max += spread;
        }
        const double rawStep = (max - min) / approximateTicks,
                     power = std::pow(10.0, std::floor(std::log10(rawStep)));
        const double step = rawStep <= power * 1.0001   ? power
                            : rawStep <= 2.0001 * power ? 2.0 * power
                            : rawStep <= 5.0001 * power ? 5.0 * power
                                                        : 10.0 * power;
        const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step * 1.0001))), 0, 9);
        const double first = std::floor(min / step + 1e-9), last = std::ceil(max / step - 1e-9);
        ChartAxis axis{first * step, last * step};
        for (double k = first; k <= last + 0.5; ++k) {
            axis.ticks.push_back(k * step);
            axis.tickLabels.push_back(fixedNumber(k * step, decimals));
        }
        return axis;
    }
    /// A logarithmic axis, with ticks at 1, 2 and 5 and a margin of 15 % at both ends.
    static ChartAxis logarithmic(double min, double max) {
        ChartAxis axis{min / 1.15, max * 1.15, true, {}};
        const bool isWide = axis.max / axis.min > 300.0; // ticks at powers of ten only
        for (int power = static_cast<int>(std::floor(std::log10(axis.min)));
             power <= static_cast<int>(std::ceil(std::log10(axis.max))); ++power)
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double tick = digit * std::pow(10.0, power);
                if (tick < axis.min || tick > axis.max || (isWide && digit != 1.0)) continue;
                axis.ticks.push_back(tick);
                axis.tickLabels.push_back(fixedNumber(tick, std::max(0, -power)));
            }
        return axis;
    }
};

/// Escapes `text` for HTML and SVG, also for attributes, and removes control characters. Any thread.
std::string escapeXml(std::string_view text);

struct ChartPoint {
    double x = 0.0, y = 0.0; ///< CSS pixels, y downwards
};

struct Stroke {
    std::string_view colour = "#222";
    double width = 1.0;
    std::string_view dash = {}; ///< "4 3"; empty: solid
};

enum class Anchor { start, middle, end };

struct TextStyle {
    double size = 12.0; ///< CSS pixels
    Anchor anchor = Anchor::start;
    double degrees = 0.0; ///< turned about its place, clockwise
    bool isBold = false;
    std::string_view colour = "#222";
};

constexpr std::size_t chartStyles = 8; ///< number of styles, which repeat for more series

/// Okabe and Ito's colours (2008), for colour-blind readers; dashes, hatches and markers for print without
/// colour.
std::string_view seriesColour(std::size_t series) noexcept;
std::string_view seriesDash(std::size_t series) noexcept;

/// Estimated width of `text` in pixels for a sans-serif font of that size, rather too large. Any thread.
double textWidth(std::string_view text, double size) noexcept;

/// Writes one SVG picture, equal bytes for equal input, without scripts or external files. One thread at a
/// time.
class Svg {
public:
    /// Begins a drawing with the frame's title at its top.
    Svg(ChartFrame frame, double width, double height);

    void line(ChartPoint from, ChartPoint to, Stroke stroke = {});
    void rect(ChartPoint corner, double width, double height, std::string_view fill,
              Stroke stroke = {"none"});
    /// `commands`: SVG path data (attribute d).
    void path(std::string_view commands, std::string_view fill, Stroke stroke = {});
    void ellipse(ChartPoint centre, double radiusX, double radiusY, double degrees, std::string_view fill,
                 Stroke stroke = {});
    void text(ChartPoint point, std::string_view label, TextStyle style = {});
    /// Draws a bar with the series' colour and hatch.
    void bar(ChartPoint corner, double width, double height, std::size_t series);
    /// Draws the series' symbol: circle, square, triangle...
    void marker(ChartPoint point, std::size_t series, double radius = 4.0);
    /// An interval with end ticks, edged in white so that it is visible on dark bars.
    void whisker(ChartPoint from, ChartPoint to, Stroke stroke = {});

    /// The complete svg element; charts of simulated data have a watermark.
    std::string finish() const;

private:
    void openTag(std::string_view tag,
                 std::initializer_list<std::pair<std::string_view, double>> numbers = {});
    void attribute(std::string_view name, std::string_view value);
    void closeTag(const Stroke& stroke, std::string_view moreAttributes = {});

    ChartFrame frame_;
    double width_, height_;
    std::string body_;
    unsigned hatches_ = 0; // one bit per series style whose hatch is used
};

/// The numbers with at most two decimals, separated by spaces. Any thread, as appendPoint().
std::string svgNumbers(std::initializer_list<double> numbers);
/// Appends a path command and its point to SVG path data.
void appendPoint(std::string& out, char command, ChartPoint point);
} // namespace physvib
namespace physvib::detail {
/// The rectangle between the axes.
struct PlotArea {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
    double width() const noexcept { return right - left; }
    double height() const noexcept { return bottom - top; }
    double y(const ChartAxis& axis, double value) const noexcept {
        return bottom - axis.share(value) * height();
    }
    double x(const ChartAxis& axis, double value) const noexcept {
        return left + axis.share(value) * width();
    }
};

constexpr double titleSize = 14.0, labelSize = 12.0, smallSize = 11.0;

/// An entry of the legend and how it is drawn.
struct LegendItem {
    std::string label;
    std::size_t style = 0;
    enum class Kind { bar, marker, dashes, solid } kind = Kind::bar;
};

/// Height in pixels of a legend with rows of at most `width`.
double legendHeight(const std::vector<LegendItem>& items, double width);
void drawLegend(Svg& svg, const std::vector<LegendItem>& items, ChartPoint corner, double width);

/// Breaks text into lines of at most `width`. Any thread (allocates).
std::vector<std::string> wrapText(std::string_view label, double width, double size);

/// Height of the title in pixels, by its number of lines.
double titleHeight(const std::string& title, double width);

/// Width of the widest label in pixels. Any thread.
double maxTextWidth(const std::vector<std::string>& labels, double size) noexcept;

void drawYAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& label);
void drawXAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& label);
} // namespace physvib::detail
