// SPDX-License-Identifier: MIT
// Computes area, inertia and sizes by sums over the edges of outlines.
#include "Scene/World/ShapeGeometry.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace physvib {

namespace {

Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }
double length(const Vector& a) { return std::hypot(a.x, a.y); }

const Vector& after(const std::vector<Vector>& outline, std::size_t i) {
    return outline[i + 1 < outline.size() ? i + 1 : 0];
}

/// How far `point` is to the left of the line from `from` to `to`.
double leftOf(const Vector& point, const Vector& from, const Vector& to) {
    return cross(to - from, point - from) / length(to - from);
}

ShapeMoments moments(const CircleShape& c) {
    const double square = c.radiusMetres * c.radiusMetres;
    return {std::numbers::pi * c.radiusMetres * c.radiusMetres, {}, square / 2.0};
}
ShapeMoments moments(const BoxShape& b) {
    const double squares = b.widthMetres * b.widthMetres + b.heightMetres * b.heightMetres;
    return {b.widthMetres * b.heightMetres, {}, squares / 12.0};
}
ShapeMoments moments(const ChainShape&) { return {}; }

// Triangles from the first vertex, so that an outline far from the origin loses no precision.
ShapeMoments moments(const PolygonShape& p) {
    const auto& v = p.verticesMetres;
    double twiceArea = 0.0, second = 0.0;
    Vector first;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
        const Vector a = v[i] - v[0], b = v[i + 1] - v[0];
        const double twice = cross(a, b);
        twiceArea += twice;
        first.x += twice * (a.x + b.x);
        first.y += twice * (a.y + b.y);
        second += twice * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    if (!(twiceArea > 0.0)) return {};
    const Vector centre{first.x / (3.0 * twiceArea), first.y / (3.0 * twiceArea)};
    return {twiceArea / 2.0,
            {v[0].x + centre.x, v[0].y + centre.y},
            second / (6.0 * twiceArea) - dot(centre, centre)};
}

double thickness(const CircleShape& c) { return 2.0 * c.radiusMetres; }
double thickness(const BoxShape& b) { return std::min(b.widthMetres, b.heightMetres); }
double thickness(const ChainShape&) { return 0.0; }
// The narrowest strip around a convex outline lies along one of its edges.
double thickness(const PolygonShape& p) {
    const auto& v = p.verticesMetres;
    double narrowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < v.size(); ++i) {
        double widest = 0.0;
        for (const Vector& point : v) widest = std::max(widest, leftOf(point, v[i], after(v, i)));
        narrowest = std::min(narrowest, widest);
    }
    return narrowest;
}

double farthestPair(const std::vector<Vector>& points) {
    double farthest = 0.0;
    for (const Vector& a : points)
        for (const Vector& b : points) farthest = std::max(farthest, length(a - b));
    return farthest;
}

double longest(const CircleShape& c) { return 2.0 * c.radiusMetres; }
double longest(const BoxShape& b) {
    return std::max(b.widthMetres, b.heightMetres); // the longer side, not the diagonal
}
double longest(const PolygonShape& p) { return farthestPair(p.verticesMetres); }
double longest(const ChainShape& c) { return farthestPair(c.verticesMetres); }

} // namespace

ShapeMoments momentsOf(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return moments(s); }, shape);
}

double thicknessMetres(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return thickness(s); }, shape);
}

double lengthMetres(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return longest(s); }, shape);
}

bool isConvexCounterClockwise(const std::vector<Vector>& vertices) noexcept {
    if (vertices.size() < 3) return false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::size_t next = i + 1 < vertices.size() ? i + 1 : 0;
        if (vertices[i] == vertices[next]) return false;
        for (std::size_t j = 0; j < vertices.size(); ++j)
            if (j != i && j != next && !(leftOf(vertices[j], vertices[i], vertices[next]) > 0.0))
                return false;
    }
    return true;
}

// Clips off, edge by edge, what is closer to the edge than the margin (Sutherland-Hodgman).
std::vector<Vector> inset(const std::vector<Vector>& outline, double margin) {
    std::vector<Vector> left = outline;
    for (std::size_t edge = 0; edge < outline.size(); ++edge) {
        const auto depth = [&](const Vector& point) {
            return leftOf(point, outline[edge], after(outline, edge)) - margin;
        };
        std::vector<Vector> kept;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const Vector& a = left[i];
            const Vector& b = after(left, i);
            const double da = depth(a), db = depth(b);
            if (da >= 0.0) kept.push_back(a);
            if ((da < 0.0) == (db < 0.0)) continue;
            const double part = da / (da - db);
            kept.push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
        }
        left = std::move(kept);
    }
    return left;
}

} // namespace physvib
