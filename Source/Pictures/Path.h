// SPDX-License-Identifier: MIT
// Outlines of lines and curves, and their affine transforms.
#pragma once
#include "Pictures/Rectangle.h"
#include <cmath>
#include <vector>

namespace physvib::picture {

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
