// SPDX-License-Identifier: MIT
// Parts common to all charts: title, legend, axes. For the .cpp files of Charts.
#pragma once
#include "Io/Charts/ChartAxis.h"
#include "Io/Charts/Svg.h"
#include <string>
#include <vector>

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
    enum class Kind { bar, marker, dashes } kind = Kind::bar;
};

/// Height of a legend with rows of at most `width`.
double legendHeight(const std::vector<LegendItem>& items, double width);
void drawLegend(Svg& svg, const std::vector<LegendItem>& items, ChartPoint corner, double width);

/// Breaks text into lines of at most `width`. Any thread (allocates).
std::vector<std::string> wrapped(std::string_view words, double width, double size);

/// The title at the top, in lines, and the height that it takes.
double titleHeight(const std::string& title, double width);
void drawTitle(Svg& svg, const std::string& title, double width);

void drawValueAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words);
void drawAxisBelow(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words);

} // namespace physvib::detail
