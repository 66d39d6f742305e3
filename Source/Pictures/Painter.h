// SPDX-License-Identifier: MIT
// Fills and strokes outlines on an image, with smooth edges, by FreeType's rasteriser.
#pragma once
#include "Pictures/Image.h"
#include "Pictures/Path.h"
#include <memory>

namespace physvib::picture {

/// From `inner` at the centre to `outer` at `radius` and beyond.
struct RadialGradient {
    Spot centre;
    float radius = 1.0f;
    Colour inner, outer;
};

/// Paints on an image that outlives it. One thread at a time.
class Painter {
public:
    explicit Painter(Image& image);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    void setColour(Colour colour) noexcept { gradient_ = {{}, 1.0f, colour, colour}; }
    void setGradient(const RadialGradient& gradient) noexcept { gradient_ = gradient; }

    void fillAll(Colour colour);
    void fillPath(const Path& path, const Transform& move = {});
    /// A line of that width along the path, with mitred corners and flat ends.
    void strokePath(const Path& path, float width, const Transform& move = {});
    void fillRect(Box box);
    void fillEllipse(Box box);
    void fillRounded(Box box, float radius);
    void drawEllipse(Box box, float width);
    void drawRounded(Box box, float radius, float width);
    void drawLine(Spot from, Spot to, float width);
    void blend(int x, int y, Colour colour); ///< one pixel, whatever has been added as a transform

    /// Nothing is painted outside of it as well.
    void reduceClip(Area area) noexcept { clip_ = clip_.intersection(area); }

    /// The clip as it was, at the end of the block.
    class Saved {
    public:
        explicit Saved(Painter& painter) noexcept
            : painter_{painter}
            , clip_{painter.clip_} {}
        ~Saved() { painter_.clip_ = clip_; }
        Saved(const Saved&) = delete;
        Saved& operator=(const Saved&) = delete;

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

} // namespace physvib::picture
