// SPDX-License-Identifier: MIT
// A bare b2World with an attachment, and bodies whose hits are known by hand.
#pragma once
#include "Physics/Attachment.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {

constexpr HapticFixture camera{250.0, 20.0, true, 10.0, Voice::own};
constexpr HapticFixture object{120.0, 30.0, false, 0.0, Voice::own};

/// A = |J| / m_i.
inline ImpactSettings unity() {
    ImpactSettings settings;
    settings.normalisation = 1.0;
    settings.handMassKg = 0.0;
    return settings;
}

inline double massKg(const b2Fixture& fixture) { return static_cast<double>(fixture.GetBody()->GetMass()); }
inline double momentumOf(const b2Fixture& fixture) {
    return massKg(fixture) * static_cast<double>(fixture.GetBody()->GetLinearVelocity().Length());
}

inline b2CircleShape discOf(float radius) {
    b2CircleShape disc;
    disc.m_radius = radius;
    return disc;
}

/// A shape on a body of its own, of so many kg/m^2.
inline b2Fixture& addTo(b2World& world, const b2Shape& shape, b2Vec2 at, b2Vec2 velocity = {0.0F, 0.0F},
                        float density = 10.0F) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = at;
    def.linearVelocity = velocity;
    return *world.CreateBody(&def)->CreateFixture(&shape, density);
}
/// The same of one that stands.
inline b2Fixture& addStill(b2World& world, const b2Shape& shape) {
    const b2BodyDef def;
    return *world.CreateBody(&def)->CreateFixture(&shape, 0.0F);
}

/// No gravity, 100 steps/s.
class AttachedWorld : public testing::Test {
protected:
    b2Fixture& ball(float x, float y, float vx, float vy, float restitution = 0.5F) {
        b2Fixture& fixture = addTo(world, discOf(0.25F), {x, y}, {vx, vy});
        fixture.SetRestitution(restitution);
        return fixture;
    }

    /// The fixture, with these values.
    b2Fixture& give(b2Fixture& fixture, const HapticFixture& values) {
        (void)attachment.set(fixture, values);
        return fixture;
    }

    /// 1 x 0.5 m and Box2D's skin around it, turned by `angle`, its lowest point `gap` above the floor.
    b2Fixture& box(float gap, float angle, float speedDown) {
        const float lowest = 0.5F * std::sin(std::abs(angle)) + 0.25F * std::cos(angle) + b2_polygonRadius;
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {0.0F, gap + lowest};
        def.angle = angle;
        def.linearVelocity = {0.0F, -speedDown};
        b2PolygonShape polygon;
        polygon.SetAsBox(0.5F, 0.25F);
        b2Fixture& fixture = *world.CreateBody(&def)->CreateFixture(&polygon, 10.0F);
        fixture.SetRestitution(0.5F);
        return fixture;
    }

    b2Fixture& edge(b2Vec2 from, b2Vec2 to) {
        b2EdgeShape shape;
        shape.SetTwoSided(from, to);
        shape.m_radius = 0.0F; // exact geometry
        return addStill(world, shape);
    }
    b2Fixture& floor() { return edge({-100.0F, 0.0F}, {100.0F, 0.0F}); }

    /// Events of so many steps; one more step makes the last of them final.
    std::vector<CollisionEvent> run(int steps) {
        std::vector<CollisionEvent> events;
        for (int i = 0; i <= steps; ++i) attachment.step(0.01F);
        attachment.take(events);
        return events;
    }

    /// The one event of so many steps.
    CollisionEvent only(int steps) {
        const auto events = run(steps);
        EXPECT_EQ(events.size(), 1U);
        return events.size() == 1 ? events.front() : CollisionEvent{};
    }

    /// One event, as strong as the momentum that `struck` has.
    static void expectOne(const std::vector<CollisionEvent>& events, const b2Fixture& struck,
                          double share = 0.02) {
        ASSERT_EQ(events.size(), 1U);
        const double own = momentumOf(struck);
        EXPECT_NEAR(events[0].source.impulseNewtonSeconds, own, share * own);
    }

    b2World world{{0.0F, 0.0F}};
    Attachment attachment{world, unity()};
};

inline double seconds(const CollisionEvent& event) { return static_cast<double>(event.timeNs) * 1.0e-9; }

} // namespace physvib
