// SPDX-License-Identifier: MIT
// Draws many impacts as accumulated light on one background.
#pragma once
#include "Pictures/PictureCanvas.h"
#include <algorithm>
#include <cmath>

namespace physvib::picture {

/// Light of all hits, summed before it is made visible, so that twenty thousand neither clip nor vanish.
class Light {
public:
    explicit Light(Area area)
        : area_(area)
        , rgb_(3 * static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height), 0.0f) {}

    void add(Spot centre, float radius, float strength, Colour colour) {
        if (!area_.toFloat().expanded(radius).contains(centre))
            return; // also what is too far away for whole numbers
        const Area seen = boxAround(centre, 2.0f * radius, 2.0f * radius).touched().intersection(area_);
        for (int y = seen.y; y < seen.bottom(); ++y)
            for (int x = seen.x; x < seen.right(); ++x) {
                const float dx = static_cast<float>(x) + 0.5f - centre.x,
                            dy = static_cast<float>(y) + 0.5f - centre.y;
                const float inside = 1.0f - (dx * dx + dy * dy) / (radius * radius);
                if (inside > 0.0f) addPixel(x, y, strength * inside * inside * inside, colour);
            }
    }

    // Exposed for the brightest place, then bent like film: 1 - exp(-light).
    void draw(Painter& g) const {
        const float brightest = rgb_.empty() ? 0.0f : *std::max_element(rgb_.begin(), rgb_.end());
        const float exposure = brightest > 2.0f ? 2.0f / brightest : 1.0f;
        if (area_.empty() || brightest <= 0.0f) return;
        for (int y = 0; y < area_.height; ++y)
            for (int x = 0; x < area_.width; ++x) g.blend(area_.x + x, area_.y + y, seen(x, y, exposure));
    }

private:
    std::size_t index(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(area_.width) +
                    static_cast<std::size_t>(x));
    }
    void addPixel(int x, int y, float light, Colour colour) {
        float* pixel = rgb_.data() + index(x - area_.x, y - area_.y);
        pixel[0] += light * static_cast<float>(colour.red) / 255.0f;
        pixel[1] += light * static_cast<float>(colour.green) / 255.0f;
        pixel[2] += light * static_cast<float>(colour.blue) / 255.0f;
    }
    Colour seen(int x, int y, float exposure) const {
        const float* pixel = rgb_.data() + index(x, y);
        const float most = std::max({pixel[0], pixel[1], pixel[2]});
        if (most <= 0.0f) return {};
        return Colour::of(pixel[0] / most, pixel[1] / most, pixel[2] / most,
                          1.0f - std::exp(-exposure * most));
    }

    Area area_;
    std::vector<float> rgb_;
};

} // namespace physvib::picture
