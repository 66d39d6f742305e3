// SPDX-License-Identifier: MIT
// Scales bodies, and sets density, source flag and type.
#include "Scene/Drawing/BodyMotion.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/ShapeGeometry.h"
#include <algorithm>
#include <limits>

namespace physvib {
namespace {

double sized(double metres, double factor) {
    return std::clamp(metres * factor, 2.0 * sceneLimits::minSizeMetres, sceneLimits::maxSizeMetres);
}

class Scale {
public:
    Scale(double x, double y)
        : x_{x}
        , y_{y} {}
    void operator()(CircleShape& circle) const {
        circle.radiusMetres = sized(circle.radiusMetres, std::max(x_, y_));
    }
    void operator()(BoxShape& box) const {
        box.widthMetres = sized(box.widthMetres, x_);
        box.heightMetres = sized(box.heightMetres, y_);
    }
    template <class Outline>
    void operator()(Outline& outline) const {
        for (Vector& v : outline.verticesMetres) v = {v.x * x_, v.y * y_};
    }

private:
    double x_, y_;
};

/// Corners of a shape, or of a circle's bounding square.
std::vector<Vector> cornersOf(const Shape& shape) {
    if (const auto* circle = std::get_if<CircleShape>(&shape))
        return {{-circle->radiusMetres, -circle->radiusMetres}, {circle->radiusMetres, circle->radiusMetres}};
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        const double x = 0.5 * box->widthMetres, y = 0.5 * box->heightMetres;
        return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    }
    if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->verticesMetres;
    return std::get<ChainShape>(shape).verticesMetres;
}

bool isLine(const BodyDescription& body) {
    return std::ranges::any_of(body.fixtures, [](const FixtureDescription& f) {
        return std::holds_alternative<ChainShape>(f.shape);
    });
}

BodyMoments ownMoments(const Scene& scene, BodyDescription body) {
    body.massKg = 0.0;
    return bodyMoments(body, scene);
}

double areaOf(const BodyDescription& body) {
    double area = 0.0;
    for (const FixtureDescription& fixture : body.fixtures) area += momentsOf(fixture.shape).areaSquareMetres;
    return area;
}

} // namespace

Reach reachOf(const BodyDescription& body) {
    constexpr double far = std::numeric_limits<double>::max();
    Reach reach{{far, far}, {-far, -far}};
    for (const FixtureDescription& fixture : body.fixtures)
        for (const Vector& corner : cornersOf(fixture.shape)) {
            const Vector at = detail::turned(
                corner, std::holds_alternative<CircleShape>(fixture.shape) ? 0.0 : fixture.angleRadians);
            const Vector p{fixture.offsetMetres.x + at.x, fixture.offsetMetres.y + at.y};
            reach = {{std::min(reach.least.x, p.x), std::min(reach.least.y, p.y)},
                     {std::max(reach.most.x, p.x), std::max(reach.most.y, p.y)}};
        }
    return reach;
}

BodyDescription scaledBody(BodyDescription body, double factorX, double factorY) {
    for (FixtureDescription& fixture : body.fixtures) {
        std::visit(Scale{factorX, factorY}, fixture.shape);
        fixture.offsetMetres = {fixture.offsetMetres.x * factorX, fixture.offsetMetres.y * factorY};
    }
    return body;
}

double densityOf(const Scene& scene, const BodyDescription& body) {
    const double area = areaOf(body);
    if (area <= 0.0) return 0.0;
    return (body.massKg > 0.0 ? body.massKg : ownMoments(scene, body).massKg) / area;
}

void setDensity(BodyDescription& body, double kgPerSquareMetre) {
    const double mass = kgPerSquareMetre * areaOf(body);
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg) : 0.0;
}

void setSource(const Scene& scene, BodyDescription& body, bool isSource) {
    for (FixtureDescription& fixture : body.fixtures) fixture.isCamera = isSource;
    if (!isSource || body.type == BodyType::dynamicBody || body.massKg > 0.0) return;
    const double mass = ownMoments(scene, body).massKg;
    body.massKg = mass > 0.0 ? std::clamp(mass, sceneLimits::minMassKg, sceneLimits::maxMassKg)
                             : 1.0; // a line has no mass of its own
}

void setMoving(const Scene& scene, BodyDescription& body, bool moves) {
    if (isLine(body)) return;
    body.type = moves ? BodyType::dynamicBody : BodyType::staticBody;
    const bool isSource = std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
    if (isSource && !moves && body.massKg <= 0.0)
        body.massKg =
            std::clamp(ownMoments(scene, body).massKg, sceneLimits::minMassKg, sceneLimits::maxMassKg);
}

} // namespace physvib
