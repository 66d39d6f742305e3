// SPDX-License-Identifier: GPL-3.0-or-later
// The light of many hits on one ground.
#pragma once
#include "Host/Pictures/PictureCanvas.h"
#include <algorithm>
#include <cmath>

namespace physvib::picture {

/// Light of all hits, summed before it is made visible, so that twenty thousand neither clip nor vanish.
class Light {
public:
    explicit Light(juce::Rectangle<int> area)
        : area_(area)
        , rgb_(3 * static_cast<std::size_t>(area.getWidth()) * static_cast<std::size_t>(area.getHeight()),
               0.0f) {}

    void add(Spot centre, float radius, float strength, juce::Colour colour) {
        if (!area_.toFloat().expanded(radius).contains(centre)) return; // also what is too far away for whole numbers
        const auto reach = juce::Rectangle<float>(2.0f * radius, 2.0f * radius)
                               .withCentre(centre)
                               .getSmallestIntegerContainer();
        const auto seen = reach.getIntersection(area_);
        for (int y = seen.getY(); y < seen.getBottom(); ++y)
            for (int x = seen.getX(); x < seen.getRight(); ++x) {
                const float dx = static_cast<float>(x) + 0.5f - centre.x,
                            dy = static_cast<float>(y) + 0.5f - centre.y;
                const float inside = 1.0f - (dx * dx + dy * dy) / (radius * radius);
                if (inside > 0.0f) addPixel(x, y, strength * inside * inside * inside, colour);
            }
    }

    // Exposed for the brightest place, then bent like film: 1 - exp(-light).
    void draw(juce::Graphics& g) const {
        const float brightest = rgb_.empty() ? 0.0f : *std::max_element(rgb_.begin(), rgb_.end());
        const float exposure = brightest > 2.0f ? 2.0f / brightest : 1.0f;
        if (area_.isEmpty() || brightest <= 0.0f) return;
        juce::Image image(juce::Image::ARGB, area_.getWidth(), area_.getHeight(), true,
                          juce::SoftwareImageType());
        const juce::Image::BitmapData pixels(image, juce::Image::BitmapData::writeOnly);
        for (int y = 0; y < area_.getHeight(); ++y)
            for (int x = 0; x < area_.getWidth(); ++x) pixels.setPixelColour(x, y, seen(x, y, exposure));
        g.drawImageAt(image, area_.getX(), area_.getY());
    }

private:
    std::size_t index(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(area_.getWidth()) +
                    static_cast<std::size_t>(x));
    }
    void addPixel(int x, int y, float light, juce::Colour colour) {
        float* pixel = rgb_.data() + index(x - area_.getX(), y - area_.getY());
        pixel[0] += light * colour.getFloatRed();
        pixel[1] += light * colour.getFloatGreen();
        pixel[2] += light * colour.getFloatBlue();
    }
    juce::Colour seen(int x, int y, float exposure) const {
        const float* pixel = rgb_.data() + index(x, y);
        const float most = std::max({pixel[0], pixel[1], pixel[2]});
        if (most <= 0.0f) return {};
        return juce::Colour::fromFloatRGBA(pixel[0] / most, pixel[1] / most, pixel[2] / most,
                                           1.0f - std::exp(-exposure * most));
    }

    Area area_;
    std::vector<float> rgb_;
};

} // namespace physvib::picture
