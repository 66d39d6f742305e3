// SPDX-License-Identifier: MIT
// Sums mass, centre and inertia over a body's fixtures; and computes moments, extents and insets of shapes.
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>

namespace physvib {
namespace {

struct FixtureMoments {
    double massKg;
    Vector centreMetres;
    double inertia; // about the centre
};

FixtureMoments momentsOf(const FixtureDescription& fixture, const Scene& scene) noexcept {
    const Material& material = scene.materials[static_cast<std::size_t>(fixture.material)];
    const ShapeMoments shape = momentsOf(fixture.shape);
    const double mass = material.densityKgPerSquareMetre * shape.areaSquareMetres;
    const double c = portable::cos(fixture.angleRadians), s = portable::sin(fixture.angleRadians);
    const Vector& local = shape.centroidMetres;
    const Vector centre{fixture.offsetMetres.x + c * local.x - s * local.y,
                        fixture.offsetMetres.y + s * local.x + c * local.y};
    return {mass, centre, mass * shape.inertiaPerKg};
}

} // namespace

BodyMoments bodyMoments(const BodyDescription& body, const Scene& scene) noexcept {
    BodyMoments sum;
    for (const FixtureDescription& fixture : body.fixtures) {
        const FixtureMoments moments = momentsOf(fixture, scene);
        sum.massKg += moments.massKg;
        sum.centreMetres.x += moments.massKg * moments.centreMetres.x;
        sum.centreMetres.y += moments.massKg * moments.centreMetres.y;
    }
    if (sum.massKg <= 0.0) return sum;
    sum.centreMetres = {sum.centreMetres.x / sum.massKg, sum.centreMetres.y / sum.massKg};
    for (const FixtureDescription& fixture : body.fixtures) {
        const FixtureMoments moments = momentsOf(fixture, scene);
        const double x = moments.centreMetres.x - sum.centreMetres.x,
                     y = moments.centreMetres.y - sum.centreMetres.y;
        sum.inertiaKgSquareMetres += moments.inertia + moments.massKg * (x * x + y * y);
    }
    if (body.massKg > 0.0) {
        sum.inertiaKgSquareMetres *= body.massKg / sum.massKg;
        sum.massKg = body.massKg;
    }
    return sum;
}

double massKg(const BodyDescription& body, const Scene& scene) noexcept {
    return body.massKg > 0.0 ? body.massKg : bodyMoments(body, scene).massKg;
}

namespace {

Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }
double length(const Vector& a) { return portable::hypot(a.x, a.y); }

const Vector& nextVertex(const std::vector<Vector>& outline, std::size_t i) {
    return outline[i + 1 < outline.size() ? i + 1 : 0];
}

/// Distance of `point` from the line from `from` to `to`, positive on its left.
double distanceLeftOf(const Vector& point, const Vector& from, const Vector& to) {
    return cross(to - from, point - from) / length(to - from);
}

ShapeMoments shapeMoments(const CircleShape& c) {
    const double radiusSquared = c.radiusMetres * c.radiusMetres;
    return {std::numbers::pi * c.radiusMetres * c.radiusMetres, {}, radiusSquared / 2.0};
}
ShapeMoments shapeMoments(const BoxShape& b) {
    const double squares = b.widthMetres * b.widthMetres + b.heightMetres * b.heightMetres;
    return {b.widthMetres * b.heightMetres, {}, squares / 12.0};
}
ShapeMoments shapeMoments(const ChainShape&) { return {}; }

// Sums triangles from the first vertex, so that an outline far from the origin loses no precision.
ShapeMoments shapeMoments(const PolygonShape& p) {
    const auto& v = p.verticesMetres;
    double twiceArea = 0.0, secondMoment = 0.0;
    Vector firstMoment;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
        const Vector a = v[i] - v[0], b = v[i + 1] - v[0];
        const double doubleArea = cross(a, b);
        twiceArea += doubleArea;
        firstMoment.x += doubleArea * (a.x + b.x);
        firstMoment.y += doubleArea * (a.y + b.y);
        secondMoment += doubleArea * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    if (!(twiceArea > 0.0)) return {};
    const Vector centre{firstMoment.x / (3.0 * twiceArea), firstMoment.y / (3.0 * twiceArea)};
    return {twiceArea / 2.0,
            {v[0].x + centre.x, v[0].y + centre.y},
            secondMoment / (6.0 * twiceArea) - dot(centre, centre)};
}

double shapeThickness(const CircleShape& c) { return 2.0 * c.radiusMetres; }
double shapeThickness(const BoxShape& b) { return std::min(b.widthMetres, b.heightMetres); }
double shapeThickness(const ChainShape&) { return 0.0; }
// The narrowest strip that contains a convex outline is parallel to one of its edges.
double shapeThickness(const PolygonShape& p) {
    const auto& v = p.verticesMetres;
    double minWidth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < v.size(); ++i) {
        double width = 0.0;
        for (const Vector& point : v) width = std::max(width, distanceLeftOf(point, v[i], nextVertex(v, i)));
        minWidth = std::min(minWidth, width);
    }
    return minWidth;
}

double farthestPair(const std::vector<Vector>& points) {
    double farthest = 0.0;
    for (const Vector& a : points)
        for (const Vector& b : points) farthest = std::max(farthest, length(a - b));
    return farthest;
}

double shapeLength(const CircleShape& c) { return 2.0 * c.radiusMetres; }
double shapeLength(const BoxShape& b) {
    return std::max(b.widthMetres, b.heightMetres); // the longer side, not the diagonal
}
double shapeLength(const PolygonShape& p) { return farthestPair(p.verticesMetres); }
double shapeLength(const ChainShape& c) { return farthestPair(c.verticesMetres); }

} // namespace

ShapeMoments momentsOf(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return shapeMoments(s); }, shape);
}

double thicknessMetres(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return shapeThickness(s); }, shape);
}

double lengthMetres(const Shape& shape) noexcept {
    return std::visit([](const auto& s) { return shapeLength(s); }, shape);
}

bool isConvexCounterClockwise(const std::vector<Vector>& vertices) noexcept {
    if (vertices.size() < 3) return false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::size_t next = i + 1 < vertices.size() ? i + 1 : 0;
        if (vertices[i] == vertices[next]) return false;
        for (std::size_t j = 0; j < vertices.size(); ++j)
            if (j != i && j != next && !(distanceLeftOf(vertices[j], vertices[i], vertices[next]) > 0.0))
                return false;
    }
    return true;
}

// Cuts off, edge by edge, the part that is nearer to the edge than the margin (Sutherland-Hodgman clipping).
std::vector<Vector> inset(const std::vector<Vector>& outline, double marginMetres) {
    std::vector<Vector> clipped = outline;
    for (std::size_t edge = 0; edge < outline.size(); ++edge) {
        const auto depth = [&](const Vector& point) {
            return distanceLeftOf(point, outline[edge], nextVertex(outline, edge)) - marginMetres;
        };
        std::vector<Vector> inside;
        for (std::size_t i = 0; i < clipped.size(); ++i) {
            const Vector& a = clipped[i];
            const Vector& b = nextVertex(clipped, i);
            const double da = depth(a), db = depth(b);
            if (da >= 0.0) inside.push_back(a);
            if ((da < 0.0) == (db < 0.0)) continue;
            const double fraction = da / (da - db);
            inside.push_back({a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)});
        }
        clipped = std::move(inside);
    }
    return clipped;
}

} // namespace physvib
