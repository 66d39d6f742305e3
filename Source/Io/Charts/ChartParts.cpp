// SPDX-License-Identifier: MIT
// Draws the common parts of charts: legends, titles and axes, laid out by estimated text width; the SVG
// writer with the styles of series; and the sheet of several charts. Lengths are CSS pixels.
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace physvib::detail {
namespace {

constexpr double rowHeight = 18.0, keyWidth = 26.0, gap = 18.0;

double itemWidth(const LegendItem& item) { return keyWidth + textWidth(item.label, labelSize) + gap; }

/// Breaks the legend into rows of `width`; calls placeItem(item, x, row) for each item. Returns the rows.
template <class PlaceItem>
std::size_t layOut(const std::vector<LegendItem>& items, double width, PlaceItem placeItem) {
    double x = 0.0;
    std::size_t row = 0;
    for (const LegendItem& item : items) {
        const double itemSpan = itemWidth(item);
        if (x > 0.0 && x + itemSpan > width) {
            x = 0.0;
            ++row;
        }
        placeItem(item, x, row);
        x += itemSpan;
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
                     {seriesColour(item.style), 2.0,
                      item.kind == LegendItem::Kind::solid ? std::string_view{} : seriesDash(item.style)});
        if (item.kind == LegendItem::Kind::marker) svg.marker({left + 10.0, middle}, item.style);
        svg.text({left + keyWidth, middle + 4.0}, item.label, {labelSize});
    });
}

std::vector<std::string> wrapText(std::string_view label, double width, double size) {
    std::vector<std::string> lines;
    while (!label.empty()) {
        const std::string word{label.substr(0, label.find(' '))};
        label.remove_prefix(std::min(label.size(), word.size() + 1));
        if (!lines.empty() && textWidth(lines.back() + " " + word, size) <= width)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

double titleHeight(const std::string& title, double width) {
    return 8.0 + 18.0 * static_cast<double>(wrapText(title, width - 16.0, titleSize).size());
}

double maxTextWidth(const std::vector<std::string>& labels, double size) noexcept {
    double max = 0.0;
    for (const std::string& label : labels) max = std::max(max, textWidth(label, size));
    return max;
}

void drawYAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& label) {
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double y = area.y(axis, axis.ticks[i]);
        svg.line({area.left, y}, {area.right, y}, {"#ddd", 0.8});
        svg.line({area.left - 4.0, y}, {area.left, y});
        svg.text({area.left - 7.0, y + 4.0}, axis.tickLabels[i], {smallSize, Anchor::end});
    }
    svg.line({area.left, area.top}, {area.left, area.bottom});
    svg.text({area.left - 14.0 - maxTextWidth(axis.tickLabels, smallSize), 0.5 * (area.top + area.bottom)},
             label, {labelSize, Anchor::middle, -90.0});
}

void drawXAxis(Svg& svg, const PlotArea& area, const ChartAxis& axis, const std::string& label) {
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double x = area.x(axis, axis.ticks[i]);
        svg.line({x, area.bottom}, {x, area.bottom + 4.0});
        svg.text({x, area.bottom + 17.0}, axis.tickLabels[i], {smallSize, Anchor::middle});
    }
    svg.line({area.left, area.bottom}, {area.right, area.bottom});
    svg.text({0.5 * (area.left + area.right), area.bottom + 36.0}, label, {labelSize, Anchor::middle});
}
} // namespace physvib::detail

namespace physvib {
namespace {

struct SeriesStyle {
    std::string_view colour, dash, hatch; // hatch: white lines on the colour, a path in a tile of 8 x 8
    double hatchWidth;
};
constexpr SeriesStyle styles[chartStyles]{{"#0072B2", "", "", 0.0},
                                          {"#E69F00", "7 3", "M-2 10L10 -2M-2 2L2 -2M6 10L10 6", 1.6},
                                          {"#009E73", "2 3", "M2 2h0.01M6 6h0.01", 2.6},
                                          {"#CC79A7", "9 3 2 3", "M-2 -2L10 10M-2 6L2 10M6 -2L10 2", 1.6},
                                          {"#D55E00", "12 4", "M0 4H8", 1.8},
                                          {"#56B4E9", "4 4", "M4 0V8", 1.8},
                                          {"#F0E442", "1 5", "M0 4H8M4 0V8", 1.4},
                                          {"#000000", "14 3 3 3", "M-2 10L10 -2M-2 -2L10 10", 1.2}};

constexpr std::string_view svgBegin = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 ";

const std::string background = "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";

std::string svgHead(double width, double height) {
    return std::string{svgBegin} + svgNumbers({width, height}) + "\" width=\"" + svgNumbers({width}) +
           "\" height=\"" + svgNumbers({height}) + "\" font-family=\"Helvetica, Arial, sans-serif\">\n";
}

/// Width and height of a picture, read from the text that svgHead() wrote.
ChartPoint pictureSize(std::string_view svg) {
    svg.remove_prefix(svgBegin.size());
    const std::string_view width = takeUntil(' ', svg), height = takeUntil('"', svg);
    return {parseNumber<double>(width).value_or(0.0), parseNumber<double>(height).value_or(0.0)};
}

} // namespace

std::string escapeXml(std::string_view text) {
    std::string out;
    for (const char c : cleanLine(text)) {
        switch (c) {
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '&': out += "&amp;"; break;
        case '"': out += "&quot;"; break;
        case '\'': out += "&#39;"; break;
        default: out += c;
        }
    }
    return out;
}

std::string_view seriesColour(std::size_t series) noexcept { return styles[series % chartStyles].colour; }

std::string_view seriesDash(std::size_t series) noexcept { return styles[series % chartStyles].dash; }

double textWidth(std::string_view text, double size) noexcept {
    double ems = 0.0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0) == 0x80) continue; // a continuation byte of UTF-8
        if (byte >= 'A' && byte <= 'Z')
            ems += 0.70;
        else
            ems += std::string_view{" .,:;|ilj1'()-"}.find(c) != std::string_view::npos ? 0.38 : 0.58;
    }
    return ems * size;
}

