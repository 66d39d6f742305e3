// SPDX-License-Identifier: MIT
// Draws panels, text and axes in the palette's style.
#include "Pictures/PictureCanvas.h"
#include <cmath>

namespace physvib::picture {
namespace {

/// As many letters of `words` as there is room for, and three dots.
std::string cut(const Letters& letters, std::string_view words, float height, bool bold, float room) {
    const auto start = [words](std::size_t bytes) { return std::string{words.substr(0, bytes)} + "..."; };
    std::size_t fits = 0, tooMany = words.size();
    while (tooMany - fits > 1) {
        const std::size_t half = (fits + tooMany) / 2;
        (letters.width(start(half), height, bold) <= room ? fits : tooMany) = half;
    }
    while (fits > 0 && (static_cast<unsigned char>(words[fits]) & 0xc0) == 0x80) --fits; // a letter is whole
    return fits > 0 ? start(fits) : std::string{};
}

} // namespace

void Canvas::text(std::string_view words, Area area, Align where, Colour colour, float height,
                  bool bold) const {
    std::string shown{words};
    const auto room = static_cast<float>(area.width);
    float width = letters.width(shown, height, bold);
    if (width > room)
        shown = cut(letters, words, height, bold, room), width = letters.width(shown, height, bold);
    const float share = where == Align::left ? 0.0f : where == Align::centre ? 0.5f : 1.0f;
    const float left = static_cast<float>(area.x) + share * (room - width),
                top = area.centre().y - 0.5f * height;
    graphics.setColour(colour);
    graphics.fillPath(letters.outline(shown, height, bold),
                      Transform{}.translated(left, std::round(top + letters.ascent(height, bold))));
}

int Canvas::textWidth(std::string_view words, float height, bool bold) const {
    return roundToInt(std::ceil(letters.width(words, height, bold))) + 1;
}

void Canvas::panel(Area area) const {
    graphics.setColour(palette::panel);
    graphics.fillRounded(area.toFloat(), 8.0f);
}

void Canvas::well(Area area) const {
    graphics.setColour(palette::well);
    graphics.fillRounded(area.toFloat(), 3.0f);
}

void Canvas::heading(std::string_view name, std::string_view remark, Area row) const {
    text(name, row, Align::left, palette::text, smallText, true);
    row.removeFromLeft(textWidth(name, smallText, true) + 24);
    text(remark, row, Align::right, palette::muted);
}

std::vector<double> ticks(double from, double to, int most) {
    if (!(to > from) || most < 1) return {from};
    double step = std::pow(10.0, std::floor(std::log10((to - from) / most)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
        if ((to - from) / (step * factor) <= most) {
            step *= factor;
            break;
        }
    const double slack = 1e-3 * (to - from); // less than a pixel or two: a tick at the edge stays
    std::vector<double> places;
    for (double i = std::ceil((from - slack) / step); i * step <= to + slack; ++i) places.push_back(i * step);
    return places;
}

float Axis::x(double value) const {
    const double share = to > from ? (value - from) / (to - from) : 0.0;
    return static_cast<float>(lane.x + share * lane.width);
}

void Axis::drawGrid(const Canvas& canvas, const std::vector<double>& places, Colour colour) const {
    canvas.graphics.setColour(colour);
    for (const double t : places)
        canvas.graphics.fillRect(
            {std::floor(x(t)), static_cast<float>(lane.y), 1.0f, static_cast<float>(lane.height)});
}

void Axis::drawLabels(const Canvas& canvas, const std::vector<double>& places, const std::string& unit,
                      Area row) const {
    const double step = places.size() > 1 ? places[1] - places[0] : 1.0;
    const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    for (const double t : places) {
        const auto words = number(t, decimals) + (t == places.back() ? " " + unit : std::string());
        const int width = canvas.textWidth(words, smallText) + 2;
        const int left = std::min(roundToInt(x(t)) - width / 2, row.right() - width);
        canvas.text(words, {left, row.y, width, row.height}, Align::centre, palette::muted);
    }
}

} // namespace physvib::picture
