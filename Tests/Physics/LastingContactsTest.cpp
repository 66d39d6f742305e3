// SPDX-License-Identifier: MIT
// What rolls and slides: grains where a pencil has them, silence where nothing moves.
#include "AttachedWorld.h"
#include "Contacts/Grains.h"
#include <algorithm>
#include <numbers>

namespace physvib {
namespace {

constexpr double g = 10.0;

/// A rough slope with a camera, downwards to the right, and what lies on it.
class Lasting : public AttachedWorld {
protected:
    Lasting() {
        world.SetGravity({0.0F, -static_cast<float>(g)});
        world.SetAllowSleeping(false);
    }
    static HapticFixture rough(double grainMetres, GrainPattern pattern = GrainPattern::random) {
        HapticFixture values = camera;
        values.texture.grainMetres = grainMetres;
        values.texture.pattern = pattern;
        return values;
    }
    b2Fixture& slope(double degrees, const HapticFixture& values) {
        const auto angle = static_cast<float>(-degrees * std::numbers::pi / 180.0);
        b2Fixture& fixture = edge({-20.0F * std::cos(angle), -20.0F * std::sin(angle)},
                                  {80.0F * std::cos(angle), 80.0F * std::sin(angle)});
        along = {std::cos(angle), std::sin(angle)};
        fixture.SetFriction(1.0F);
        (void)attachment.set(fixture, values);
        return fixture;
    }
    /// A ball of 0.25 m that touches the slope at its origin.
    b2Fixture& ballOnSlope(float friction) {
        b2Fixture& fixture = ball(-0.25F * along.y, 0.25F * along.x, 0.0F, 0.0F, 0.0F);
        fixture.SetFriction(friction);
        return fixture;
    }
    std::vector<CollisionEvent> lasting(int steps) {
        std::vector<CollisionEvent> events = run(steps);
        std::erase_if(events, [](const CollisionEvent& e) { return e.source.kind == ContactKind::hit; });
        return events;
    }
    b2Vec2 along{1.0F, 0.0F};
};

/// How far the nearest grain of fixture 0 is from where the path is at that time.
double missedMetres(const Grains& grains, double metres, double grainMetres) {
    const auto near = static_cast<std::int64_t>(std::floor(metres / grainMetres));
    double least = 1.0;
    for (std::int64_t i = near - 1; i <= near + 1; ++i)
        least = std::min(least, std::abs(grains.metresOf(i) - metres));
    return least;
}

TEST_F(Lasting, GrainsOfASlopeAreStruckWhenAPencilSays) {
    constexpr double spacing = 0.002, degrees = 20.0;
    const HapticFixture values = rough(spacing);
    slope(degrees, values);
    ballOnSlope(0.0F); // it slides: g sin
    const std::vector<CollisionEvent> events = lasting(100);
    const double acceleration = g * std::sin(degrees * std::numbers::pi / 180.0);
    ASSERT_GT(events.size(), 700U); // of 1.71 m
    const Grains grains{0, values.texture};
    for (const CollisionEvent& event : events) {
        const double t = seconds(event), metres = 0.5 * acceleration * t * t;
        EXPECT_LT(missedMetres(grains, metres, spacing) / (acceleration * t), 10.0e-6) << t;
        EXPECT_NEAR(event.x, metres * static_cast<double>(along.x), 0.001 * metres + 0.001) << t;
        EXPECT_EQ(event.source.kind, ContactKind::slide);
    }
}

TEST_F(Lasting, RollingBallIsFeltAsRollingAndTravels) {
    constexpr double spacing = 0.002;
    const HapticFixture values = rough(spacing);
    slope(20.0, values);
    const b2Body& ball = *ballOnSlope(1.0F).GetBody();
    const auto metres = [&] { return static_cast<double>(b2Dot(ball.GetPosition(), along)); };
    const auto speed = [&] { return static_cast<double>(b2Dot(ball.GetLinearVelocity(), along)); };
    lasting(9); // the solver takes a few steps to roll as it should
    const double v0 = speed(), s0 = metres() - 0.5 * v0 * 0.01, t0 = 0.1;
    const std::vector<CollisionEvent> events = lasting(99);
    const double acceleration = (speed() - v0) / 1.0;
    EXPECT_NEAR(acceleration, 2.0 / 3.0 * g * std::sin(20.0 * std::numbers::pi / 180.0), 0.01);
    ASSERT_GT(events.size(), 450U);
    const Grains grains{0, values.texture};
    for (const CollisionEvent& event : events) {
        const double t = seconds(event) - t0;
        if (t < 0.0) continue;
        const double s = s0 + (v0 + 0.5 * acceleration * t) * t;
        EXPECT_LT(missedMetres(grains, s, spacing) / (v0 + acceleration * t), 10.0e-6) << t;
        EXPECT_EQ(event.source.kind, ContactKind::roll);
    }
}

TEST_F(Lasting, RidgesGiveTheirTone) {
    slope(0.0, rough(0.002, GrainPattern::regular));
    ballOnSlope(0.0F).GetBody()->SetLinearVelocity({0.4F, 0.0F});
    const std::vector<CollisionEvent> events = lasting(200);
    ASSERT_GT(events.size(), 300U);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_NEAR(seconds(events[i]) - seconds(events[i - 1]), 1.0 / 200.0, 2.0e-6);
}

TEST_F(Lasting, SlidesThenRollsThenRests) {
    slope(0.0, rough(0.001));
    b2Fixture& ball = ballOnSlope(0.2F);
    ball.GetBody()->SetLinearVelocity({2.0F, 0.0F});
    ball.GetBody()->SetAngularVelocity(8.0F); // back-spin of as much again: it slides until 2/3 (v - w r / 2)
    // Box2D mixes frictions by their geometric mean
    const double friction = std::sqrt(0.2), v = 2.0, spin = 8.0 * 0.25;
    const double slides = (v + spin) / (3.0 * friction * g), rolling = v - friction * g * slides;
    const std::vector<CollisionEvent> events = lasting(100);
    const auto firstRoll =
        std::ranges::find(events, ContactKind::roll, [](const CollisionEvent& e) { return e.source.kind; });
    ASSERT_NE(firstRoll, events.end());
    // slips half as fast as it goes
    EXPECT_NEAR(seconds(*firstRoll), (0.5 * v + spin) / (2.5 * friction * g), 0.01);
    EXPECT_NEAR(static_cast<double>(ball.GetBody()->GetLinearVelocity().x), rolling, 0.02);
    ball.GetBody()->SetLinearVelocity({0.0F, 0.0F});
    ball.GetBody()->SetAngularVelocity(0.0F);
    lasting(1);
    EXPECT_TRUE(lasting(100).empty());
}

TEST_F(Lasting, ThrownWithBackSpinItTurnsBackAndRolls) {
    slope(0.0, rough(0.001));
    b2Fixture& ball = ballOnSlope(0.2F);
    ball.GetBody()->SetLinearVelocity({1.0F, 0.0F});
    ball.GetBody()->SetAngularVelocity(20.0F); // back-spin of five times as much
    const double deceleration = std::sqrt(0.2) * g, v = 1.0, spin = 20.0 * 0.25;
    const std::vector<CollisionEvent> events = lasting(100);
    const double furthest = v * v / (2.0 * deceleration);
    // on its way back; slips half as fast as it goes
    const double rolls = (1.5 * v + spin) / (3.5 * deceleration);
    ASSERT_GT(events.size(), 300U);
    for (const CollisionEvent& event : events) {
        const double t = seconds(event);
        EXPECT_LT(event.x, furthest + 0.001) << t;
        if (std::abs(t - rolls) > 0.015)
            EXPECT_EQ(event.source.kind, t < rolls ? ContactKind::slide : ContactKind::roll) << t;
        // half a step behind what was thrown at once
        const double slid = (v - 0.5 * deceleration * t) * t - 0.5 * 0.01 * v;
        if (t < rolls - 0.02) EXPECT_NEAR(event.x, slid, 0.001) << t;
    }
    EXPECT_NEAR(static_cast<double>(ball.GetBody()->GetLinearVelocity().x), v - (v + spin) / 3.0, 0.02);
}

TEST_F(Lasting, BoxSlidesUntilItSticksAndIsSilentFromThenOn) {
    slope(0.0, rough(0.001));
    b2Fixture& fixture = box(0.0F, 0.0F, 0.0F);
    fixture.SetFriction(0.09F); // and the floor's 1: 0.3 together
    fixture.SetRestitution(0.0F);
    fixture.GetBody()->SetLinearVelocity({1.5F, 0.0F});
    const std::vector<CollisionEvent> events = lasting(150);
    const double sticks = 1.5 / (0.3 * g);
    ASSERT_GT(events.size(), 600U); // 0.375 m by each corner
    EXPECT_NEAR(seconds(events.back()), sticks, 0.02);
    for (const CollisionEvent& event : events) EXPECT_EQ(event.source.kind, ContactKind::slide);
}

TEST_F(Lasting, BoxThatFrictionHoldsOnASlopeIsSilent) {
    slope(10.0, rough(0.0005));
    b2Fixture& fixture = box(0.0F, 0.0F, 0.0F);
    const float angle = std::atan2(along.y, along.x);
    fixture.GetBody()->SetTransform({0.26F * -along.y, 0.26F * along.x}, angle);
    fixture.SetFriction(0.25F); // holds up to 26 degrees
    fixture.SetRestitution(0.0F);
    EXPECT_TRUE(lasting(200).empty());
}

TEST_F(Lasting, GoingBackFeelsTheSameGrains) {
    slope(0.0, rough(0.002));
    b2Fixture& ball = ballOnSlope(0.0F);
    ball.GetBody()->SetLinearVelocity({0.5F, 0.0F});
    world.SetGravity({-2.0F, -10.0F}); // up to 62.5 mm, and back
    const std::vector<CollisionEvent> events = lasting(50);
    std::vector<double> there, back;
    for (const CollisionEvent& event : events) (seconds(event) < 0.25 ? there : back).push_back(event.x);
    std::ranges::reverse(back);
    ASSERT_GT(there.size(), 20U);
    for (std::size_t i = 1; i < 20; ++i) EXPECT_NEAR(there[there.size() - i], back[back.size() - i], 1.0e-4);
}

TEST_F(Lasting, BoxFeelsTheFloorWithBothItsCorners) {
    slope(0.0, rough(0.01));
    b2Fixture& fixture = box(0.0F, 0.0F, 0.0F);
    fixture.SetFriction(0.0F);
    fixture.SetRestitution(0.0F);
    fixture.GetBody()->SetLinearVelocity({1.0F, 0.0F});
    const std::vector<CollisionEvent> events = lasting(100);
    EXPECT_NEAR(static_cast<double>(events.size()), 2.0 * 99.0, 6.0);
    double left = 0.0, right = 0.0;
    for (const CollisionEvent& event : events) (event.x < seconds(event) ? left : right) += 1.0;
    EXPECT_NEAR(left, right, 4.0);
}

TEST_F(Lasting, RoughBallIsFeltOnASmoothFloorOnceARevolution) {
    HapticFixture smooth = camera;
    slope(0.0, smooth);
    b2Fixture& ball = ballOnSlope(1.0F);
    HapticFixture rough = object;
    rough.texture.grainMetres = 0.01;
    (void)attachment.set(ball, rough);
    ball.GetBody()->SetLinearVelocity({1.0F, 0.0F});
    ball.GetBody()->SetAngularVelocity(-4.0F);
    const std::vector<CollisionEvent> events = lasting(157); // once around
    EXPECT_NEAR(static_cast<double>(events.size()), 156.0, 4.0);
    for (const CollisionEvent& event : events) EXPECT_EQ(event.source.kind, ContactKind::roll);
}

TEST_F(Lasting, SmoothOrUnfeltIsSilent) {
    slope(20.0, camera);
    ballOnSlope(1.0F);
    EXPECT_TRUE(lasting(100).empty());
}

TEST_F(Lasting, RestIsSilentAndLandingIsACollisionOnly) {
    slope(0.0, rough(0.0005));
    ball(0.0F, 1.0F, 0.0F, 0.0F, 0.0F);
    const std::vector<CollisionEvent> events = run(200);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events.front().source.kind, ContactKind::hit);
}

TEST_F(Lasting, SeamsOfAChainAreNotHeard) {
    std::vector<b2Vec2> links;
    // from right to left: its upper side is solid
    for (int i = -2; i < 60; ++i) links.push_back({-0.1F * static_cast<float>(i), 0.0F});
    b2ChainShape shape;
    shape.CreateChain(links.data(), static_cast<int>(links.size()), {0.3F, 0.0F}, {-6.1F, 0.0F});
    const b2BodyDef def;
    b2Fixture& chain = *world.CreateBody(&def)->CreateFixture(&shape, 0.0F);
    (void)attachment.set(chain, rough(0.005, GrainPattern::regular));
    b2Fixture& ball = this->ball(0.0F, 0.25F + b2_polygonRadius, -1.0F, 0.0F, 0.0F);
    ball.SetFriction(0.0F);
    const std::vector<CollisionEvent> events = lasting(500);
    ASSERT_GT(events.size(), 950U);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_NEAR(seconds(events[i]) - seconds(events[i - 1]), 0.005, 1.0e-5) << seconds(events[i]);
}

} // namespace
} // namespace physvib
