// SPDX-License-Identifier: MIT
// RGB image, and its PNG encoding.
#pragma once
#include "Pictures/Colour.h"
#include "Pictures/Rectangle.h"
#include <string>
#include <vector>

namespace physvib::picture {

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
