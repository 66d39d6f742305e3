// SPDX-License-Identifier: MIT
// Outline of a scene's shape for drawing, in pictures of renders and in views of a moving world.
#pragma once
#include "Scene/Scene.h"
#include <algorithm>
#include <variant>
#include <vector>

namespace physvib {

/// A path of JUCE or of our pictures, in pixels about the shape's own origin, y downwards; however small, it
/// stays visible. Any thread.
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

} // namespace physvib
