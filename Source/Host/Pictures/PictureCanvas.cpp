// SPDX-License-Identifier: GPL-3.0-or-later
// Panels, words, numbers and axes in the look of the palette.
#include "Host/Pictures/PictureCanvas.h"
#include "Core/Limits.h"
#include <charconv>
#include <cmath>
#include <limits>

namespace physvib::picture {
namespace {

const juce::String minus = juce::String::charToString(0x2212);

juce::Font font(float height, bool bold) {
    return juce::Font(height, bold ? juce::Font::bold : juce::Font::plain);
}

juce::String grouped(juce::String digits) {
    const int whole = digits.containsChar('.') ? digits.indexOfChar('.') : digits.length();
    for (int at = whole - 3; at > 0; at -= 3) digits = digits.substring(0, at) + "," + digits.substring(at);
    return digits;
}

} // namespace

void Canvas::text(const juce::String& words, Area area, juce::Justification where, juce::Colour colour,
                  float height, bool bold) const {
    graphics.setFont(font(height, bold));
    graphics.setColour(colour);
    graphics.drawText(words, area, where, true);
}

void Canvas::panel(Area area) const {
    graphics.setColour(palette::panel);
    graphics.fillRoundedRectangle(area.toFloat(), 8.0f);
}

void Canvas::well(Area area) const {
    graphics.setColour(palette::well);
    graphics.fillRoundedRectangle(area.toFloat(), 3.0f);
}

void Canvas::heading(const juce::String& name, const juce::String& remark, Area row) const {
    text(name, row, juce::Justification::centredLeft, palette::text, smallText, true);
    row.removeFromLeft(textWidth(name, smallText, true) + 24);
    text(remark, row, juce::Justification::centredRight, palette::muted);
}

int textWidth(const juce::String& words, float height, bool bold) {
    return juce::roundToInt(std::ceil(font(height, bold).getStringWidthFloat(words))) + 1;
}

juce::String number(double value, int decimals) {
    if (!std::isfinite(value)) return value < 0.0 ? minus + juce::String::charToString(0x221e) : "?";
    char digits[400];
    const auto end =
        std::to_chars(digits, digits + sizeof(digits), std::abs(value), std::chars_format::fixed, decimals)
            .ptr;
    const juce::String magnitude(digits, static_cast<std::size_t>(end - digits));
    const bool negative = value < 0.0 && magnitude.containsAnyOf("123456789");
    return (negative ? minus : juce::String()) + grouped(magnitude);
}

juce::String shortNumber(double value) {
    const double magnitude = std::abs(value);
    const int decimals = magnitude >= 100.0 ? 0 : magnitude >= 10.0 ? 1 : magnitude >= 1.0 ? 2 : 3;
    const auto digits = number(value, decimals);
    return decimals == 0 ? digits : digits.trimCharactersAtEnd("0").trimCharactersAtEnd(".");
}

double decibels(double amplitude) {
    return amplitude == 0.0 ? -std::numeric_limits<double>::infinity()
                            : 20.0 * std::log10(std::abs(amplitude));
}

juce::String decibelText(double amplitude) {
    const bool isSilent = decibels(amplitude) < -limits::retireDecibels;
    return isSilent ? juce::String("silent") : number(decibels(amplitude), 1) + " dBFS";
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
    return static_cast<float>(lane.getX() + share * lane.getWidth());
}

void Axis::drawGrid(const Canvas& canvas, const std::vector<double>& places, juce::Colour colour) const {
    canvas.graphics.setColour(colour);
    for (const double t : places)
        canvas.graphics.fillRect(std::floor(x(t)), static_cast<float>(lane.getY()), 1.0f,
                                 static_cast<float>(lane.getHeight()));
}

void Axis::drawLabels(const Canvas& canvas, const std::vector<double>& places, const juce::String& unit,
                      Area row) const {
    const double step = places.size() > 1 ? places[1] - places[0] : 1.0;
    const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    for (const double t : places) {
        const auto words = number(t, decimals) + (t == places.back() ? " " + unit : juce::String());
        const int width = textWidth(words, smallText) + 2;
        const int left = std::min(juce::roundToInt(x(t)) - width / 2, row.getRight() - width);
        canvas.text(words, {left, row.getY(), width, row.getHeight()}, juce::Justification::centred,
                    palette::muted);
    }
}

} // namespace physvib::picture
