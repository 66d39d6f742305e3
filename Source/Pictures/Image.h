// SPDX-License-Identifier: MIT
// RGB image, and its PNG encoding.
#pragma once
#include "Pictures/Path.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib::picture {

// A colour of a picture.

/// Red, green, blue and opacity, each 0 to 255. Any thread, all of it.
struct Colour {
    std::uint8_t alpha = 0, red = 0, green = 0, blue = 0;

    static constexpr Colour of(std::uint32_t argb) noexcept {
        return {static_cast<std::uint8_t>(argb >> 24), static_cast<std::uint8_t>(argb >> 16),
                static_cast<std::uint8_t>(argb >> 8), static_cast<std::uint8_t>(argb)};
    }
    /// Each from 0 to 1.
    static Colour of(float red, float green, float blue, float alpha = 1.0f) noexcept {
        return {byte(alpha), byte(red), byte(green), byte(blue)};
    }
    /// Hue in turns, saturation and lightness from 0 to 1.
    static Colour ofHue(float hue, float saturation, float lightness) noexcept {
        const auto part = [&](float at) {
            const float k = std::fmod(at + 12.0f * hue, 12.0f);
            return lightness - saturation * std::min(lightness, 1.0f - lightness) *
                                   std::max(-1.0f, std::min({k - 3.0f, 9.0f - k, 1.0f}));
        };
        return of(part(0.0f), part(8.0f), part(4.0f));
    }

    constexpr std::uint32_t argb() const noexcept {
        return static_cast<std::uint32_t>(alpha) << 24 | static_cast<std::uint32_t>(red) << 16 |
               static_cast<std::uint32_t>(green) << 8 | blue;
    }
    Colour withAlpha(float value) const noexcept { return {byte(value), red, green, blue}; }
    /// `by` at most 1: darker, of the same hue.
    Colour withMultipliedBrightness(float by) const noexcept {
        const auto dark = [by](std::uint8_t part) { return byte(by * static_cast<float>(part) / 255.0f); };
        return {alpha, dark(red), dark(green), dark(blue)};
    }
    /// From this (0) to `other` (1).
    Colour mixedWith(Colour other, float share) const noexcept {
        const auto mix = [share](std::uint8_t from, std::uint8_t to) {
            return byte((static_cast<float>(from) + share * static_cast<float>(to - from)) / 255.0f);
        };
        return {mix(alpha, other.alpha), mix(red, other.red), mix(green, other.green), mix(blue, other.blue)};
    }
    friend constexpr bool operator==(const Colour&, const Colour&) = default;

private:
    static std::uint8_t byte(float share) noexcept {
        return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
    }
};

/// Opaque pixels, row by row from the top. One thread at a time.
class Image {
public:
    Image(int width, int height)
        : width_{width}
        , height_{height}
        , rgb_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }
    /// Red, green, blue of each pixel: 3 * width() bytes a row.
    const std::uint8_t* rgb() const noexcept { return rgb_.data(); }
    Area bounds() const noexcept { return {0, 0, width_, height_}; }
    Colour at(int x, int y) const noexcept {
        const std::uint8_t* p = rgb_.data() + index(x, y);
        return {255, p[0], p[1], p[2]};
    }
    /// Lays `colour` over a pixel, which `coverage` (0 to 255) of it reaches.
    void blend(int x, int y, Colour colour, unsigned coverage = 255) noexcept {
        const int share = static_cast<int>(colour.alpha * coverage);
        std::uint8_t* p = rgb_.data() + index(x, y);
        const auto over = [share](std::uint8_t& below, int above) {
            const int change = (above - below) * share;
            below = static_cast<std::uint8_t>(below + (change + (change < 0 ? -32512 : 32512)) / 65025);
        };
        over(p[0], colour.red), over(p[1], colour.green), over(p[2], colour.blue);
    }

    /// As a PNG: the same pixels, the same bytes; there is no clock in it.
    std::string png() const;

private:
    std::size_t index(int x, int y) const noexcept {
        return 3 *
               (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }

    int width_, height_;
    std::vector<std::uint8_t> rgb_;
};

} // namespace physvib::picture
