// SPDX-License-Identifier: MIT
// The thesis' timing against the solver's impulses and against Eq. 5.2 and 5.3 by hand.
#include "AttachedWorld.h"
#include "Contacts/ImpactTimings.h"

namespace physvib::release_impacts_test {

ImpactSettings settingsOf(ImpactTiming timing) {
    ImpactSettings settings = unity();
    settings.timing = timing;
    return settings;
}

class ReleaseImpactsWorld : public AttachedWorld {
protected:
    ReleaseImpactsWorld() { attachment.configure(release()); }
    static ImpactSettings release() { return settingsOf(ImpactTiming::release); }
};

/// A ball of 0.15 m and 120 kg/m^2 dropped on a camera that is static.
struct Dropped {
    CollisionEvent event;
    double expected; // m v (1 + e)
};
Dropped drop(ImpactTiming timing, float height, float stepSeconds) {
    b2World world({0.0F, -9.8F});
    Attachment attachment(world, settingsOf(timing));
    b2EdgeShape edge;
    edge.SetTwoSided({-1.0F, 0.0F}, {1.0F, 0.0F});
    edge.m_radius = 0.0F;
    (void)attachment.set(addStill(world, edge), camera);
    b2Fixture& ball = addTo(world, discOf(0.15F), {0.0F, height + 0.15F}, {0.0F, 0.0F}, 120.0F);
    ball.SetRestitution(0.688F);
    (void)attachment.set(ball, object);
    std::vector<CollisionEvent> events;
    while (events.empty() && attachment.timeNs() < 2'000'000'000) {
        attachment.step(stepSeconds);
        attachment.take(events);
    }
    const double speed = std::sqrt(2.0 * 9.8 * static_cast<double>(height));
    return {events.empty() ? CollisionEvent{} : events.front(), massKg(ball) * speed * 1.688};
}

class DropHeights : public testing::TestWithParam<float> {};

TEST_P(DropHeights, OnsetIsTheImpulseOfTheBounceAndReleaseNearlyAndLater) {
    const Dropped onset = drop(ImpactTiming::onset, GetParam(), 0.001F),
                  release = drop(ImpactTiming::release, GetParam(), 0.001F);
    EXPECT_NEAR(onset.event.source.impulseNewtonSeconds, onset.expected, 0.005 * onset.expected);
    EXPECT_NEAR(release.event.source.impulseNewtonSeconds, release.expected, 0.02 * release.expected);
    EXPECT_GT(release.event.timeNs, onset.event.timeNs);
    EXPECT_LE(release.event.timeNs, onset.event.timeNs + 10'000'000);
}
INSTANTIATE_TEST_SUITE_P(Metres, DropHeights, testing::Values(1.0F, 2.0F, 3.0F));

TEST_F(ReleaseImpactsWorld, BallThatStaysIsReleasedAfterFiftyMilliseconds) {
    give(floor(), camera);
    b2Fixture& landing = give(ball(0.0F, 0.75F, 0.0F, -5.0F, 0.0F), object);
    const CollisionEvent event = only(50);
    EXPECT_NEAR(seconds(event), 0.1 + 0.05, 1.0e-3);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, massKg(landing) * 5.0, 0.01 * massKg(landing) * 5.0);
}

TEST_F(ReleaseImpactsWorld, ImmovableCameraSumsOverWhatTouchesItEachBodyOnce) {
    give(floor(), camera);
    b2Fixture& landing = give(box(0.5F, 0.0F, 5.0F), object);
    b2CircleShape second; // of the same body, touching at the same time
    second.m_radius = 0.25F + b2_polygonRadius;
    give(*landing.GetBody()->CreateFixture(&second, 0.0F), object);
    const double expected = massKg(landing) * 5.0 * 1.5;
    const auto events = run(50);
    ASSERT_GE(events.size(), 1U);
    for (const CollisionEvent& event : events)
        EXPECT_NEAR(event.source.impulseNewtonSeconds, expected, 0.02 * expected);
}

TEST_F(ReleaseImpactsWorld, SpinCountsOnTopAsInTheThesis) {
    give(floor(), object);
    b2Fixture& sliding = give(ball(0.0F, 0.5F, 5.0F, -5.0F), camera);
    const CollisionEvent event = only(20);
    const b2Body& body = *sliding.GetBody();
    const double mass = massKg(sliding);
    // The time-of-impact pass lets shapes overlap by 3 slops, which shortens the lever by 0.015 m.
    const double lever = 0.25 - 3.0 * static_cast<double>(b2_linearSlop);
    const double spin = static_cast<double>(body.GetInertia() * std::abs(body.GetAngularVelocity())) / lever;
    EXPECT_GT(spin, 0.1); // or there is nothing to see
    // The floor pushes back along -x, and spins the ball clockwise: both parts point the same way.
    const double along = mass * (5.0 - static_cast<double>(body.GetLinearVelocity().x)) + spin;
    const double up = mass * (5.0 + static_cast<double>(body.GetLinearVelocity().y));
    const double expected = std::hypot(along, up);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, expected, 0.01 * expected);
}

