// SPDX-License-Identifier: MIT
// Common elements of a picture: panels, plot backgrounds, text in three sizes, axes.
#pragma once
#include "Io/Text/CleanText.h"
#include "Io/Text/ReadableNumber.h"
#include "Pictures/Letters.h"
#include "Pictures/Painter.h"
#include "Pictures/Palette.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib::picture {

using namespace readable;

enum class Align { left, centre, right }; ///< in the middle of its height

constexpr float smallText = 15.0f;
constexpr float mediumText = 18.0f;
constexpr float largeText = 29.0f;

/// Draws the recurring parts; everything in whole pixels.
struct Canvas {
    Painter& graphics;
    const Letters& letters;

    /// One line, cut with an ellipsis if it is wider than `area`. Words are clean: cleanLine().
    void text(std::string_view words, Area area, Align where, Colour colour, float height = smallText,
              bool bold = false) const;
    int textWidth(std::string_view words, float height, bool bold = false) const;
    void panel(Area area) const;
    void well(Area area) const;
    /// The name of a part at the left of `row`, a remark at its right.
    void heading(std::string_view name, std::string_view remark, Area row) const;
};

/// Round values (1, 2 or 5 times a power of ten) between `from` and `to`, at most `most` of them.
std::vector<double> ticks(double from, double to, int most);

/// A horizontal axis and the lane above it.
struct Axis {
    double from = 0.0;
    double to = 0.0;
    Area lane;

    float x(double value) const; ///< pixels from the image's left
    void drawGrid(const Canvas& canvas, const std::vector<double>& places, Colour colour) const;
    /// A number under each place, the last with the unit.
    void drawLabels(const Canvas& canvas, const std::vector<double>& places, const std::string& unit,
                    Area row) const;
};

} // namespace physvib::picture
