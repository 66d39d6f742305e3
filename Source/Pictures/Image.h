// SPDX-License-Identifier: MIT
// Geometry of a picture in pixels (points, rectangles, transforms, paths), colours, and an RGB image with its
// PNG encoding.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib::picture {

// Points and rectangles of a picture, in pixels: x to the right, y downwards.

/// The nearest whole number. Any thread.
template <class Number>
int roundToInt(Number value) noexcept {
    return static_cast<int>(std::lround(value));
}

struct Point {
    float x = 0.0f, y = 0.0f;

    float distanceTo(Point other) const noexcept { return std::hypot(other.x - x, other.y - y); }
};

/// A rectangle with sides parallel to the picture's; width and height are 0 or more. Any thread.
template <class T>
struct Rectangle {
    T x{}, y{}, width{}, height{};

    T right() const noexcept { return x + width; }
    T bottom() const noexcept { return y + height; }
    Point centre() const noexcept {
        return {static_cast<float>(x) + 0.5f * static_cast<float>(width),
                static_cast<float>(y) + 0.5f * static_cast<float>(height)};
    }
    bool empty() const noexcept { return !(width > T{}) || !(height > T{}); }
    bool contains(Point p) const noexcept {
        return p.x >= static_cast<float>(x) && p.y >= static_cast<float>(y) &&
               p.x < static_cast<float>(right()) && p.y < static_cast<float>(bottom());
    }

    Rectangle withY(T value) const noexcept { return {x, value, width, height}; }
    Rectangle withHeight(T value) const noexcept { return {x, y, width, value}; }
    Rectangle withLeft(T left) const noexcept { return {left, y, std::max(T{}, right() - left), height}; }
    Rectangle withRight(T end) const noexcept {
        return {std::min(x, end), y, std::max(T{}, end - x), height};
    }
    Rectangle withTrimmedLeft(T by) const noexcept { return withLeft(x + by); }
    Rectangle withTrimmedRight(T by) const noexcept { return {x, y, std::max(T{}, width - by), height}; }
    Rectangle withTrimmedTop(T by) const noexcept { return {x, y + by, width, std::max(T{}, height - by)}; }
    Rectangle withTrimmedBottom(T by) const noexcept { return {x, y, width, std::max(T{}, height - by)}; }
    Rectangle expanded(T dx, T dy) const noexcept {
        return {x - dx, y - dy, std::max(T{}, width + 2 * dx), std::max(T{}, height + 2 * dy)};
    }
    Rectangle expanded(T by) const noexcept { return expanded(by, by); }
    Rectangle reduced(T dx, T dy) const noexcept { return expanded(-dx, -dy); }
    Rectangle reduced(T by) const noexcept { return expanded(-by, -by); }
    Rectangle withSizeKeepingCentre(T newWidth, T newHeight) const noexcept {
        return {x + (width - newWidth) / 2, y + (height - newHeight) / 2, newWidth, newHeight};
    }
    Rectangle intersection(const Rectangle& other) const noexcept {
        const T left = std::max(x, other.x), top = std::max(y, other.y);
        return {left, top, std::max(T{}, std::min(right(), other.right()) - left),
                std::max(T{}, std::min(bottom(), other.bottom()) - top)};
    }
    /// This rectangle moved, and if necessary made smaller, so that `area` contains it.
    Rectangle constrainedWithin(const Rectangle& area) const noexcept {
        const T w = std::min(width, area.width), h = std::min(height, area.height);
        return {std::clamp(x, area.x, area.right() - w), std::clamp(y, area.y, area.bottom() - h), w, h};
    }

    /// Cuts off a strip of at most the whole size, and returns it.
    Rectangle removeFromTop(T amount) noexcept {
        const Rectangle removed{x, y, width, std::min(amount, height)};
        y += removed.height, height -= removed.height;
        return removed;
    }
    Rectangle removeFromBottom(T amount) noexcept {
        const T removed = std::min(amount, height);
        height -= removed;
        return {x, y + height, width, removed};
    }
    Rectangle removeFromLeft(T amount) noexcept {
        const Rectangle removed{x, y, std::min(amount, width), height};
        x += removed.width, width -= removed.width;
        return removed;
    }
    Rectangle removeFromRight(T amount) noexcept {
        const T removed = std::min(amount, width);
        width -= removed;
        return {x + width, y, removed, height};
    }

    Rectangle<float> toFloat() const noexcept {
        return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(width),
                static_cast<float>(height)};
    }
    /// Edges at the nearest whole pixels.
    Rectangle<int> rounded() const noexcept {
        const int left = roundToInt(x), top = roundToInt(y);
        return {left, top, roundToInt(right()) - left, roundToInt(bottom()) - top};
    }
    /// The whole pixels that it touches.
    Rectangle<int> outerPixels() const noexcept {
        const auto left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
        return {left, top, static_cast<int>(std::ceil(right())) - left,
                static_cast<int>(std::ceil(bottom())) - top};
    }
};

