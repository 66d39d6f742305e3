// SPDX-License-Identifier: MIT
// Hits handed on through rows and stacks of touching bodies, against the bodies' own change of momentum.
#include "AttachedWorld.h"
#include "Contacts/ImpactTimings.h"
#include <algorithm>

namespace physvib {
namespace {

/// A ball at 3 m/s strikes a row of four that touch, the last of which has the camera.
class OnsetImpactsRow : public AttachedWorld, public testing::WithParamInterface<float> {
protected:
    OnsetImpactsRow() {
        for (int i = 0; i < 5; ++i) {
            const bool isStriker = i == 0;
            balls.push_back(&ball(isStriker ? -1.0F : 0.499F * static_cast<float>(i), 0.0F,
                                  isStriker ? 3.0F : 0.0F, 0.0F, GetParam()));
            ids.push_back(attachment.set(*balls.back(), i == 4 ? camera : object).id);
        }
    }
    double ownImpulse() const {
        return massKg(*balls[4]) * static_cast<double>(balls[4]->GetBody()->GetLinearVelocity().Length());
    }

    std::vector<b2Fixture*> balls;
    std::vector<std::int32_t> ids;
};

TEST_P(OnsetImpactsRow, LastBallFeelsItsOwnImpulseOnce) {
    const auto events = run(100);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].source.fixture, ids[4]);
    EXPECT_EQ(events[0].source.other, ids[3]);
    EXPECT_GT(ownImpulse(), 0.5);
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, ownImpulse(), 0.02 * ownImpulse());
    EXPECT_NEAR(events[0].amplitude, ownImpulse() / massKg(*balls[4]), 0.02 * events[0].amplitude); // Eq. 5.4
    EXPECT_NEAR(seconds(events[0]), (1.0 + 0.499 - 0.5) / 3.0, 0.01);
    EXPECT_NEAR(events[0].x, 0.499 * 3.5, 0.02);
}

TEST_P(OnsetImpactsRow, WithoutItsMiddleBallFeelsNothingUntilTheGapIsClosed) {
    world.DestroyBody(balls[2]->GetBody());
    const auto events = run(40); // struck at 0.33 s; the gap of 0.5 m takes longer
    EXPECT_GT(balls[1]->GetBody()->GetLinearVelocity().x, 0.1F);
    EXPECT_TRUE(events.empty());
}

TEST_P(OnsetImpactsRow, SecondClusterElsewhereFeelsNothing) {
    std::vector<std::int32_t> others;
    for (int i = 0; i < 3; ++i)
        others.push_back(attachment.set(ball(0.499F * static_cast<float>(i), 3.0F, 0.0F, 0.0F), camera).id);
    for (const CollisionEvent& event : run(100))
        EXPECT_EQ(std::count(others.begin(), others.end(), event.source.fixture), 0);
}

TEST_P(OnsetImpactsRow, CameraSwitchedOnLaterFeelsFromThenOn) {
    (void)attachment.set(*balls[4], object);
    EXPECT_TRUE(run(25).empty());
    EXPECT_EQ(attachment.set(*balls[4], camera).id, ids[4]);
    EXPECT_EQ(run(30).size(), 1U);
    (void)attachment.set(*balls[4], object);
    b2Fixture& late = ball(-1.0F, 0.0F, 8.0F, 0.0F, GetParam());
    (void)attachment.set(late, object);
    EXPECT_TRUE(run(100).empty());
}

INSTANTIATE_TEST_SUITE_P(Restitutions, OnsetImpactsRow, testing::Values(0.0F, 0.5F, 1.0F));

using OnsetImpactsWorld = AttachedWorld;

/// A ball on the floor, and one that falls onto it.
TEST_F(OnsetImpactsWorld, FloorFeelsWhatIsDroppedOnAStack) {
    world.SetGravity({0.0F, -10.0F});
    const std::int32_t ground = attachment.set(floor(), camera).id;
    const std::int32_t lower = attachment.set(ball(0.0F, 0.249F, 0.0F, 0.0F, 0.0F), object).id;
    run(50);
    b2Fixture& falling = ball(0.0F, 1.5F, 0.0F, -3.0F, 0.0F);
    (void)attachment.set(falling, object);
    const auto events = run(50);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].source.fixture, ground);
    EXPECT_EQ(events[0].source.other, lower);
    const double momentum = massKg(falling) * std::sqrt(9.0 + 2.0 * 10.0 * (1.5 - 0.749));
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, momentum, 0.05 * momentum);
}

