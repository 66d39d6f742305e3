// SPDX-License-Identifier: MIT
// What rolls and slides: grains where a pencil has them, silence where nothing moves.
#include "AttachedWorld.h"
#include "Contacts/Grains.h"
#include "Core/PhantomPanner.h"
#include "Measure/Spectrum.h"
#include "Physics/Attachment.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace physvib::lasting_contacts_test {

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
    void slope(double degrees, const HapticFixture& values, float friction = 1.0F) {
        const auto angle = static_cast<float>(-degrees * std::numbers::pi / 180.0);
        along = {std::cos(angle), std::sin(angle)};
        give(edge(top - 20.0F * along, top + 80.0F * along), values).SetFriction(friction);
    }
    /// A ball of 0.25 m that touches the slope at its origin, and moves.
    b2Body& ballOnSlope(float friction, float speed = 0.0F, float spin = 0.0F) {
        b2Fixture& fixture = ball(top.x - 0.25F * along.y, top.y + 0.25F * along.x, speed, 0.0F, 0.0F);
        fixture.SetFriction(friction);
        fixture.GetBody()->SetAngularVelocity(spin);
        return *fixture.GetBody();
    }
    b2Body& boxOnSlope(float friction, float speed = 0.0F) {
        b2Fixture& fixture = box(0.0F, 0.0F, 0.0F);
        fixture.SetFriction(friction);
        fixture.SetRestitution(0.0F);
        fixture.GetBody()->SetLinearVelocity({speed, 0.0F});
        return *fixture.GetBody();
    }
    std::vector<CollisionEvent> lasting(int steps) {
        std::vector<CollisionEvent> events = run(steps);
        std::erase_if(events, [](const CollisionEvent& e) { return e.source.kind == ContactKind::hit; });
        return events;
    }
    b2Vec2 top{0.0F, 0.0F}, along{1.0F, 0.0F};
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
    const b2Body& ball = ballOnSlope(1.0F);
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
    ballOnSlope(0.0F, 0.4F);
    const std::vector<CollisionEvent> events = lasting(200);
    ASSERT_GT(events.size(), 300U);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_NEAR(seconds(events[i]) - seconds(events[i - 1]), 1.0 / 200.0, 2.0e-6);
}

TEST_F(Lasting, SlidesThenRollsThenRests) {
    slope(0.0, rough(0.001));
    b2Body& ball = ballOnSlope(0.2F, 2.0F, 8.0F); // back-spin of as much again: it slides until 2/3 (v - w r
                                                  // / 2)
    // Box2D mixes frictions by their geometric mean
    const double friction = std::sqrt(0.2), v = 2.0, spin = 8.0 * 0.25;
    const double slides = (v + spin) / (3.0 * friction * g), rolling = v - friction * g * slides;
    const std::vector<CollisionEvent> events = lasting(100);
    const auto firstRoll =
        std::ranges::find(events, ContactKind::roll, [](const CollisionEvent& e) { return e.source.kind; });
    ASSERT_NE(firstRoll, events.end());
    // slips half as fast as it goes
    EXPECT_NEAR(seconds(*firstRoll), (0.5 * v + spin) / (2.5 * friction * g), 0.01);
    EXPECT_NEAR(static_cast<double>(ball.GetLinearVelocity().x), rolling, 0.02);
    ball.SetLinearVelocity({0.0F, 0.0F});
    ball.SetAngularVelocity(0.0F);
    lasting(1);
    EXPECT_TRUE(lasting(100).empty());
}

TEST_F(Lasting, ThrownWithBackSpinItTurnsBackAndRolls) {
    slope(0.0, rough(0.001));
    const b2Body& ball = ballOnSlope(0.2F, 1.0F, 20.0F); // back-spin of five times as much
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
    EXPECT_NEAR(static_cast<double>(ball.GetLinearVelocity().x), v - (v + spin) / 3.0, 0.02);
}

TEST_F(Lasting, BoxSlidesUntilItSticksAndIsSilentFromThenOn) {
    slope(0.0, rough(0.001));
    boxOnSlope(0.09F, 1.5F); // and the floor's friction of 1: 0.3 together
    const std::vector<CollisionEvent> events = lasting(150);
    const double sticks = 1.5 / (0.3 * g);
    ASSERT_GT(events.size(), 600U); // 0.375 m by each corner
    EXPECT_NEAR(seconds(events.back()), sticks, 0.02);
    for (const CollisionEvent& event : events) EXPECT_EQ(event.source.kind, ContactKind::slide);
}

