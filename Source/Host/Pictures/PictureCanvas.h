// SPDX-License-Identifier: GPL-3.0-or-later
// The look of a picture: panels, wells, words in three sizes, numbers with units, axes.
#pragma once
#include "Files/Text/CleanText.h"
#include "Host/Pictures/Palette.h"
#include <vector>

namespace physvib::picture {

using Area = juce::Rectangle<int>;
using Spot = juce::Point<float>;

/// Words from a file: JUCE reads beyond the end of what is no UTF-8.
inline juce::String wordsOf(const std::string& text) { return juce::String::fromUTF8(cleanLine(text).c_str()); }

constexpr float smallText = 15.0f;
constexpr float mediumText = 18.0f;
constexpr float largeText = 29.0f;

/// Draws the recurring parts; everything in whole pixels.
struct Canvas {
    juce::Graphics& graphics;

    /// One line, cut with an ellipsis if it is wider than `area`.
    void text(const juce::String& words, Area area, juce::Justification where, juce::Colour colour,
              float height = smallText, bool bold = false) const;
    void panel(Area area) const;
    void well(Area area) const;
    /// The name of a part at the left of `row`, a remark at its right.
    void heading(const juce::String& name, const juce::String& remark, Area row) const;
};

int textWidth(const juce::String& words, float height, bool bold = false);

/// Fixed notation with thousands separators and a true minus sign; the same in every locale.
juce::String number(double value, int decimals);
/// Three significant digits at most, no trailing zeros.
juce::String shortNumber(double value);
/// 20 log10 |x|, or minus infinity.
double decibels(double amplitude);
juce::String decibelText(double amplitude);

/// Round values (1, 2 or 5 times a power of ten) between `from` and `to`, at most `most` of them.
std::vector<double> ticks(double from, double to, int most);

/// A horizontal axis and the lane above it.
struct Axis {
    double from = 0.0;
    double to = 0.0;
    Area lane;

    float x(double value) const; ///< pixels from the image's left
    void drawGrid(const Canvas& canvas, const std::vector<double>& places, juce::Colour colour) const;
    /// A number under each place, the last with the unit.
    void drawLabels(const Canvas& canvas, const std::vector<double>& places, const juce::String& unit,
                    Area row) const;
};

} // namespace physvib::picture