using Area = Rectangle<int>;
using Box = Rectangle<float>;

inline Box boxAround(Point centre, float width, float height) noexcept {
    return {centre.x - 0.5f * width, centre.y - 0.5f * height, width, height};
}

/// How points are moved: x' = xx x + xy y + dx, y' = yx x + yy y + dy. Any thread.
struct Transform {
    float xx = 1.0f, xy = 0.0f, yx = 0.0f, yy = 1.0f, dx = 0.0f, dy = 0.0f;

    /// Clockwise on the screen, about the origin.
    static Transform rotation(float radians) noexcept {
        const float c = std::cos(radians), s = std::sin(radians);
        return {c, -s, s, c, 0.0f, 0.0f};
    }
    Transform translated(float x, float y) const noexcept { return {xx, xy, yx, yy, dx + x, dy + y}; }
    Transform translated(Point by) const noexcept { return translated(by.x, by.y); }
    Transform scaled(float x, float y) const noexcept {
        return {x * xx, x * xy, y * yx, y * yy, x * dx, y * dy};
    }
    Transform followedBy(const Transform& n) const noexcept {
        return {n.xx * xx + n.xy * yx, n.xx * xy + n.xy * yy,        n.yx * xx + n.yy * yx,
                n.yx * xy + n.yy * yy, n.xx * dx + n.xy * dy + n.dx, n.yx * dx + n.yy * dy + n.dy};
    }
    Point apply(Point p) const noexcept { return {xx * p.x + xy * p.y + dx, yx * p.x + yy * p.y + dy}; }
};

/// An outline of lines and curves. Filling closes its parts; overlaps are filled once. One thread at a time.
class Path {
public:
    enum class Kind { move, line, conic, cubic }; ///< steps of 1, 1, 2 and 3 points
    struct Part {
        std::vector<Kind> steps;
        std::vector<Point> points;
        bool isClosed = false;
    };

    Path& startNewSubPath(float x, float y) { return startNewSubPath({x, y}); }
    Path& startNewSubPath(Point p) {
        parts_.push_back({{Kind::move}, {p}});
        return *this;
    }
    Path& lineTo(float x, float y) { return lineTo({x, y}); }
    Path& lineTo(Point p) { return add(Kind::line, {p}); }
    Path& conicTo(Point control, Point end) { return add(Kind::conic, {control, end}); }
    Path& cubicTo(Point first, Point second, Point end) { return add(Kind::cubic, {first, second, end}); }
    Path& closeSubPath() {
        parts_.back().isClosed = true;
        return *this;
    }
    Path& addRectangle(float x, float y, float width, float height);
    Path& addEllipse(float x, float y, float width, float height);
    Path& addRoundedRectangle(Box box, float radius); ///< a rectangle with round corners

    bool empty() const noexcept { return parts_.empty(); }
    const std::vector<Part>& parts() const noexcept { return parts_; }
    void append(const Path& other) { parts_.insert(parts_.end(), other.parts_.begin(), other.parts_.end()); }
    void move(const Transform& transform);

private:
    Path& add(Kind kind, std::initializer_list<Point> points) {
        parts_.back().steps.push_back(kind);
        parts_.back().points.insert(parts_.back().points.end(), points);
        return *this;
    }
    std::vector<Part> parts_;
};

// A colour of a picture.

/// Red, green, blue and opacity, each 0 to 255. Any thread.
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
    /// A darker colour of the same hue; `by`: 0 to 1.
    Colour withMultipliedBrightness(float by) const noexcept {
        const auto dark = [by](std::uint8_t part) { return byte(by * static_cast<float>(part) / 255.0f); };
        return {alpha, dark(red), dark(green), dark(blue)};
    }
    /// The mixture with `other`; `share`: 0, this colour, to 1, the other.
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
    /// Blends `colour` over a pixel, of which `coverage` (0 to 255) is covered.
    void blend(int x, int y, Colour colour, unsigned coverage = 255) noexcept {
        const int share = static_cast<int>(colour.alpha * coverage);
        std::uint8_t* p = rgb_.data() + index(x, y);
        const auto over = [share](std::uint8_t& below, int above) {
            const int change = (above - below) * share;
            below = static_cast<std::uint8_t>(below + (change + (change < 0 ? -32512 : 32512)) / 65025);
        };
        over(p[0], colour.red), over(p[1], colour.green), over(p[2], colour.blue);
    }

    /// The image as a PNG without a date, so that equal pixels give equal bytes.
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
