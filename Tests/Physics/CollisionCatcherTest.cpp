// SPDX-License-Identifier: MIT
// The catcher on a bare b2World, as it will be attached to the worlds of others.
#include "Physics/CollisionCatcher.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {
namespace {

constexpr StepClock hundred{100};
constexpr ImpactModel unity{1.0, 0.0, 1.0};
constexpr HapticFixture camera{250.0, 20.0, true, 10.0};

/// A world without gravity, 100 steps/s.
class CatcherWorld : public testing::Test {
protected:
    CatcherWorld() { attach(catcher); }

    void attach(CollisionCatcher& listener) {
        world.SetContactListener(&listener);
        listening = &listener;
    }

    b2Fixture& ball(float x, float y, float vx, float vy, bool bullet = false) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {x, y};
        def.linearVelocity = {vx, vy};
        def.bullet = bullet;
        b2CircleShape circle;
        circle.m_radius = 0.25F;
        b2FixtureDef fixture;
        fixture.shape = &circle;
        fixture.density = 10.0F;
        fixture.restitution = 0.5F;
        return *world.CreateBody(&def)->CreateFixture(&fixture);
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

    b2Fixture& floor() {
        const b2BodyDef def;
        b2EdgeShape edge;
        edge.SetTwoSided({-100.0F, 0.0F}, {100.0F, 0.0F});
        edge.m_radius = 0.0F; // exact geometry
        return *world.CreateBody(&def)->CreateFixture(&edge, 0.0F);
    }

    std::vector<CollisionEvent> run(int steps) {
        EventSorter sorter(4096);
        for (int i = 0; i < steps; ++i, ++step) {
            listening->beginStep(hundred.stepSeconds());
            world.Step(0.01F, 8, 3);
            listening->collect(hundred, step, unity, sorter);
        }
        std::vector<CollisionEvent> events;
        sorter.release(limits::maxTimeNs, events);
        return events;
    }

    b2World world{{0.0F, 0.0F}};
    CollisionCatcher catcher;
    CollisionCatcher* listening = nullptr;
    std::int64_t step = 0;
};

double seconds(const CollisionEvent& event) {
    return static_cast<double>(event.timeNs) * 1.0e-9;
}

TEST_F(CatcherWorld, TwoMovingCamerasMeetAtTheRightMoment) {
    catcher.add(ball(-1.0F, 1.0F, 3.0F, 0.0F), camera);
    catcher.add(ball(1.0F, 1.0F, -4.0F, 0.0F), camera);
    const auto events = run(50);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[1].source.fixture, 1);
    EXPECT_NEAR(seconds(events[0]), 1.5 / 7.0, 1.0e-5); // closing a gap of 1.5 m at 7 m/s
    EXPECT_NEAR(events[0].x, -0.75 + 3.0 * 1.5 / 7.0, 0.01);
    const double mass = events[0].source.massKg;
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, mass / 2.0 * 7.0 * 1.5, 1.0e-3); // reduced mass
}

TEST_F(CatcherWorld, HitsOfTheTimeOfImpactPassAreTimedWithinTheirStep) {
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 2.0F, 0.0F, -13.7F), {});
    const auto events = run(30);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(seconds(events[0]), 1.75 / 13.7, 1.0e-5);
}

TEST_F(CatcherWorld, SecondImpactWithinOneStepIsTimedToo) {
    // Into the corner of floor and wall at 15 and 12 m/s: both touched between 100 and 110 ms.
    catcher.add(floor(), camera);
    const b2BodyDef def;
    b2EdgeShape edge;
    edge.SetTwoSided({0.0F, -100.0F}, {0.0F, 100.0F});
    edge.m_radius = 0.0F;
    catcher.add(*world.CreateBody(&def)->CreateFixture(&edge, 0.0F), camera);
    b2Fixture& fast = ball(0.25F + 12.0F * 0.1075F, 0.25F + 15.0F * 0.1025F, -12.0F, -15.0F);
    fast.SetFriction(0.0F);
    catcher.add(fast, {});
    const auto events = run(30);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[1].source.fixture, 1);
    EXPECT_NEAR(seconds(events[0]), 0.1025, 1.0e-4);
    EXPECT_NEAR(seconds(events[1]), 0.1075, 1.0e-4);
}

TEST_F(CatcherWorld, FrictionIsPartOfTheImpulse) {
    catcher.add(floor(), camera);
    b2Fixture& sliding = ball(0.0F, 0.5F, 5.0F, -5.0F);
    catcher.add(sliding, {});
    const b2Vec2 before = sliding.GetBody()->GetLinearVelocity();
    const auto events = run(10);
    ASSERT_EQ(events.size(), 1U);
    const b2Vec2 change = sliding.GetBody()->GetLinearVelocity() - before;
    EXPECT_LT(change.x, -0.1F); // or there was no friction to see
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, sliding.GetBody()->GetMass() * change.Length(),
                1.0e-3);
}

TEST_F(CatcherWorld, FlatLandingSumsBothPointsAndIsFeltInTheMiddle) {
    catcher.add(floor(), camera);
    b2Fixture& landing = box(0.5F, 0.0F, 5.0F);
    catcher.add(landing, {});
    const auto events = run(20);
    ASSERT_EQ(events.size(), 1U);
    const double expected = landing.GetBody()->GetMass() * 5.0 * 1.5;
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, expected, 0.01 * expected);
    EXPECT_NEAR(events[0].x, 0.0, 1.0e-3);
}

