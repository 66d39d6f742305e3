// SPDX-License-Identifier: MIT
// Outline of a scene's shape for drawing, in pictures of renders and in views of a moving world.
#pragma once
#include "Scene/Scene.h"
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace physvib {
/// A path of JUCE or of our pictures, in pixels about its own origin, y down, never too small. Any thread.
template <class Path>
Path shapeOutline(const Shape& shape, double pixelsPerMetre) {
    Path path;
    const auto px = [=](double metres) { return static_cast<float>(metres * pixelsPerMetre); };
    const auto follow = [&](const std::vector<Vector>& vertices, bool closed) {
        path.startNewSubPath(px(vertices.front().x), -px(vertices.front().y));
        for (const auto& v : vertices) path.lineTo(px(v.x), -px(v.y));
        if (closed) path.closeSubPath();
    };
    if (const auto* circle = std::get_if<CircleShape>(&shape)) {
        const float r = std::max(px(circle->radiusMetres), 1.5f);
        path.addEllipse(-r, -r, 2.0f * r, 2.0f * r);
    } else if (const auto* box = std::get_if<BoxShape>(&shape)) {
        const float w = std::max(px(box->widthMetres), 2.0f), h = std::max(px(box->heightMetres), 2.0f);
        path.addRectangle(-0.5f * w, -0.5f * h, w, h);
    } else if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
        follow(polygon->verticesMetres, true);
    } else {
        const auto& chain = std::get<ChainShape>(shape);
        follow(chain.verticesMetres, chain.isLoop);
    }
    return path;
}

// Outline of a scene's joint for drawing, in pictures of renders and in views of a moving world.

/// A line with turns between straight ends. Any thread.
template <class Path, class Point>
Path coilOutline(Point from, Point to, float width, int turns) {
    const float x = to.x - from.x, y = to.y - from.y, length = std::max(1e-3f, std::hypot(x, y));
    Path path;
    path.startNewSubPath(from.x, from.y);
    for (int k = 0; k < 2 * turns; ++k) {
        const float along =
                        0.15f + 0.7f * (static_cast<float>(k) + 0.5f) / (2.0f * static_cast<float>(turns)),
                    across = (k % 2 == 0 ? width : -width) / length;
        path.lineTo(from.x + along * x - across * y, from.y + along * y + across * x);
    }
    path.lineTo(to.x, to.y);
    return path;
}

inline constexpr float jointPixels = 1.6f; ///< line width of jointOutline

/// Lines to be stroked, between the points of a JointPose in pixels. Any thread.
template <class Path, class Point>
Path jointOutline(const Joint& joint, Point a, Point b) {
    Path path;
    const auto ring = [&path](Point centre, float radius) {
        path.addEllipse(centre.x - radius, centre.y - radius, 2.0f * radius, 2.0f * radius);
    };
    const auto line = [&path](Point from, Point to) {
        path.startNewSubPath(from.x, from.y);
        path.lineTo(to.x, to.y);
    };
    constexpr float dot = 1.5f, axle = 6.0f, motor = 8.5f;
    if (const auto* rod = std::get_if<DistanceJoint>(&joint)) {
        if (rod->springHz > 0.0 && !rod->isSlack)
            path = coilOutline<Path>(a, b, 6.0f, 6);
        else
            line(a, b);
        ring(b, dot);
    } else if (std::holds_alternative<SliderJoint>(joint))
        line(a, b);
    else
        ring(a, axle);
    std::visit(
        [&](const auto& kind) {
            if constexpr (requires { kind.maxTorqueNewtonMetres; })
                if (kind.maxTorqueNewtonMetres > 0.0) ring(a, motor);
        },
        joint);
    ring(a, dot);
    return path;
}

} // namespace physvib
