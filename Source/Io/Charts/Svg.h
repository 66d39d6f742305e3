// SPDX-License-Identifier: MIT
// Writer of SVG pictures as text, with equal bytes for equal input: no scripts, no external references, the
// reader's fonts.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace physvib {

/// Escapes `text` for HTML and SVG, between tags or in an attribute, and removes control characters. Any
/// thread.
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

constexpr std::size_t chartStyles = 8; ///< number of series styles: colour, hatch, marker and dash repeat
                                       ///< after these

/// Okabe and Ito's colours (2008), distinguishable for colour-blind readers; hatches, markers and dashes for
/// black-and-white print.
std::string_view seriesColour(std::size_t series) noexcept;
std::string_view seriesDash(std::size_t series) noexcept;

/// Estimated width of `text` in a generic sans-serif font, rather too large. Any thread.
double textWidth(std::string_view text, double size) noexcept;

/// A picture under construction. One thread at a time.
class Svg {
public:
    /// `name`: letters, digits and -, unique on the page: prefix of its element ids.
    Svg(std::string name, double width, double height);

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

    /// The complete element; with `isSimulated` a watermark over all of it. `words`: alternative text.
    std::string finish(std::string_view words, bool isSimulated) const;

private:
    void open(std::string_view tag);
    void attribute(std::string_view name, double value);
    void attribute(std::string_view name, std::string_view value);
    void stroked(const Stroke& stroke);

    std::string name_, body_;
    double width_, height_;
    unsigned hatches_ = 0; // one bit per series style whose hatch is used
};

/// Appends a number with at most two decimals; appendPoint: a path command with its point. Any thread.
void appendPixels(std::string& out, double pixels);
void appendPoint(std::string& out, char command, ChartPoint at);

} // namespace physvib
