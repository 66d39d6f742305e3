// SPDX-License-Identifier: MIT
// Rectangles and ellipses as outlines.
#include "Pictures/Path.h"

namespace physvib::picture {

namespace {
constexpr float quarter = 0.5522848f; // of a circle by a cubic: its handles, as a share of the radius
}

void Path::addRectangle(float x, float y, float width, float height) {
    startNewSubPath(x, y);
    for (const Spot corner : {Spot{x + width, y}, Spot{x + width, y + height}, Spot{x, y + height}})
        lineTo(corner);
    closeSubPath();
}

void Path::addEllipse(float x, float y, float width, float height) {
    const float a = 0.5f * width, b = 0.5f * height, cx = x + a, cy = y + b;
    startNewSubPath(cx + a, cy);
    cubicTo({cx + a, cy + quarter * b}, {cx + quarter * a, cy + b}, {cx, cy + b});
    cubicTo({cx - quarter * a, cy + b}, {cx - a, cy + quarter * b}, {cx - a, cy});
    cubicTo({cx - a, cy - quarter * b}, {cx - quarter * a, cy - b}, {cx, cy - b});
    cubicTo({cx + quarter * a, cy - b}, {cx + a, cy - quarter * b}, {cx + a, cy});
    closeSubPath();
}

void Path::addRounded(Box box, float radius) {
    const float r = std::min({radius, 0.5f * box.width, 0.5f * box.height}), k = (1.0f - quarter) * r;
    const float left = box.x, top = box.y, right = box.right(), bottom = box.bottom();
    startNewSubPath(left + r, top);
    lineTo(right - r, top);
    cubicTo({right - k, top}, {right, top + k}, {right, top + r});
    lineTo(right, bottom - r);
    cubicTo({right, bottom - k}, {right - k, bottom}, {right - r, bottom});
    lineTo(left + r, bottom);
    cubicTo({left + k, bottom}, {left, bottom - k}, {left, bottom - r});
    lineTo(left, top + r);
    cubicTo({left, top + k}, {left + k, top}, {left + r, top});
    closeSubPath();
}

void Path::move(const Transform& by) {
    for (Part& part : parts_)
        for (Spot& p : part.points) p = by.at(p);
}

} // namespace physvib::picture
