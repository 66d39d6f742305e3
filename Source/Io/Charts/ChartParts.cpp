// SPDX-License-Identifier: MIT
// Layout of legends, titles and axes by estimated text width.
#include "Io/Charts/ChartParts.h"
#include <algorithm>

namespace physvib::detail {
namespace {

constexpr double rowHeight = 18.0, keyWidth = 26.0, gap = 18.0;

double itemWidth(const LegendItem& item) { return keyWidth + textWidth(item.words, labelSize) + gap; }

/// Calls place(item, x, row) for each.
template <class Place>
std::size_t layOut(const std::vector<LegendItem>& items, double width, Place place) {
    double x = 0.0;
    std::size_t row = 0;
    for (const LegendItem& item : items) {
        const double wide = itemWidth(item);
        if (x > 0.0 && x + wide > width) {
            x = 0.0;
            ++row;
        }
        place(item, x, row);
        x += wide;
    }
    return items.empty() ? 0 : row + 1;
}

} // namespace

double legendHeight(const std::vector<LegendItem>& items, double width) {
    return rowHeight * static_cast<double>(layOut(items, width, [](const auto&, double, std::size_t) {}));
}

void drawLegend(Svg& svg, const std::vector<LegendItem>& items, ChartPoint corner, double width) {
    layOut(items, width, [&](const LegendItem& item, double x, std::size_t row) {
        const double left = corner.x + x, middle = corner.y + rowHeight * (static_cast<double>(row) + 0.5);
        if (item.kind == LegendItem::Kind::bar)
            svg.bar({left, middle - 6.0}, 20.0, 12.0, item.style);
        else
            svg.line({left, middle}, {left + 20.0, middle},
                     {seriesColour(item.style), 2.0, seriesDash(item.style)});
        if (item.kind == LegendItem::Kind::marker) svg.marker({left + 10.0, middle}, item.style);
        svg.text({left + keyWidth, middle + 4.0}, item.words, {labelSize});
    });
}

std::vector<std::string> wrapped(std::string_view words, double width, double size) {
    std::vector<std::string> lines;
    while (!words.empty()) {
        const std::string word{words.substr(0, words.find(' '))};
        words.remove_prefix(std::min(words.size(), word.size() + 1));
        if (!lines.empty() && textWidth(lines.back() + " " + word, size) <= width)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

double titleHeight(const std::string& title, double width) {
    return 8.0 + 18.0 * static_cast<double>(wrapped(title, width - 16.0, titleSize).size());
}

void drawTitle(Svg& svg, const std::string& title, double width) {
    double y = 0.0;
    for (const std::string& line : wrapped(title, width - 16.0, titleSize))
        svg.text({8.0, y += 18.0}, line, {titleSize, Anchor::start, 0.0, true});
}

void drawValueAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words) {
    double widest = 0.0;
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double y = area.y(axis, axis.ticks[i]);
        svg.line({area.left, y}, {area.right, y}, {"#ddd", 0.8});
        svg.line({area.left - 4.0, y}, {area.left, y});
        svg.text({area.left - 7.0, y + 4.0}, axis.tickWords[i], {smallSize, Anchor::end});
        widest = std::max(widest, textWidth(axis.tickWords[i], smallSize));
    }
    svg.line({area.left, area.top}, {area.left, area.bottom});
    svg.text({area.left - 14.0 - widest, 0.5 * (area.top + area.bottom)}, words,
             {labelSize, Anchor::middle, -90.0});
}

void drawAxisBelow(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& words) {
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double x = area.x(axis, axis.ticks[i]);
        svg.line({x, area.bottom}, {x, area.bottom + 4.0});
        svg.text({x, area.bottom + 17.0}, axis.tickWords[i], {smallSize, Anchor::middle});
    }
    svg.line({area.left, area.bottom}, {area.right, area.bottom});
    svg.text({0.5 * (area.left + area.right), area.bottom + 36.0}, words, {labelSize, Anchor::middle});
}

} // namespace physvib::detail