TEST_F(Lasting, BoxThatFrictionHoldsOnASlopeIsSilent) {
    slope(10.0, rough(0.0005));
    boxOnSlope(0.25F) // holds up to 26 degrees
        .SetTransform({0.26F * -along.y, 0.26F * along.x}, std::atan2(along.y, along.x));
    EXPECT_TRUE(lasting(200).empty());
}

TEST_F(Lasting, GoingBackFeelsTheSameGrains) {
    slope(0.0, rough(0.002));
    ballOnSlope(0.0F, 0.5F);
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
    boxOnSlope(0.0F, 1.0F);
    const std::vector<CollisionEvent> events = lasting(100);
    EXPECT_NEAR(static_cast<double>(events.size()), 2.0 * 99.0, 6.0);
    double left = 0.0, right = 0.0;
    for (const CollisionEvent& event : events) (event.x < seconds(event) ? left : right) += 1.0;
    EXPECT_NEAR(left, right, 4.0);
}

TEST_F(Lasting, RoughBallIsFeltOnASmoothFloorOnceARevolution) {
    slope(0.0, camera);
    HapticFixture rough = object;
    rough.texture.grainMetres = 0.01;
    give(*ballOnSlope(1.0F, 1.0F, -4.0F).GetFixtureList(), rough);
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
    EXPECT_EQ(only(200).source.kind, ContactKind::hit);
}

TEST_F(Lasting, SeamsOfAChainAreNotHeard) {
    std::vector<b2Vec2> links;
    // from right to left: its upper side is solid
    for (int i = -2; i < 60; ++i) links.push_back({-0.1F * static_cast<float>(i), 0.0F});
    b2ChainShape shape;
    shape.CreateChain(links.data(), static_cast<int>(links.size()), {0.3F, 0.0F}, {-6.1F, 0.0F});
    b2Fixture& chain = give(addStill(world, shape), rough(0.005, GrainPattern::regular));
    b2Fixture& ball = this->ball(0.0F, 0.25F + b2_polygonRadius, -1.0F, 0.0F, 0.0F);
    ball.SetFriction(0.0F);
    const std::vector<CollisionEvent> events = lasting(500);
    ASSERT_GT(events.size(), 950U);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_NEAR(seconds(events[i]) - seconds(events[i - 1]), 0.005, 1.0e-5) << seconds(events[i]);
}

// What rolls, as four enchanters play it: where the phantom is, and which tone ridges give.

constexpr int rate = 48'000;
constexpr double fieldWidth = 4.4, fieldHeight = 1.7;

/// A rough slope from the field's upper left corner, and a ball of 0.25 m that touches it there.
class LastingFelt : public Lasting {
protected:
    LastingFelt() { top.y = static_cast<float>(fieldHeight); }
    /// Four channels of what has happened.
    static test::Channels felt(const std::vector<CollisionEvent>& events, PanningLaw law, double length) {
        ActuatorLayout layout;
        layoutPreset("phone4", layout);
        RendererSettings settings{rate, 4, {layout, law, 1.0, fieldWidth, fieldHeight}};
        settings.limiterEnabled = false;
        return test::renderEvents(events, settings, static_cast<int>(length * rate)).channels;
    }
};

double power(std::span<const float> samples) {
    double sum = 0.0;
    for (const float x : samples) sum += static_cast<double>(x) * static_cast<double>(x);
    return sum;
}

/// Where four channels' levels put the phantom: linear gains sum to one, squares of the energy law's do.
b2Vec2 centroid(const test::Channels& channels, PanningLaw law, double from, double to) {
    std::array<double, 4> share{};
    for (std::size_t j = 0; j < 4; ++j) {
        const double p = power(std::span{channels[j]}.subspan(static_cast<std::size_t>(from * rate),
                                                              static_cast<std::size_t>((to - from) * rate)));
        share[j] = law == PanningLaw::energy ? p : std::sqrt(p);
    }
    const double all = share[0] + share[1] + share[2] + share[3]; // A and C are left, A and B are up
    return {static_cast<float>(fieldWidth * (share[1] + share[3]) / all),
            static_cast<float>(fieldHeight * (share[0] + share[1]) / all)};
}

TEST_F(LastingFelt, PhantomFollowsARollingBall) {
    constexpr double length = 1.8, window = 0.05;
    HapticFixture wood{349.0, 106.99, true, 10.0};
    wood.texture.grainMetres = 0.002;
    slope(20.0, wood);
    const b2Body& ball = ballOnSlope(1.0F);
    std::vector<b2Vec2> touches; // after each step of 10 ms
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 182; ++i) {
        attachment.step(0.01F);
        touches.push_back(ball.GetPosition() - 0.25F * b2Vec2{-along.y, along.x});
    }
    attachment.take(events);
    ASSERT_GT(touches.back().x, 0.75F * static_cast<float>(fieldWidth));
    for (const PanningLaw law : {PanningLaw::linear, PanningLaw::energy}) {
        const test::Channels channels = felt(events, law, length);
        for (double t = 0.2; t + window < length; t += window) {
            const b2Vec2 truth = touches[static_cast<std::size_t>((t + 0.5 * window) * 100.0) - 1];
            const b2Vec2 phantom = centroid(channels, law, t, t + window);
            EXPECT_NEAR(phantom.x, truth.x, 0.03 * fieldWidth) << t;
            EXPECT_NEAR(phantom.y, truth.y, 0.03 * fieldHeight) << t;
        }
    }
}

