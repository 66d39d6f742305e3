// SPDX-License-Identifier: MIT
// Outlines of lines and curves, and their affine transforms.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace physvib::picture {

// Points and rectangles of a picture, in pixels: x to the right, y downwards.

/// The nearest whole number. Any thread.
template <class Number>
int roundToInt(Number value) noexcept {
    return static_cast<int>(std::lround(value));
}

struct Spot {
    float x = 0.0f, y = 0.0f;

    float distanceTo(Spot other) const noexcept { return std::hypot(other.x - x, other.y - y); }
};

/// Its sides are parallel to those of the picture; width and height are never below 0. Any thread, all of it.
template <class T>
struct Rectangle {
    T x{}, y{}, width{}, height{};

    T right() const noexcept { return x + width; }
    T bottom() const noexcept { return y + height; }
    Spot centre() const noexcept {
        return {static_cast<float>(x) + 0.5f * static_cast<float>(width),
                static_cast<float>(y) + 0.5f * static_cast<float>(height)};
    }
    bool empty() const noexcept { return !(width > T{}) || !(height > T{}); }
    bool contains(Spot p) const noexcept {
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
    /// Moved, and made smaller if need be, so that `whole` holds it.
    Rectangle constrainedWithin(const Rectangle& whole) const noexcept {
        const T w = std::min(width, whole.width), h = std::min(height, whole.height);
        return {std::clamp(x, whole.x, whole.right() - w), std::clamp(y, whole.y, whole.bottom() - h), w, h};
    }

    /// Cuts a piece off, at most all of it, and returns that.
    Rectangle removeFromTop(T amount) noexcept {
        const Rectangle piece{x, y, width, std::min(amount, height)};
        y += piece.height, height -= piece.height;
        return piece;
    }
    Rectangle removeFromBottom(T amount) noexcept {
        const T taken = std::min(amount, height);
        height -= taken;
        return {x, y + height, width, taken};
    }
    Rectangle removeFromLeft(T amount) noexcept {
        const Rectangle piece{x, y, std::min(amount, width), height};
        x += piece.width, width -= piece.width;
        return piece;
    }
    Rectangle removeFromRight(T amount) noexcept {
        const T taken = std::min(amount, width);
        width -= taken;
        return {x + width, y, taken, height};
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
    Rectangle<int> touched() const noexcept {
        const auto left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
        return {left, top, static_cast<int>(std::ceil(right())) - left,
                static_cast<int>(std::ceil(bottom())) - top};
    }
};

using Area = Rectangle<int>;
using Box = Rectangle<float>;

inline Box boxAround(Spot centre, float width, float height) noexcept {
    return {centre.x - 0.5f * width, centre.y - 0.5f * height, width, height};
}

/// How points are moved: x' = xx x + xy y + dx, y' = yx x + yy y + dy. Any thread.
struct Transform {
    float xx = 1.0f, xy = 0.0f, yx = 0.0f, yy = 1.0f, dx = 0.0f, dy = 0.0f;

    /// Clockwise as one sees it, about the origin.
    static Transform rotation(float radians) noexcept {
        const float c = std::cos(radians), s = std::sin(radians);
        return {c, -s, s, c, 0.0f, 0.0f};
    }
    Transform translated(float x, float y) const noexcept { return {xx, xy, yx, yy, dx + x, dy + y}; }
    Transform translated(Spot by) const noexcept { return translated(by.x, by.y); }
    Transform scaled(float x, float y) const noexcept {
        return {x * xx, x * xy, y * yx, y * yy, x * dx, y * dy};
    }
    Transform followedBy(const Transform& n) const noexcept {
        return {n.xx * xx + n.xy * yx, n.xx * xy + n.xy * yy,        n.yx * xx + n.yy * yx,
                n.yx * xy + n.yy * yy, n.xx * dx + n.xy * dy + n.dx, n.yx * dx + n.yy * dy + n.dy};
    }
    Spot at(Spot p) const noexcept { return {xx * p.x + xy * p.y + dx, yx * p.x + yy * p.y + dy}; }
};

/// Filled, all of its parts are closed; overlaps count once. One thread at a time.
class Path {
public:
    enum class Kind { move, line, conic, cubic }; ///< with so many points: 1, 1, 2, 3
    struct Part {
        std::vector<Kind> steps;
        std::vector<Spot> points;
        bool isClosed = false;
    };

    void startNewSubPath(float x, float y) { parts_.push_back({{Kind::move}, {{x, y}}}); }
    void startNewSubPath(Spot p) { startNewSubPath(p.x, p.y); }
    void lineTo(float x, float y) { add(Kind::line, {{x, y}}); }
    void lineTo(Spot p) { lineTo(p.x, p.y); }
    void conicTo(Spot control, Spot end) { add(Kind::conic, {control, end}); }
    void cubicTo(Spot first, Spot second, Spot end) { add(Kind::cubic, {first, second, end}); }
    void closeSubPath() { parts_.back().isClosed = true; }
    void addRectangle(float x, float y, float width, float height);
    void addEllipse(float x, float y, float width, float height);
    void addRounded(Box box, float radius); ///< a rectangle with round corners

    bool empty() const noexcept { return parts_.empty(); }
    const std::vector<Part>& parts() const noexcept { return parts_; }
    void append(const Path& other) { parts_.insert(parts_.end(), other.parts_.begin(), other.parts_.end()); }
    void move(const Transform& by);

private:
    void add(Kind kind, std::initializer_list<Spot> points) {
        parts_.back().steps.push_back(kind);
        parts_.back().points.insert(parts_.back().points.end(), points);
    }
    std::vector<Part> parts_;
};

} // namespace physvib::picture
