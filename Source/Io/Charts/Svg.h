// SPDX-License-Identifier: MIT
// Pictures as SVG text, the same bytes for the same input: no script, no network, fonts of the reader's own.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace physvib {

/// `text` between tags or in an attribute of HTML and SVG, whatever a file holds: no markup, no control
/// characters. Any thread.
std::string markup(std::string_view text);

struct ChartPoint {
    double x = 0.0, y = 0.0; ///< CSS pixels, y downwards
};

struct Stroke {
    std::string_view colour = "#222";
    double width = 1.0;
    std::string_view dash = {}; ///< "4 3"; empty: drawn through
};

enum class Anchor { start, middle, end };

struct TextStyle {
    double size = 12.0; ///< CSS pixels
    Anchor anchor = Anchor::start;
    double degrees = 0.0; ///< turned about its place, clockwise
    bool isBold = false;
    std::string_view colour = "#222";
};

constexpr std::size_t chartStyles = 8; ///< of series: colour, hatch, marker and dash repeat after so many

/// Okabe and Ito's colours (2008), which colour-blind readers tell apart; hatches, markers and dashes for
/// those who print in black and white.
std::string_view seriesColour(std::size_t series) noexcept;
std::string_view seriesDash(std::size_t series) noexcept;

/// About how wide `text` is in a generic sans-serif font, rather too wide. Any thread.
double textWidth(std::string_view text, double size) noexcept;

/// A picture on its way. One thread at a time.
class Svg {
public:
    /// `name`: letters, digits and - that no other picture of the page has: its parts are called after it.
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
    /// From `from` to `to` with feet, edged in white so that it shows on dark bars.
    void whisker(ChartPoint from, ChartPoint to, Stroke stroke = {});

    /// The whole element; with `isSimulated` a watermark over all of it. `words`: for those who cannot see
    /// it.
    std::string finish(std::string_view words, bool isSimulated) const;

private:
    void open(std::string_view tag);
    void attribute(std::string_view name, double value);
    void attribute(std::string_view name, std::string_view value);
    void stroked(const Stroke& stroke);

    std::string name_, body_;
    double width_, height_;
    unsigned hatches_ = 0; // a bit per series whose hatch is used
};

/// Appends with at most two decimals; a place after a path's command. Any thread.
void appendPixels(std::string& out, double pixels);
void appendPoint(std::string& out, char command, ChartPoint at);

} // namespace physvib