TEST_F(OnsetImpactsWorld, RestingNeighboursFeelNothing) {
    world.SetGravity({0.0F, -10.0F});
    world.SetAllowSleeping(false);
    b2Fixture& ground = floor();
    (void)attachment.set(ground, object);
    for (int i = 0; i < 4; ++i)
        (void)attachment.set(ball(0.0F, 0.249F + 0.498F * static_cast<float>(i), 0.0F, 0.0F, 0.0F), object);
    run(50);
    (void)attachment.set(ground, camera);
    for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        if (body->GetType() == b2_dynamicBody) (void)attachment.set(*body->GetFixtureList(), camera);
    const std::int32_t roof = attachment.set(ball(5.0F, 0.249F, 0.0F, 0.0F, 0.0F), camera).id;
    for (const CollisionEvent& event : run(200)) EXPECT_EQ(event.source.fixture, roof);
    // strikes another stack on the same floor
    (void)attachment.set(ball(5.0F, 2.0F, 0.0F, 0.0F, 0.0F), object);
    bool isStruck = false;
    for (const CollisionEvent& event : run(100)) {
        isStruck = isStruck || event.source.fixture == roof;
        EXPECT_TRUE(event.source.fixture == roof || event.source.fixture == 0) << event.source.fixture;
    }
    EXPECT_TRUE(isStruck);
}

TEST_F(OnsetImpactsWorld, WeightOnACameraThatIsNewIsNoStrike) {
    world.SetGravity({0.0F, -10.0F});
    b2Fixture& ground = floor();
    (void)attachment.set(ground, object);
    b2Fixture& heavy = ball(0.0F, 0.249F, 0.0F, 0.0F, 0.0F);
    heavy.SetDensity(1000.0F);
    heavy.GetBody()->ResetMassData();
    (void)attachment.set(heavy, object);
    run(50);
    b2Fixture& small = ball(0.0F, 0.76F, 0.0F, -5.0F, 0.0F); // strikes in the next step
    const double momentum = massKg(small) * 5.0;
    (void)attachment.set(small, object);
    (void)attachment.set(ground, camera);
    for (const CollisionEvent& event : run(50))
        EXPECT_LT(event.source.impulseNewtonSeconds, 1.2 * momentum); // the weight is 200 kg 0.1 m/s = 20 N s
}

TEST_F(OnsetImpactsWorld, FallingNeighboursFeelNothing) {
    world.SetGravity({0.0F, -10.0F});
    b2Fixture& struck = ball(0.499F, 0.0F, 0.0F, 0.0F);
    struck.SetFriction(0.0F);
    (void)attachment.set(ball(0.0F, 0.0F, 0.0F, 0.0F), camera);
    (void)attachment.set(struck, object);
    (void)attachment.set(ball(0.499F, 0.8F, 0.0F, -3.0F), object); // from above, while all fall
    EXPECT_TRUE(run(30).empty());
    EXPECT_LT(struck.GetBody()->GetLinearVelocity().y, -3.1F - 1.5F);
}

