// SPDX-License-Identifier: MIT
// Sums mass, centre and inertia over a body's fixtures.
#include "Scene/World/BodyMass.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
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
        const FixtureMoments one = momentsOf(fixture, scene);
        sum.massKg += one.massKg;
        sum.centreMetres.x += one.massKg * one.centreMetres.x;
        sum.centreMetres.y += one.massKg * one.centreMetres.y;
    }
    if (sum.massKg <= 0.0) return sum;
    sum.centreMetres = {sum.centreMetres.x / sum.massKg, sum.centreMetres.y / sum.massKg};
    for (const FixtureDescription& fixture : body.fixtures) {
        const FixtureMoments one = momentsOf(fixture, scene);
        const double x = one.centreMetres.x - sum.centreMetres.x, y = one.centreMetres.y - sum.centreMetres.y;
        sum.inertiaKgSquareMetres += one.inertia + one.massKg * (x * x + y * y);
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