std::string svgNumbers(std::initializer_list<double> numbers) {
    std::string all;
    for (const double number : numbers) {
        std::string text = fixedNumber(number, 2);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) text.pop_back();
        if (!all.empty()) all += ' ';
        all += text.empty() || text == "-0" ? "0" : text;
    }
    return all;
}

void appendPoint(std::string& out, char command, ChartPoint point) {
    (out += command) += svgNumbers({point.x, point.y});
}

Svg::Svg(ChartFrame frame, double width, double height)
    : frame_{std::move(frame)}
    , width_{width}
    , height_{height} {
    double y = 0.0;
    for (const std::string& line : detail::wrapText(frame_.title, width - 16.0, detail::titleSize))
        text({8.0, y += 18.0}, line, {detail::titleSize, Anchor::start, 0.0, true});
}

void Svg::openTag(std::string_view tag, std::initializer_list<std::pair<std::string_view, double>> numbers) {
    body_.append("<").append(tag);
    for (const auto& [name, value] : numbers) attribute(name, svgNumbers({value}));
}

void Svg::attribute(std::string_view name, std::string_view value) {
    body_.append(" ").append(name).append("=\"").append(value).append("\"");
}

void Svg::closeTag(const Stroke& stroke, std::string_view moreAttributes) {
    if (stroke.colour != "none") {
        attribute("stroke", stroke.colour);
        if (stroke.width != 1.0) attribute("stroke-width", svgNumbers({stroke.width}));
        if (!stroke.dash.empty()) attribute("stroke-dasharray", stroke.dash);
        body_ += moreAttributes;
    }
    body_ += "/>\n";
}

void Svg::line(ChartPoint from, ChartPoint to, Stroke stroke) {
    openTag("line", {{"x1", from.x}, {"y1", from.y}, {"x2", to.x}, {"y2", to.y}});
    closeTag(stroke);
}

void Svg::rect(ChartPoint corner, double width, double height, std::string_view fill, Stroke stroke) {
    openTag("rect", {{"x", corner.x}, {"y", corner.y}, {"width", width}, {"height", height}});
    attribute("fill", fill);
    closeTag(stroke);
}

void Svg::path(std::string_view commands, std::string_view fill, Stroke stroke) {
    openTag("path");
    attribute("d", commands);
    attribute("fill", fill);
    closeTag(stroke, " stroke-linecap=\"round\" stroke-linejoin=\"round\"");
}

void Svg::ellipse(ChartPoint centre, double radiusX, double radiusY, double degrees, std::string_view fill,
                  Stroke stroke) {
    openTag("ellipse", {{"rx", radiusX}, {"ry", radiusY}});
    attribute("transform",
              "translate(" + svgNumbers({centre.x, centre.y}) + ") rotate(" + svgNumbers({degrees}) + ")");
    attribute("fill", fill);
    closeTag(stroke);
}

void Svg::text(ChartPoint point, std::string_view label, TextStyle style) {
    constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
    openTag("text", {{"x", point.x}, {"y", point.y}, {"font-size", style.size}});
    if (style.anchor != Anchor::start)
        attribute("text-anchor", anchors[static_cast<std::size_t>(style.anchor)]);
    if (style.isBold) attribute("font-weight", "bold");
    attribute("fill", style.colour);
    if (style.degrees != 0.0)
        attribute("transform", "rotate(" + svgNumbers({style.degrees, point.x, point.y}) + ")");
    body_.append(">").append(escapeXml(label)).append("</text>\n");
}

