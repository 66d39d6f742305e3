// SPDX-License-Identifier: MIT
// A colour of a picture.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib::picture {

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

} // namespace physvib::picture