TEST_F(CatcherWorld, TiltedLandingIsTimedByTheLowerCorner) {
    for (const float tilt : {0.003F, -0.003F}) {
        CollisionCatcher another;
        attach(another);
        step = 0;
        b2Fixture& ground = floor();
        b2Fixture& landing = box(0.48F, tilt, 5.0F);
        another.add(ground, camera);
        another.add(landing, {});
        const auto events = run(12);
        ASSERT_GE(events.size(), 1U);
        EXPECT_NEAR(seconds(events[0]), 0.096, 2.0e-4);
        world.DestroyBody(landing.GetBody());
        world.DestroyBody(ground.GetBody());
    }
}

TEST_F(CatcherWorld, ContactThatOpensAndClosesWithinAStepIsOneHit) {
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.26F, 0.0F, -5.0F), {});
    ASSERT_EQ(run(1).size(), 1U);
    b2Contact* contact = world.GetContactList();
    catcher.beginStep(hundred.stepSeconds());
    const b2ContactImpulse impulse{{3.0F, 0.0F}, {4.0F, 0.0F}, 1};
    for (int pass = 0; pass < 2; ++pass) {
        catcher.BeginContact(contact);
        catcher.PostSolve(contact, &impulse);
        catcher.EndContact(contact);
    }
    EventSorter sorter(8);
    catcher.collect(hundred, step, unity, sorter);
    std::vector<CollisionEvent> events;
    sorter.release(limits::maxTimeNs, events);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_DOUBLE_EQ(events[0].source.impulseNewtonSeconds, 10.0); // twice (3, 4)
}

TEST_F(CatcherWorld, BodiesThatStartInEachOtherHitAtTimeZero) {
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.2F, 0.0F, -1.0F), {});
    const auto events = run(5);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].timeNs, 0);
}

TEST_F(CatcherWorld, HitsLieAtMostOneStepInThePast) {
    run(10);
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.2F, 0.0F, -1.0F), {}); // put 50 ms deep into the floor
    const auto events = run(5);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].timeNs, 90'000'000);
}

TEST_F(CatcherWorld, HitsBelowTheThresholdAreNoStrikes) {
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.26F, 0.0F, -0.14F), {});
    EXPECT_TRUE(run(100).empty());
}

TEST_F(CatcherWorld, HitsAboveTheThresholdAreStrikes) {
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.26F, 0.0F, -0.16F), {});
    EXPECT_EQ(run(100).size(), 1U);
}

TEST_F(CatcherWorld, RestingBallStrikesOnce) {
    world.SetGravity({0.0F, -10.0F});
    world.SetAllowSleeping(false);
    catcher.add(floor(), camera);
    catcher.add(ball(0.0F, 0.27F, 0.0F, -0.5F), {}); // too slow for Box2D to bounce
    EXPECT_EQ(run(1000).size(), 1U);
}

TEST_F(CatcherWorld, ThresholdCountsTheLighterBody) {
    b2Fixture& light = ball(-0.6F, 1.0F, 0.2F, 0.0F);
    b2Fixture& heavy = ball(0.0F, 1.0F, 0.0F, 0.0F);
    heavy.SetDensity(1.0e5F);
    heavy.GetBody()->ResetMassData();
    catcher.add(light, {});
    catcher.add(heavy, camera);
    const auto events = run(100);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].source.fixture, 1);
}

TEST_F(CatcherWorld, UnknownFixturesAreFeltButNotNamed) {
    catcher.add(floor(), camera);
    ball(0.0F, 0.5F, 0.0F, -5.0F);
    const auto events = run(20);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[0].source.other, -1);
}

TEST_F(CatcherWorld, SensorsAreNotHit) {
    b2Fixture& sensor = floor();
    sensor.SetSensor(true);
    catcher.add(sensor, camera);
    catcher.add(ball(0.0F, 0.5F, 0.0F, -5.0F), {});
    EXPECT_TRUE(run(50).empty());
}

TEST_F(CatcherWorld, ContactsWithoutRoomAreCounted) {
    constexpr int balls = static_cast<int>(CollisionCatcher::maxRecords) + 10;
    catcher.add(floor(), camera);
    for (int i = 0; i < balls; ++i)
        catcher.add(ball(-90.0F + 0.16F * static_cast<float>(i), 0.24F, 0.0F, -1.0F), {});
    b2Filter apart;
    apart.groupIndex = -1;
    for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        if (body->GetType() == b2_dynamicBody) body->GetFixtureList()->SetFilterData(apart);
    EXPECT_EQ(run(1).size(), CollisionCatcher::maxRecords);
    EXPECT_EQ(catcher.drops(), 10U);
}

TEST_F(CatcherWorld, LargestMassCountsStaticBodiesByTheirGivenMass) {
    catcher.add(floor(), camera);
    b2Fixture& moving = ball(0.0F, 1.0F, 0.0F, 0.0F);
    catcher.add(moving, {0.0, 0.0, false, 500.0}); // a dynamic body has its own
    EXPECT_EQ(catcher.largestMassKg(), 10.0);
    moving.SetDensity(1000.0F);
    moving.GetBody()->ResetMassData();
    EXPECT_EQ(catcher.largestMassKg(), moving.GetBody()->GetMass());
}

} // namespace
} // namespace physvib
