// SPDX-License-Identifier: MIT
// Sums mass, centre and inertia over a body's fixtures.
#include "Scene/World/BodyMass.h"
#include "Scene/World/ShapeGeometry.h"
#include <cmath>
#include <cstddef>

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
    const double c = std::cos(fixture.angleRadians), s = std::sin(fixture.angleRadians);
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
    return body.type == BodyType::dynamicBody ? bodyMoments(body, scene).massKg : body.massKg;
}

} // namespace physvib