TEST_F(ReleaseImpactsWorld, LastBallOfARowFeelsItsOwnImpulseOnce) {
    for (int i = 0; i < 4; ++i) give(ball(0.499F * static_cast<float>(i), 0.0F, 0.0F, 0.0F, 0.0F), object);
    b2Fixture& last = give(ball(0.499F * 4.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(-1.0F, 0.0F, 3.0F, 0.0F, 0.0F), object);
    expectOne(run(100), last);
}

// Two collisions of one step: the row is struck hard at two thirds of it, and lightly at a tenth.
TEST_F(ReleaseImpactsWorld, WhatIsHandedOnIsTheStrongestCollision) {
    for (int i = 0; i < 4; ++i) give(ball(0.499F * static_cast<float>(i), 0.0F, 0.0F, 0.0F, 0.0F), object);
    give(ball(0.499F * 4.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(0.499F, 0.5F + 0.0805F, 0.0F, -0.5F, 0.0F), object);
    give(ball(-1.0F, 0.0F, 3.0F, 0.0F, 0.0F), object);
    const auto events = run(100);
    ASSERT_GE(events.size(), 1U);
    EXPECT_NEAR(seconds(events[0]), 0.5 / 3.0 + 0.05, 0.001);
}

// The row is struck at 0.17 s; what its end receives would be released 50 ms later, but is struck by itself
// meanwhile, and the two cannot be told apart.
TEST_F(ReleaseImpactsWorld, WhoIsStruckMeanwhileFeelsThatAloneAndNotWhatIsHandedOn) {
    for (int i = 0; i < 4; ++i) give(ball(0.499F * static_cast<float>(i), 0.0F, 0.0F, 0.0F, 0.0F), object);
    give(ball(0.499F * 4.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(-1.0F, 0.0F, 3.0F, 0.0F, 0.0F), object);
    give(ball(0.499F * 4.0F, 0.5F + 0.57F, 0.0F, -3.0F, 0.0F), object); // from above, at 0.19 s
    const CollisionEvent event = only(30);
    EXPECT_EQ(event.source.other, 6);
}

// Struck from above while it falls, it falls on with what struck it: as in the thesis all that changes its
// velocity until the release counts, 1.5 m/s by the impact and 0.5 m/s by gravity.
TEST_F(ReleaseImpactsWorld, GravityCountsWhileAnImpactLasts) {
    world.SetGravity({0.0F, -10.0F});
    const double mass = massKg(give(ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera));
    give(ball(0.0F, 0.55F, 0.0F, -3.0F, 0.0F), object);
    EXPECT_NEAR(only(20).source.impulseNewtonSeconds, mass * 2.0, mass * 0.15);
}

TEST_F(ReleaseImpactsWorld, PartnerDestroyedBeforeTheReleaseTakesTheEventAlong) {
    for (const bool keeps : {false, true}) {
        ImpactSettings settings = release();
        settings.keepsHitsOfDestroyed = keeps;
        attachment.configure(settings);
        b2Fixture& ground = give(floor(), camera);
        b2Fixture& landing = give(ball(0.0F, 0.26F, 0.0F, -5.0F, 0.0F), object);
        attachment.step(0.01F);
        attachment.step(0.01F);
        world.DestroyBody(landing.GetBody());
        const auto events = run(1); // at once, not after 50 ms
        EXPECT_EQ(events.size(), keeps ? 1U : 0U);
        EXPECT_TRUE(run(20).empty());
        world.DestroyBody(ground.GetBody());
    }
}

TEST_F(ReleaseImpactsWorld, AnotherTimingForgetsWhatIsUnderWay) {
    give(floor(), camera);
    give(ball(0.0F, 0.26F, 0.0F, -5.0F, 0.0F), object); // stays for longer than 50 ms
    run(1);
    attachment.configure(unity());
    run(1);
    attachment.configure(release());
    EXPECT_TRUE(run(20).empty());
}

class EitherTiming : public AttachedWorld, public testing::WithParamInterface<ImpactTiming> {
protected:
    EitherTiming() {
        attachment.configure(settingsOf(GetParam()));
        world.SetGravity({0.0F, -10.0F});
    }
};

TEST_P(EitherTiming, NeighboursThatFallTogetherFeelNothing) {
    b2Fixture& struck = give(ball(0.499F, 0.0F, 0.0F, 0.0F), object);
    struck.SetFriction(0.0F);
    give(ball(0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(0.499F, 0.8F, 0.0F, -3.0F, GetParam() == ImpactTiming::onset ? 0.5F : 0.0F), object);
    EXPECT_TRUE(run(30).empty());
    EXPECT_LT(struck.GetBody()->GetLinearVelocity().y, -3.1F - 1.5F) << "struck from above";
}

TEST_P(EitherTiming, RestingBallStrikesOnce) {
    world.SetAllowSleeping(false);
    give(floor(), camera);
    give(ball(0.0F, 0.27F, 0.0F, -0.5F), object); // too slow for Box2D to bounce
    EXPECT_EQ(run(1000).size(), 1U);
}
INSTANTIATE_TEST_SUITE_P(, EitherTiming, testing::Values(ImpactTiming::onset, ImpactTiming::release));

} // namespace physvib::release_impacts_test