TEST_F(LastingFelt, RidgesPeakAtSpeedBySpacing) {
    HapticFixture ridged{250.0, 60.0, true, 10.0};
    ridged.texture = {0.002, 1.0, GrainPattern::regular};
    slope(0.0, ridged, 0.0F);
    ballOnSlope(0.0F, 0.4F);
    std::vector<CollisionEvent> events = run(300);
    const test::Channels channels = felt(events, PanningLaw::linear, 2.5);
    const std::vector<double> samples(channels[0].begin() + rate / 2, channels[0].end()); // 2 s
    const std::vector<double> bins = magnitudes(samples);
    const double perBin = 0.5 * rate / static_cast<double>(bins.size() - 1);
    const auto highest =
        std::ranges::max_element(bins.begin() + static_cast<std::ptrdiff_t>(20.0 / perBin), bins.end());
    EXPECT_NEAR(static_cast<double>(highest - bins.begin()) * perBin, 200.0, 2.0);
}

// Grains become events as they are found, or by a list where times are looked at first: the same events, in
// 400 random worlds.

class Yard {
public:
    explicit Yard(std::uint32_t seed)
        : random_{seed} {
        b2EdgeShape floor;
        floor.SetTwoSided({-20.0F, 0.0F}, {20.0F, 0.0F});
        give(addStill(world_, floor), true);
        for (int i = 0; i < 6; ++i) addBody(static_cast<float>(i));
    }
    /// Events of both attachments after so many steps.
    void run(int steps, std::vector<CollisionEvent>& direct, std::vector<CollisionEvent>& listed) {
        for (int i = 0; i < steps; ++i) {
            if (i % 20 == 0) world_.SetGravity({4.0F * drawn() - 2.0F, -9.8F});
            listed_.beginStep(0.01);
            direct_.step(0.01F);
            listed_.endStep();
            direct_.take(direct);
            listed_.take(listed);
        }
    }

private:
    float drawn() { return static_cast<float>(random_() % 1000) / 1000.0F; }
    void give(const b2Fixture& fixture, bool isSource) {
        HapticFixture values{200.0, 40.0, isSource, 5.0, static_cast<Voice>(random_() % 3)};
        values.texture.grainMetres = random_() % 3 == 0 ? 0.0 : 0.001 + 0.02 * static_cast<double>(drawn());
        values.texture.pattern = random_() % 2 == 0 ? GrainPattern::random : GrainPattern::regular;
        values.gain = random_() % 6 == 0 ? 0.0 : 1.0;
        if (random_() % 3 == 0) values.overtones[1] = {500.0, 60.0, 0.5};
        ASSERT_TRUE(direct_.set(fixture, values));
        ASSERT_TRUE(listed_.set(fixture, values));
    }
    void addBody(float x) {
        const float speed = 3.0F * drawn() - 1.5F;
        const b2CircleShape disc = discOf(0.25F);
        b2PolygonShape box;
        box.SetAsBox(0.3F, 0.2F);
        const bool isDisc = random_() % 2 == 0;
        b2Fixture& fixture = addTo(world_, isDisc ? static_cast<const b2Shape&>(disc) : box,
                                   {1.2F * x - 3.0F, 0.3F}, {speed, 0.0F});
        fixture.SetFriction(drawn());
        give(fixture, random_() % 2 == 0);
    }

    std::mt19937 random_;
    b2World world_{{0.0F, -9.8F}};
    Attachment direct_{world_};
    Attachment listed_{world_, {.settlingSeconds = 1.0e-12}}; // leaves nothing out, but looks at every time
};

TEST(TwoWaysOfGrains, MakeTheSameEvents) {
    std::size_t grains = 0;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        std::vector<CollisionEvent> direct, listed;
        Yard{seed}.run(60, direct, listed);
        ASSERT_EQ(direct, listed) << "world " << seed;
        for (const CollisionEvent& event : direct) grains += event.source.kind != ContactKind::hit ? 1 : 0;
    }
    EXPECT_GT(grains, 10'000U);
}

} // namespace physvib::lasting_contacts_test
