// SPDX-License-Identifier: MIT
// Parts common to all charts: SVG, title, legend, axes. For the .cpp files of Charts.
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

// A chart's numeric axis: range, ticks and tick labels.

namespace physvib {
struct ChartAxis {
    double least = 0.0, most = 1.0;
    bool isLogarithmic = false;  ///< then both > 0
    std::vector<double> ticks{}; ///< from low to high, within the range
    std::vector<std::string> tickWords{};

    /// From 0 at `least` to 1 at `most`; other values lie outside of that. Any thread.
    double share(double value) const noexcept {
        if (!isLogarithmic) return (value - least) / (most - least);
        return std::log(value / least) / std::log(most / least);
    }

    /// An axis with round ticks that covers `least` to `most`; equal ends are spread. Any thread (allocates).
    static ChartAxis around(double least, double most, int aboutTicks = 5) {
        if (!(most - least > 1e-12 * std::max(std::abs(least), std::abs(most)))) {
            const double spread = std::max(1.0, std::abs(least) * 0.1);
            least -= spread;
            most += spread;
        }
        const double raw = (most - least) / aboutTicks, power = std::pow(10.0, std::floor(std::log10(raw)));
        const double step = raw <= power * 1.0001   ? power
                            : raw <= 2.0001 * power ? 2.0 * power
                            : raw <= 5.0001 * power ? 5.0 * power
                                                    : 10.0 * power;
        const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step * 1.0001))), 0, 9);
        const double first = std::floor(least / step + 1e-9), last = std::ceil(most / step - 1e-9);
        ChartAxis axis{first * step, last * step};
        for (double k = first; k <= last + 0.5; ++k) {
            axis.ticks.push_back(k * step);
            axis.tickWords.push_back(fixedNumber(k * step, decimals));
        }
        return axis;
    }
    static ChartAxis logarithmic(double least, double most) { // with a margin of 15 % at both ends
        ChartAxis axis{least / 1.15, most * 1.15, true, {}};
        const bool isWide = axis.most / axis.least > 300.0; // then ticks at powers of ten only
        for (int power = static_cast<int>(std::floor(std::log10(axis.least)));
             power <= static_cast<int>(std::ceil(std::log10(axis.most))); ++power)
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double tick = digit * std::pow(10.0, power);
                if (tick < axis.least || tick > axis.most || (isWide && digit != 1.0)) continue;
                axis.ticks.push_back(tick);
                axis.tickWords.push_back(fixedNumber(tick, std::max(0, -power)));
            }
        return axis;
    }
};

// Writes SVG pictures, equal bytes for equal input: no scripts, no external references, the reader's fonts.

/// Escapes `text` for HTML and SVG, also for attributes, and removes control characters. Any thread.
std::string markup(std::string_view text);

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

constexpr std::size_t chartStyles = 8; ///< of series: colour, hatch, marker and dash repeat after these

/// Okabe and Ito's colours (2008), distinguishable for colour-blind readers; hatches, markers and dashes for
/// black-and-white print.
std::string_view seriesColour(std::size_t series) noexcept;
std::string_view seriesDash(std::size_t series) noexcept;

/// Estimated width of `text` in a generic sans-serif font, rather too large. Any thread.
double textWidth(std::string_view text, double size) noexcept;

/// A picture under construction. One thread at a time.
class Svg {
public:
    /// Has the title at its top.
    Svg(ChartFrame frame, double width, double height);

    void line(ChartPoint from, ChartPoint to, Stroke stroke = {});
    void rect(ChartPoint corner, double width, double height, std::string_view fill,
              Stroke stroke = {"none"});
    /// `commands`: a path's d.
    void path(std::string_view commands, std::string_view fill, Stroke stroke = {});
    void ellipse(ChartPoint centre, double radiusX, double radiusY, double degrees, std::string_view fill,
                 Stroke stroke = {});
    void text(ChartPoint at, std::string_view words, TextStyle style = {});
    /// Filled in the series' colour and hatch.
    void bar(ChartPoint corner, double width, double height, std::size_t series);
    /// Circle, square, triangle ...: the series'.
    void marker(ChartPoint at, std::size_t series, double radius = 4.0);
    /// An interval with end ticks, edged in white so that it is visible on dark bars.
    void whisker(ChartPoint from, ChartPoint to, Stroke stroke = {});

    /// The complete element; what is simulated has a watermark over all of it.
    std::string finish() const;

private:
    void open(std::string_view tag, std::initializer_list<std::pair<std::string_view, double>> numbers = {});
    void attribute(std::string_view name, std::string_view value);
    void close(const Stroke& stroke, std::string_view ofStroke = {});

    ChartFrame frame_;
    double width_, height_;
    std::string body_;
    unsigned hatches_ = 0; // one bit per series style whose hatch is used
};

/// Numbers with at most two decimals, and spaces between; appendPoint: a path command with its point. Any
/// thread.
std::string pixels(std::initializer_list<double> numbers);
void appendPoint(std::string& out, char command, ChartPoint at);
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
    std::string words;
    std::size_t style = 0;
    enum class Kind { bar, marker, dashes, solid } kind = Kind::bar;
};

/// Height of a legend with rows of at most `width`.
double legendHeight(const std::vector<LegendItem>& items, double width);
void drawLegend(Svg& svg, const std::vector<LegendItem>& items, ChartPoint corner, double width);

/// Breaks text into lines of at most `width`. Any thread (allocates).
std::vector<std::string> wrapped(std::string_view words, double width, double size);

/// Height of the title in pixels, by its number of lines.
double titleHeight(const std::string& title, double width);

/// The widest of these. Any thread.
double widest(const std::vector<std::string>& labels, double size) noexcept;

void drawValueAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words);
void drawAxisBelow(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words);
} // namespace physvib::detail
