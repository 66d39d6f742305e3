// SPDX-License-Identifier: MIT
// Which contacts strike, when and how hard, in worlds whose hits are known by hand.
#include "AttachedWorld.h"
#include "Contacts/CollisionRecorder.h"

namespace physvib::collision_catcher_test {

using CollisionCatcherWorld = AttachedWorld;

TEST_F(CollisionCatcherWorld, TwoMovingCamerasMeetAtTheRightMoment) {
    give(ball(-1.0F, 1.0F, 3.0F, 0.0F), camera);
    give(ball(1.0F, 1.0F, -4.0F, 0.0F), camera);
    const auto events = run(50);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[1].source.fixture, 1);
    EXPECT_NEAR(seconds(events[0]), 1.5 / 7.0, 1.0e-5); // closing a gap of 1.5 m at 7 m/s
    EXPECT_NEAR(events[0].x, -0.75 + 3.0 * 1.5 / 7.0, 0.01);
    const double mass = events[0].source.massKg;
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, mass / 2.0 * 7.0 * 1.5, 1.0e-3); // reduced mass
}

TEST_F(CollisionCatcherWorld, HitsOfTheTimeOfImpactPassAreTimedWithinTheirStep) {
    give(floor(), camera);
    give(ball(0.0F, 2.0F, 0.0F, -13.7F), object);
    const CollisionEvent event = only(30);
    EXPECT_NEAR(seconds(event), 1.75 / 13.7, 1.0e-5);
}

TEST_F(CollisionCatcherWorld, SecondImpactWithinOneStepIsTimedToo) {
    // Into the corner of floor and wall at 15 and 12 m/s: both touched between 100 and 110 ms.
    give(floor(), camera);
    give(edge({0.0F, -100.0F}, {0.0F, 100.0F}), camera);
    b2Fixture& fast = ball(0.25F + 12.0F * 0.1075F, 0.25F + 15.0F * 0.1025F, -12.0F, -15.0F);
    fast.SetFriction(0.0F);
    give(fast, object);
    const auto events = run(30);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[1].source.fixture, 1);
    EXPECT_NEAR(seconds(events[0]), 0.1025, 1.0e-4);
    EXPECT_NEAR(seconds(events[1]), 0.1075, 1.0e-4);
}

TEST_F(CollisionCatcherWorld, FrictionIsPartOfTheImpulse) {
    give(floor(), camera);
    b2Fixture& sliding = give(ball(0.0F, 0.5F, 5.0F, -5.0F), object);
    const b2Vec2 before = sliding.GetBody()->GetLinearVelocity();
    const CollisionEvent event = only(10);
    const b2Vec2 change = sliding.GetBody()->GetLinearVelocity() - before;
    EXPECT_LT(change.x, -0.1F); // or there was no friction to see
    EXPECT_NEAR(event.source.impulseNewtonSeconds, sliding.GetBody()->GetMass() * change.Length(), 1.0e-3);
}

TEST_F(CollisionCatcherWorld, FlatLandingSumsBothPointsAndIsFeltInTheMiddle) {
    give(floor(), camera);
    b2Fixture& landing = give(box(0.5F, 0.0F, 5.0F), object);
    const CollisionEvent event = only(20);
    const double expected = landing.GetBody()->GetMass() * 5.0 * 1.5;
    EXPECT_NEAR(event.source.impulseNewtonSeconds, expected, 0.01 * expected);
    EXPECT_NEAR(event.x, 0.0, 1.0e-3);
}

TEST_F(CollisionCatcherWorld, TiltedLandingIsTimedByTheLowerCorner) {
    give(floor(), camera);
    for (const float tilt : {0.003F, -0.003F}) {
        const double start = static_cast<double>(attachment.timeNs()) * 1.0e-9;
        b2Fixture& landing = give(box(0.48F, tilt, 5.0F), object);
        const auto events = run(12);
        ASSERT_GE(events.size(), 1U);
        EXPECT_NEAR(seconds(events[0]) - start, 0.096, 2.0e-4);
        world.DestroyBody(landing.GetBody());
    }
}

TEST_F(CollisionCatcherWorld, PassesOfAStepAreOneHit) {
    give(floor(), camera);
    give(ball(0.0F, 0.26F, 0.0F, -5.0F, 0.0F), object);
    ASSERT_EQ(run(1).size(), 1U);
    b2Contact* contact = world.GetContactList();
    b2ContactListener& recorder = *world.GetContactManager().m_contactListener;
    attachment.beginStep(0.01);
    const b2ContactImpulse impulse{{3.0F, 0.0F}, {4.0F, 0.0F}, 1};
    const b2Manifold none{};
    contact->GetFixtureB()->GetBody()->SetLinearVelocity({0.0F, -5.0F});
    for (int pass = 0; pass < 2; ++pass) {
        recorder.BeginContact(contact);
        recorder.PreSolve(contact, &none);
        recorder.PostSolve(contact, &impulse);
    }
    attachment.endStep();
    const CollisionEvent event = only(0);
    EXPECT_DOUBLE_EQ(event.source.impulseNewtonSeconds, 10.0); // twice (3, 4)
}

TEST_F(CollisionCatcherWorld, BodiesThatStartInEachOtherHitAtTimeZero) {
    give(floor(), camera);
    give(ball(0.0F, 0.2F, 0.0F, -1.0F), object);
    const CollisionEvent event = only(5);
    EXPECT_EQ(event.timeNs, 0);
}

