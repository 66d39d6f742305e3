// SPDX-License-Identifier: MIT
// From body descriptions to bodies, fixtures and masses.
#include "Physics/SceneBodies.h"
#include <algorithm>
#include <cstdint>
#include <numbers>

namespace physvib {

namespace {

b2Vec2 vector(double x, double y) {
    return {static_cast<float>(x), static_cast<float>(y)};
}

double area(const CircleShape& c) {
    return std::numbers::pi * c.radiusMetres * c.radiusMetres;
}
double area(const BoxShape& b) {
    return b.widthMetres * b.heightMetres;
}

double inertiaPerKg(const CircleShape& c) {
    return c.radiusMetres * c.radiusMetres / 2.0;
}
double inertiaPerKg(const BoxShape& b) {
    return (b.widthMetres * b.widthMetres + b.heightMetres * b.heightMetres) / 12.0;
}

double thickness(const CircleShape& c) {
    return 2.0 * c.radiusMetres;
}
double thickness(const BoxShape& b) {
    return std::min(b.widthMetres, b.heightMetres);
}

// Box2D keeps a skin of b2_polygonRadius around polygons, and contacts begin at the skin. Taking it off the
// sides puts the contact where the outline is described; very thin boxes keep half of their thickness.
float halfSide(double sideMetres) {
    const double skin = std::min(static_cast<double>(b2_polygonRadius), sideMetres / 4.0);
    return static_cast<float>(sideMetres / 2.0 - skin);
}

b2Fixture& addFixture(b2Body& body, const Shape& shape, const b2FixtureDef& material) {
    b2CircleShape circle;
    b2PolygonShape polygon;
    b2FixtureDef fixture = material;
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        polygon.SetAsBox(halfSide(box->widthMetres), halfSide(box->heightMetres));
        fixture.shape = &polygon;
    } else {
        circle.m_radius = static_cast<float>(std::get<CircleShape>(shape).radiusMetres);
        fixture.shape = &circle;
    }
    return *body.CreateFixture(&fixture);
}

b2BodyDef bodyDef(const BodyDescription& body, const StartJitter& jitter) {
    b2BodyDef def;
    def.type = body.isStatic ? b2_staticBody : b2_dynamicBody;
    def.position = vector(body.position.xMetres + jitter.xMetres, body.position.yMetres + jitter.yMetres);
    def.angle = static_cast<float>(body.angleRadians + jitter.angleRadians);
    def.linearVelocity = vector(jitter.xMetresPerSecond, jitter.yMetresPerSecond);
    return def;
}

} // namespace

double massKg(const BodyDescription& body, const Scene& scene) noexcept {
    if (body.isStatic) return body.staticMassKg;
    const auto& material = scene.materials[static_cast<std::size_t>(body.material)];
    return material.densityKgPerSquareMetre * std::visit([](const auto& s) { return area(s); }, body.shape);
}

StartJitter drawJitter(std::mt19937& random) noexcept {
    constexpr double reach = 1.0e-3;
    const auto draw = [&random] { return (static_cast<double>(random()) * 0x1p-31 - 1.0) * reach; };
    StartJitter jitter;
    jitter.xMetres = draw();
    jitter.yMetres = draw();
    jitter.angleRadians = draw();
    jitter.xMetresPerSecond = draw();
    jitter.yMetresPerSecond = draw();
    return jitter;
}

b2Fixture& createBody(b2World& world, const Scene& scene, const BodyDescription& body,
                      const StartJitter& jitter, double stepSeconds) {
    const Material& material = scene.materials[static_cast<std::size_t>(body.material)];
    b2BodyDef def = bodyDef(body, jitter);
    const double maxSpeed = 2.0 * scene.fieldWidthMetres; // per second, as in Eq. 5.7
    def.bullet = std::visit([](const auto& s) { return thickness(s); }, body.shape) < maxSpeed * stepSeconds;
    b2Body& created = *world.CreateBody(&def);

    b2FixtureDef fixture;
    fixture.friction = static_cast<float>(material.friction);
    fixture.restitution = static_cast<float>(material.restitution);
    b2Fixture& result = addFixture(created, body.shape, fixture);
    if (!body.isStatic) {
        const double mass = massKg(body, scene);
        const double perKg = std::visit([](const auto& s) { return inertiaPerKg(s); }, body.shape);
        const b2MassData data{static_cast<float>(mass), {0.0F, 0.0F}, static_cast<float>(mass * perKg)};
        created.SetMassData(&data);
    }
    return result;
}

} // namespace physvib
