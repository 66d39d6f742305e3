// SPDX-License-Identifier: MIT
// Creates Box2D shapes, bodies and masses from descriptions.
#include "Scene/World/SceneBodies.h"
#include "Contacts/ImpactSettings.h"
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <array>
#include <limits>

namespace physvib {

namespace {

/// Calls `use` with the b2Shape of a fixture, at its place in the body.
class ShapeMaker {
public:
    explicit ShapeMaker(const FixtureDescription& fixture)
        : place_(box2dVector(fixture.offsetMetres), b2Rot(static_cast<float>(fixture.angleRadians))) {
        std::visit([this](const auto& shape) { make(shape); }, fixture.shape);
    }
    const b2Shape& shape() const { return *made_; }

private:
    void make(const CircleShape& c) {
        circle_.m_p = place_.p;
        circle_.m_radius = static_cast<float>(c.radiusMetres);
        made_ = &circle_;
    }

    // Box2D adds a skin of b2_polygonRadius around polygons, where contacts begin. Shrinking the sides by it
    // puts the contact at the described outline; very thin shapes keep most of their thickness.
    void make(const BoxShape& b) {
        const auto halfSide = [](double side) {
            const double skin = std::min(static_cast<double>(b2_polygonRadius), side / 4.0);
            return static_cast<float>(side / 2.0 - skin);
        };
        polygon_.SetAsBox(halfSide(b.widthMetres), halfSide(b.heightMetres), place_.p, place_.q.GetAngle());
        made_ = &polygon_;
    }
    void make(const PolygonShape& p) {
        const double skin = std::min(static_cast<double>(b2_polygonRadius), thicknessMetres(p) / 8.0);
        const auto points = placed(inset(p.verticesMetres, skin));
        polygon_.Set(points.data(), static_cast<int32>(points.size()));
        made_ = &polygon_;
    }

    void make(const ChainShape& c) {
        const auto points = placed(c.verticesMetres);
        const auto count = static_cast<int32>(points.size());
        if (c.isLoop)
            chain_.CreateLoop(points.data(), count);
        else // neighbours beyond the ends continue the line straight
            chain_.CreateChain(points.data(), count, 2.0F * points[0] - points[1],
                               2.0F * points.back() - points[points.size() - 2]);
        made_ = &chain_;
    }

    std::vector<b2Vec2> placed(const std::vector<Vector>& vertices) const {
        std::vector<b2Vec2> points;
        for (const Vector& vertex : vertices) points.push_back(b2Mul(place_, box2dVector(vertex)));
        return points;
    }

    b2Transform place_;
    b2CircleShape circle_;
    b2PolygonShape polygon_;
    b2ChainShape chain_;
    const b2Shape* made_ = nullptr;
};

double thinnestMetres(const BodyDescription& body) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const FixtureDescription& fixture : body.fixtures)
        thinnest = std::min(thinnest, thicknessMetres(fixture.shape));
    return thinnest;
}

b2BodyType typeOf(BodyType type) {
    constexpr std::array types{b2_staticBody, b2_kinematicBody, b2_dynamicBody};
    return types[static_cast<std::size_t>(type)];
}

} // namespace

b2Body& createBody(b2World& world, const Scene& scene, const BodyDescription& body, const BodyStart& start,
                   double stepSeconds, std::vector<b2Fixture*>& fixtures) {
    b2BodyDef def;
    def.type = typeOf(body.type);
    def.position = box2dVector(start.positionMetres);
    def.angle = static_cast<float>(start.angleRadians);
    if (body.type != BodyType::staticBody) def.linearVelocity = box2dVector(start.velocityMetresPerSecond);
    def.angularVelocity = static_cast<float>(body.spinRadiansPerSecond);
    def.linearDamping = static_cast<float>(body.linearDampingPerSecond);
    def.angularDamping = static_cast<float>(body.angularDampingPerSecond);
    const double maxSpeed = 2.0 * largestSpeed(scene.fieldWidthMetres);
    def.bullet = thinnestMetres(body) < maxSpeed * stepSeconds;
    b2Body& created = *world.CreateBody(&def);
    for (const FixtureDescription& fixture : body.fixtures) {
        fixtures.push_back(created.CreateFixture(&ShapeMaker(fixture).shape(), 0.0F));
        // A line has no skin, but Box2D's copy of a chain resets the radius.
        if (std::holds_alternative<ChainShape>(fixture.shape)) fixtures.back()->GetShape()->m_radius = 0.0F;
        setSurface(*fixtures.back(), fixture, scene.materials[static_cast<std::size_t>(fixture.material)]);
    }
    setMass(created, body, scene);
    return created;
}

void restartBody(b2Body& created, const BodyDescription& body, const BodyStart& start) {
    created.SetEnabled(false); // ends its contacts
    created.SetTransform(box2dVector(start.positionMetres), static_cast<float>(start.angleRadians));
    created.SetLinearVelocity(box2dVector(start.velocityMetresPerSecond));
    created.SetAngularVelocity(static_cast<float>(body.spinRadiansPerSecond));
    created.SetEnabled(true);
    created.SetAwake(true);
}

void setMass(b2Body& created, const BodyDescription& body, const Scene& scene) {
    if (body.type != BodyType::dynamicBody) return;
    const BodyMoments moments = bodyMoments(body, scene);
    const Vector& c = moments.centreMetres;
    const double aboutOrigin = moments.inertiaKgSquareMetres + moments.massKg * (c.x * c.x + c.y * c.y);
    const b2MassData data{static_cast<float>(moments.massKg), box2dVector(c),
                          static_cast<float>(aboutOrigin)};
    created.SetMassData(&data);
}

void setSurface(b2Fixture& fixture, const FixtureDescription& description, const Material& material) {
    fixture.SetFriction(static_cast<float>(material.friction));
    fixture.SetRestitution(static_cast<float>(description.restitution.value_or(material.restitution)));
}

} // namespace physvib
