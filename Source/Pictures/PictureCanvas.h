// SPDX-License-Identifier: MIT
// Painter fills and strokes outlines on an image; Canvas adds panels, plot backgrounds and text; Axis, ticks.
#pragma once
#include "Io/Text/CleanText.h"
#include "Io/Text/ReadableNumber.h"
#include "Pictures/Image.h"
#include "Pictures/Letters.h"
#include "Pictures/Palette.h"
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace physvib::picture {

/// From `inner` at the centre to `outer` at `radius` and beyond.
struct RadialGradient {
    Point centre;
    float radius = 1.0f;
    Colour inner, outer;
};

/// Paints with smooth edges, by FreeType's rasteriser, on an image that outlives it. One thread at a time.
class Painter {
public:
    explicit Painter(Image& image);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    void setColour(Colour colour) noexcept { gradient_ = {{}, 1.0f, colour, colour}; }
    void setGradient(const RadialGradient& gradient) noexcept { gradient_ = gradient; }

    void fillAll(Colour colour);
    void fillPath(const Path& path, const Transform& transform = {});
    /// A line of that width along the path, with mitred corners and flat ends.
    void strokePath(const Path& path, float width, const Transform& transform = {});
    void fillRect(Box b) { fillPath(Path{}.addRectangle(b.x, b.y, b.width, b.height)); }
    void fillEllipse(Box b) { fillPath(Path{}.addEllipse(b.x, b.y, b.width, b.height)); }
    void fillRounded(Box box, float radius) { fillPath(Path{}.addRoundedRectangle(box, radius)); }
    void drawEllipse(Box b, float width) {
        strokePath(Path{}.addEllipse(b.x, b.y, b.width, b.height), width);
    }
    void drawRounded(Box box, float radius, float width) {
        strokePath(Path{}.addRoundedRectangle(box, radius), width);
    }
    void drawLine(Point from, Point to, float width) {
        strokePath(Path{}.startNewSubPath(from).lineTo(to), width);
    }
    void blend(int x, int y, Colour colour); ///< one pixel of the image

    /// Restricts painting to `area` within the present clip.
    void reduceClip(Area area) noexcept { clip_ = clip_.intersection(area); }

    /// Restores the painter's clip at the end of its scope.
    class ClipScope {
    public:
        explicit ClipScope(Painter& painter) noexcept
            : painter_{painter}
            , clip_{painter.clip_} {}
        ~ClipScope() { painter_.clip_ = clip_; }
        ClipScope(const ClipScope&) = delete;
        ClipScope& operator=(const ClipScope&) = delete;

    private:
        Painter& painter_;
        Area clip_;
    };

private:
    struct Raster;

    Image& image_;
    RadialGradient gradient_{};
    Area clip_;
    std::unique_ptr<Raster> raster_;
};

using namespace readable;

enum class Align { left, centre, right }; ///< horizontally; the height is centred

constexpr float smallText = 15.0f, mediumText = 18.0f, largeText = 29.0f;

/// Draws text, panels and headings; all areas are in whole pixels.
struct Canvas {
    Painter& graphics;
    const Letters& letters;

    /// One line, cut with an ellipsis if it is wider than `area`. The caller has cleaned it: cleanLine().
    void text(std::string_view words, Area area, Align align, Colour colour, float height = smallText,
              bool bold = false) const;
    int textWidth(std::string_view words, float height, bool bold = false) const {
        return roundToInt(std::ceil(letters.width(words, height, bold))) + 1;
    }
    void panel(Area area) const {
        graphics.setColour(palette::panel);
        graphics.fillRounded(area.toFloat(), 8.0f);
    }
    void well(Area area) const {
        graphics.setColour(palette::well);
        graphics.fillRounded(area.toFloat(), 3.0f);
    }
    /// The name of a part at the left of `row`, a remark at its right.
    void heading(std::string_view name, std::string_view remark, Area row) const {
        text(name, row, Align::left, palette::text, smallText, true);
        row.removeFromLeft(textWidth(name, smallText, true) + 24);
        text(remark, row, Align::right, palette::muted);
    }
};

/// Round values (1, 2 or 5 times a power of ten) between `from` and `to`, at most `maxCount` of them.
std::vector<double> ticks(double from, double to, int maxCount);

/// A horizontal axis and the lane above it.
struct Axis {
    double from = 0.0;
    double to = 0.0;
    Area lane;

    /// The place of `value`, in pixels from the image's left.
    float x(double value) const {
        const double share = to > from ? (value - from) / (to - from) : 0.0;
        return static_cast<float>(lane.x + share * lane.width);
    }
    void drawGrid(const Canvas& canvas, const std::vector<double>& places, Colour colour) const {
        canvas.graphics.setColour(colour);
        for (const double t : places)
            canvas.graphics.fillRect(
                {std::floor(x(t)), static_cast<float>(lane.y), 1.0f, static_cast<float>(lane.height)});
    }
    /// A number under each place, the last with the unit.
    void drawLabels(const Canvas& canvas, const std::vector<double>& places, const std::string& unit,
                    Area row) const;
};

} // namespace physvib::picture