void Svg::bar(ChartPoint corner, double width, double height, std::size_t series) {
    const std::size_t style = series % chartStyles;
    rect(corner, width, height, styles[style].colour, {"#222", 0.8});
    if (styles[style].hatch.empty()) return;
    hatches_ |= 1u << style;
    rect(corner, width, height, "url(#" + frame_.name + "-h" + std::to_string(style) + ")");
}

void Svg::marker(ChartPoint point, std::size_t series, double radius) {
    const std::size_t style = series % chartStyles;
    const auto polygon = [&](std::initializer_list<ChartPoint> corners) {
        std::string pathData;
        for (const ChartPoint& corner : corners)
            appendPoint(pathData, pathData.empty() ? 'M' : 'L',
                        {point.x + radius * corner.x, point.y + radius * corner.y});
        path(pathData + "Z", styles[style].colour, {"#222", 0.8});
    };
    switch (style) {
    case 1: return polygon({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case 2: return polygon({{0, -1.2}, {1.1, 0.9}, {-1.1, 0.9}});
    case 3: return polygon({{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}});
    case 4: return polygon({{0, 1.2}, {1.1, -0.9}, {-1.1, -0.9}});
    case 5:
        return polygon({{-0.4, -1.2},
                        {0.4, -1.2},
                        {0.4, -0.4},
                        {1.2, -0.4},
                        {1.2, 0.4},
                        {0.4, 0.4},
                        {0.4, 1.2},
                        {-0.4, 1.2},
                        {-0.4, 0.4},
                        {-1.2, 0.4},
                        {-1.2, -0.4},
                        {-0.4, -0.4}});
    case 6: return polygon({{0, -1.3}, {1.2, -0.4}, {0.75, 1.0}, {-0.75, 1.0}, {-1.2, -0.4}});
    case 7: return polygon({{-1.2, -0.6}, {1.2, -0.6}, {1.2, 0.6}, {-1.2, 0.6}});
    default: ellipse(point, radius, radius, 0.0, styles[style].colour, {"#222", 0.8});
    }
}

void Svg::whisker(ChartPoint from, ChartPoint to, Stroke stroke) {
    constexpr double halfTickLength = 3.5;
    line(from, to, {"#fff", stroke.width + 2.0});
    line(from, to, stroke);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length == 0.0) return;
    const double x = halfTickLength * (to.y - from.y) / length, y = halfTickLength * (to.x - from.x) / length;
    for (const ChartPoint& end : {from, to}) line({end.x - x, end.y + y}, {end.x + x, end.y - y}, stroke);
}

std::string Svg::finish() const {
    std::string out = svgHead(width_, height_) + "<title>" + escapeXml(frame_.title) +
                      (frame_.isSimulated ? " (simulated)" : "") + "</title>\n";
    if (hatches_ != 0) {
        out += "<defs>";
        for (std::size_t style = 0; style < chartStyles; ++style) {
            if ((hatches_ >> style & 1u) == 0) continue;
            out += "<pattern id=\"" + frame_.name + "-h" + std::to_string(style) +
                   "\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\"><path d=\"" +
                   std::string(styles[style].hatch) +
                   "\" stroke=\"#fff\" stroke-linecap=\"round\" fill=\"none\" stroke-width=\"" +
                   svgNumbers({styles[style].hatchWidth}) + "\"/></pattern>";
        }
        out += "</defs>\n";
    }
    out += background + body_;
    if (frame_.isSimulated) {
        const double size = 0.8 * std::hypot(width_, height_) / textWidth("SIMULATED", 1.0);
        out += "<text font-weight=\"bold\" fill=\"#b00020\" fill-opacity=\"0.1\" text-anchor=\"middle\" "
               "font-size=\"" +
               svgNumbers({size}) + "\" transform=\"translate(" + svgNumbers({0.5 * width_, 0.5 * height_}) +
               ") rotate(" + svgNumbers({-57.2957795 * std::atan2(height_, width_)}) +
               ")\" dy=\"0.35em\">SIMULATED</text>\n";
    }
    return out + "</svg>\n";
}

std::string chartSheet(const std::vector<std::string>& charts) {
    constexpr double maxWidth = 1340.0; // four place or grid charts, or one bar chart
    if (charts.size() == 1) return charts.front();
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0; // y and height are those of the current row
    std::string body;
    for (const std::string& chart : charts) {
        const ChartPoint size = pictureSize(chart);
        if (x > 0.0 && x + size.x > maxWidth) {
            y += height;
            x = height = 0.0;
        }
        body += "<g transform=\"translate(" + svgNumbers({x, y}) + ")\">\n" + chart + "</g>\n";
        x += size.x;
        width = std::max(width, x);
        height = std::max(height, size.y);
    }
    return svgHead(width, y + height) + background + body + "</svg>\n";
}
} // namespace physvib