TEST_F(OnsetImpactsWorld, StrikesOfOneStepDoNotMultiplyWhatIsHandedOn) {
    b2Fixture& last = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(last, camera);
    (void)attachment.set(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    for (const float y : {0.3F, -0.3F}) // two balls strike the first of the row at the same time
        (void)attachment.set(ball(-1.9F, y, 3.0F, 0.0F, 0.0F), object);
    expectOne(run(60), last);
}

TEST_F(OnsetImpactsWorld, StrikesOfSuccessiveStepsShareWhatIsHandedOn) {
    b2Fixture& last = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(last, camera);
    (void)attachment.set(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    (void)attachment.set(ball(-1.9F, 0.3F, 3.0F, 0.0F, 0.0F), object);
    (void)attachment.set(ball(-1.93F, -0.3F, 3.0F, 0.0F, 0.0F), object); // one step behind
    double sum = 0.0;
    for (const CollisionEvent& event : run(60)) sum += event.source.impulseNewtonSeconds;
    const double own = momentumOf(last);
    EXPECT_GT(own, 1.0);
    EXPECT_NEAR(sum, own, 0.05 * own);
}

TEST_F(OnsetImpactsWorld, ReactionOfAWallToADirectStrikeIsNoSecondOne) {
    const b2Fixture& wall = edge({0.25F, -5.0F}, {0.25F, 5.0F});
    (void)attachment.set(wall, object);
    (void)attachment.set(ball(0.0F, 0.0F, 1.0F, 0.0F, 0.0F), camera);
    run(10);
    (void)attachment.set(ball(-1.0F, 0.0F, 3.0F, 0.0F, 0.0F), object);
    EXPECT_EQ(run(60).size(), 1U);
}

TEST_F(OnsetImpactsWorld, PushThroughOldContactsIsNoStrikeThoughThereIsOneElsewhere) {
    b2Fixture& pushed = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    b2Fixture& last = ball(0.499F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(pushed, object);
    (void)attachment.set(last, camera);
    (void)attachment.set(ball(0.0F, 5.0F, 0.0F, 0.0F, 0.0F), object);
    (void)attachment.set(ball(-1.0F, 5.0F, 3.0F, 0.0F, 0.0F), object); // strikes in the step from 0.17 s
    run(16);
    pushed.GetBody()->ApplyLinearImpulseToCenter({5.0F, 0.0F}, true);
    const auto events = run(10);
    EXPECT_GT(last.GetBody()->GetLinearVelocity().x, 1.0F);
    EXPECT_TRUE(events.empty());
}

TEST_F(OnsetImpactsWorld, MiddleOfARowFeelsOnlyWhatItKeeps) {
    b2Fixture& first = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    b2Fixture& middle = ball(0.499F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(first, object);
    (void)attachment.set(middle, camera);
    (void)attachment.set(ball(0.998F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    (void)attachment.set(ball(-1.0F, 0.0F, 6.0F, 0.0F, 0.0F), object);
    expectOne(run(60), middle);
}

TEST_F(OnsetImpactsWorld, ContactOfTheStepBeforeHandsOnInFull) {
    b2Fixture& last = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(last, camera);
    // touches in the second step, gently
    (void)attachment.set(ball(-0.5005F, 0.0F, 0.1F, 0.0F, 0.0F), object);
    (void)attachment.set(ball(-1.0455F, 0.0F, 3.0F, 0.0F, 0.0F), object); // strikes in the third
    expectOne(run(20), last, 0.08);                                       // 0.05 m/s of it were gentle
}

class OnsetImpactsDestroyed : public AttachedWorld, public testing::WithParamInterface<int> {
protected:
    std::size_t eventsOf(bool isKept) {
        ImpactSettings settings = unity();
        settings.keepsHitsOfDestroyed = isKept;
        attachment.configure(settings);
        std::vector<b2Fixture*> row;
        const float y = isKept ? 0.0F : 9.0F; // two worlds in one
        for (const float x : {-1.0F, 0.0F, 0.499F}) {
            row.push_back(&ball(x, y, x < 0.0F ? 3.0F : 0.0F, 0.0F, 0.0F));
            (void)attachment.set(*row.back(), x > 0.2F ? camera : object);
        }
        while (row[1]->GetBody()->GetLinearVelocity().x < 0.1F) attachment.step(0.01F);
        world.DestroyBody(row[static_cast<std::size_t>(GetParam())]->GetBody());
        return run(20).size();
    }
};

TEST_P(OnsetImpactsDestroyed, BodyOfTheRowTakesWhatIsHandedOnAlongUnlessItIsKept) {
    EXPECT_EQ(eventsOf(false), 0U);
    EXPECT_EQ(eventsOf(true), 1U);
}
INSTANTIATE_TEST_SUITE_P(StrikerNeighbourCamera, OnsetImpactsDestroyed, testing::Values(0, 1, 2));

/// Five pendulums that touch; the first falls from 57 degrees. Box2D solves the row at once: the others leave
/// together.
TEST_F(OnsetImpactsWorld, LastPendulumOfANewtonsCradleFeelsItsOwnImpulseOnce) {
    constexpr float length = 2.0F, radius = 0.25F;
    world.SetGravity({0.0F, -10.0F});
    const b2BodyDef def;
    b2Body* const beam = world.CreateBody(&def);
    std::vector<b2Fixture*> balls;
    for (int i = 0; i < 5; ++i) {
        const float x = 0.499F * static_cast<float>(i), angle = i == 0 ? -1.0F : 0.0F;
        balls.push_back(&ball(x + length * std::sin(angle), -length * std::cos(angle), 0.0F, 0.0F, 1.0F));
        balls.back()->SetFriction(0.0F);
        b2RevoluteJointDef hinge;
        hinge.Initialize(beam, balls.back()->GetBody(), {x, 0.0F});
        world.CreateJoint(&hinge);
        (void)attachment.set(*balls.back(), i == 4 ? camera : object, i);
    }
    const auto events = run(76); // the strike, and the step in which it has come through
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].source.other, 3);
    const double spin = static_cast<double>(balls[4]->GetBody()->GetAngularVelocity());
    // about the hinge
    const double inertia = massKg(*balls[4]) * static_cast<double>(length * length + 0.5F * radius * radius);
    const double own = inertia * spin / static_cast<double>(length);
    EXPECT_GT(own, 1.0);
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, own, 0.02 * own);
}

TEST_F(OnsetImpactsWorld, BulletsAreHandedOnToo) {
    b2Fixture& last = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    (void)attachment.set(last, camera);
    (void)attachment.set(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    b2Fixture& bullet = ball(-3.0F, 0.0F, 45.0F, 0.0F, 0.0F); // 0.45 m per step
    bullet.GetBody()->SetBullet(true);
    (void)attachment.set(bullet, object);
    const auto events = run(60);
    ASSERT_EQ(events.size(), 1U);
    const double own = momentumOf(last);
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, own, 0.02 * own);
    EXPECT_NEAR(seconds(events[0]), (3.0 - 0.999) / 45.0, 0.01);
}

} // namespace
} // namespace physvib