TEST_F(CollisionCatcherWorld, HitsLieAtMostOneStepInThePast) {
    run(9);
    give(floor(), camera);
    give(ball(0.0F, 0.2F, 0.0F, -1.0F), object); // put 50 ms deep into the floor
    const CollisionEvent event = only(5);
    EXPECT_EQ(event.timeNs, 90'000'000);
}

TEST_F(CollisionCatcherWorld, HitsAboveTheThresholdAloneAreStrikes) {
    give(floor(), camera);
    give(ball(0.0F, 0.26F, 0.0F, -0.14F), object);
    EXPECT_TRUE(run(100).empty());
    give(ball(5.0F, 0.26F, 0.0F, -0.16F), object);
    EXPECT_EQ(run(100).size(), 1U);
}

TEST_F(CollisionCatcherWorld, ThresholdCountsTheLighterBody) {
    b2Fixture& light = ball(-0.6F, 1.0F, 0.2F, 0.0F);
    b2Fixture& heavy = ball(0.0F, 1.0F, 0.0F, 0.0F);
    heavy.SetDensity(1.0e5F);
    heavy.GetBody()->ResetMassData();
    give(light, object);
    give(heavy, camera);
    const CollisionEvent event = only(100);
    EXPECT_EQ(event.source.fixture, 1);
}

TEST_F(CollisionCatcherWorld, UnknownFixturesAreFeltButNotNamed) {
    give(floor(), camera);
    ball(0.0F, 0.5F, 0.0F, -5.0F);
    const CollisionEvent event = only(20);
    EXPECT_EQ(event.source.fixture, 0);
    EXPECT_EQ(event.source.other, -1);
}

TEST_F(CollisionCatcherWorld, SensorsAreNotHit) {
    b2Fixture& sensor = floor();
    sensor.SetSensor(true);
    give(sensor, camera);
    give(ball(0.0F, 0.5F, 0.0F, -5.0F), object);
    EXPECT_TRUE(run(50).empty());
}

TEST_F(CollisionCatcherWorld, WeakestContactsAreLeftOutWhereThereIsNoRoomAndCounted) {
    constexpr int balls = static_cast<int>(CollisionRecorder::maxDirectCollisions) + 10;
    give(floor(), camera);
    for (int i = 0; i < balls; ++i)
        give(ball(-90.0F + 0.16F * static_cast<float>(i), 0.24F, 0.0F,
                  i % 100 == 7 && i / 100 < 10 ? -1.0F : -2.0F),
             object);
    b2Filter apart;
    apart.groupIndex = -1;
    for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        if (body->GetType() == b2_dynamicBody) body->GetFixtureList()->SetFilterData(apart);
    const auto events = run(1);
    EXPECT_EQ(events.size(), CollisionRecorder::maxDirectCollisions);
    EXPECT_EQ(attachment.drops(), 10U);
    for (const CollisionEvent& event : events)
        EXPECT_GT(event.source.impulseNewtonSeconds, 1.5 * massKg(*world.GetBodyList()->GetFixtureList()));
}

TEST_F(CollisionCatcherWorld, ContactsOfOthersDoNotTakeTheRoomOfCameras) {
    constexpr int pairs = static_cast<int>(CollisionRecorder::maxDistantCollisions) + 10;
    for (int i = 0; i < pairs; ++i) {
        const auto x = static_cast<float>(i % 100), y = 2.0F + static_cast<float>(i / 100);
        ball(x, y, 0.5F, 0.0F);
        ball(x + 0.4F, y, 0.0F, 0.0F);
    }
    give(floor(), camera);
    give(ball(0.0F, 0.24F, 0.0F, -1.0F), object);
    EXPECT_EQ(run(0).size(), 0U); // not final before the next step
    EXPECT_EQ(attachment.drops(), 10U);
    EXPECT_EQ(run(0).size(), 1U);
}

TEST_F(CollisionCatcherWorld, GravityRaisesTheThresholdOverWhatRestingContactsGet) {
    world.SetGravity({0.0F, -40.0F}); // 0.4 m/s in every step
    give(floor(), camera);
    give(ball(0.0F, 0.249F, 0.0F, 0.0F), object); // begins to touch, and rests
    EXPECT_TRUE(run(100).empty());
    give(ball(5.0F, 0.5F, 0.0F, -2.0F), object);
    EXPECT_FALSE(run(100).empty());
}

// What gravity gives a body in a step is no hit, and presses a balloon from below as a ball from above.
TEST_F(CollisionCatcherWorld, GravityScalesRaiseTheThresholdBySizeAndNotBySign) {
    world.SetGravity({0.0F, -40.0F}); // 0.4 m/s in every step
    give(floor(), camera);
    float x = 0.0F;
    for (const float scale : {0.5F, 1.0F, 3.0F, -0.5F, -1.0F, -3.0F})
        for (const float share : {0.75F, 1.25F}) { // of what it gains in a step
            b2Fixture& pressed =
                ball(x += 2.0F, std::copysign(0.249F, scale), 0.0F, -0.4F * scale * share, 0.0F);
            pressed.GetBody()->SetGravityScale(scale);
            give(pressed, object);
            EXPECT_EQ(run(20).size(), share > 1.0F ? 1U : 0U) << scale << ' ' << share;
        }
}

} // namespace physvib::collision_catcher_test
