// SPDX-License-Identifier: MIT
// Hits handed on through rows and stacks of touching bodies, against the bodies' own change of momentum.
#include "AttachedWorld.h"
#include "Contacts/ImpactTimings.h"
#include <algorithm>

namespace physvib::onset_impacts_test {

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
    std::vector<b2Fixture*> balls;
    std::vector<std::int32_t> ids;
};

TEST_P(OnsetImpactsRow, LastBallFeelsItsOwnImpulseOnce) {
    const CollisionEvent event = only(100);
    const double own = momentumOf(*balls[4]);
    EXPECT_EQ(event.source.fixture, ids[4]);
    EXPECT_EQ(event.source.other, ids[3]);
    EXPECT_GT(own, 0.5);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, own, 0.02 * own);
    EXPECT_NEAR(event.amplitude, own / massKg(*balls[4]), 0.02 * event.amplitude); // Eq. 5.4
    EXPECT_NEAR(seconds(event), (1.0 + 0.499 - 0.5) / 3.0, 0.01);
    EXPECT_NEAR(event.x, 0.499 * 3.5, 0.02);
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
    give(*balls[4], object);
    EXPECT_TRUE(run(25).empty());
    EXPECT_EQ(attachment.set(*balls[4], camera).id, ids[4]);
    EXPECT_EQ(run(30).size(), 1U);
    give(*balls[4], object);
    give(ball(-1.0F, 0.0F, 8.0F, 0.0F, GetParam()), object);
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
    b2Fixture& falling = give(ball(0.0F, 1.5F, 0.0F, -3.0F, 0.0F), object);
    const CollisionEvent event = only(50);
    EXPECT_EQ(event.source.fixture, ground);
    EXPECT_EQ(event.source.other, lower);
    const double momentum = massKg(falling) * std::sqrt(9.0 + 2.0 * 10.0 * (1.5 - 0.749));
    EXPECT_NEAR(event.source.impulseNewtonSeconds, momentum, 0.05 * momentum);
}

TEST_F(OnsetImpactsWorld, RestingNeighboursFeelNothing) {
    world.SetGravity({0.0F, -10.0F});
    world.SetAllowSleeping(false);
    b2Fixture& ground = give(floor(), object);
    for (int i = 0; i < 4; ++i)
        give(ball(0.0F, 0.249F + 0.498F * static_cast<float>(i), 0.0F, 0.0F, 0.0F), object);
    run(50);
    give(ground, camera);
    for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        if (body->GetType() == b2_dynamicBody) give(*body->GetFixtureList(), camera);
    const std::int32_t roof = attachment.set(ball(5.0F, 0.249F, 0.0F, 0.0F, 0.0F), camera).id;
    for (const CollisionEvent& event : run(200)) EXPECT_EQ(event.source.fixture, roof);
    // strikes another stack on the same floor
    give(ball(5.0F, 2.0F, 0.0F, 0.0F, 0.0F), object);
    bool isStruck = false;
    for (const CollisionEvent& event : run(100)) {
        isStruck = isStruck || event.source.fixture == roof;
        EXPECT_TRUE(event.source.fixture == roof || event.source.fixture == 0) << event.source.fixture;
    }
    EXPECT_TRUE(isStruck);
}

TEST_F(OnsetImpactsWorld, WeightOnACameraThatIsNewIsNoStrike) {
    world.SetGravity({0.0F, -10.0F});
    b2Fixture& ground = give(floor(), object);
    b2Fixture& heavy = ball(0.0F, 0.249F, 0.0F, 0.0F, 0.0F);
    heavy.SetDensity(1000.0F);
    heavy.GetBody()->ResetMassData();
    give(heavy, object);
    run(50);
    b2Fixture& small = ball(0.0F, 0.76F, 0.0F, -5.0F, 0.0F); // strikes in the next step
    const double momentum = massKg(small) * 5.0;
    give(small, object);
    give(ground, camera);
    for (const CollisionEvent& event : run(50))
        EXPECT_LT(event.source.impulseNewtonSeconds, 1.2 * momentum); // the weight is 200 kg 0.1 m/s = 20 N s
}

TEST_F(OnsetImpactsWorld, StrikesOfOneStepDoNotMultiplyWhatIsHandedOn) {
    b2Fixture& last = give(ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    for (const float y : {0.3F, -0.3F}) // two balls strike the first of the row at the same time
        give(ball(-1.9F, y, 3.0F, 0.0F, 0.0F), object);
    expectOne(run(60), last);
}

TEST_F(OnsetImpactsWorld, StrikesOfSuccessiveStepsShareWhatIsHandedOn) {
    b2Fixture& last = give(ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    give(ball(-1.9F, 0.3F, 3.0F, 0.0F, 0.0F), object);
    give(ball(-1.93F, -0.3F, 3.0F, 0.0F, 0.0F), object); // one step behind
    double sum = 0.0;
    for (const CollisionEvent& event : run(60)) sum += event.source.impulseNewtonSeconds;
    const double own = momentumOf(last);
    EXPECT_GT(own, 1.0);
    EXPECT_NEAR(sum, own, 0.05 * own);
}

TEST_F(OnsetImpactsWorld, ReactionOfAWallToADirectStrikeIsNoSecondOne) {
    b2Fixture& wall = give(edge({0.25F, -5.0F}, {0.25F, 5.0F}), object);
    give(ball(0.0F, 0.0F, 1.0F, 0.0F, 0.0F), camera);
    run(10);
    give(ball(-1.0F, 0.0F, 3.0F, 0.0F, 0.0F), object);
    EXPECT_EQ(run(60).size(), 1U);
}

TEST_F(OnsetImpactsWorld, PushThroughOldContactsIsNoStrikeThoughThereIsOneElsewhere) {
    b2Fixture& pushed = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    b2Fixture& last = ball(0.499F, 0.0F, 0.0F, 0.0F, 0.0F);
    give(pushed, object);
    give(last, camera);
    give(ball(0.0F, 5.0F, 0.0F, 0.0F, 0.0F), object);
    give(ball(-1.0F, 5.0F, 3.0F, 0.0F, 0.0F), object); // strikes in the step from 0.17 s
    run(16);
    pushed.GetBody()->ApplyLinearImpulseToCenter({5.0F, 0.0F}, true);
    const auto events = run(10);
    EXPECT_GT(last.GetBody()->GetLinearVelocity().x, 1.0F);
    EXPECT_TRUE(events.empty());
}

TEST_F(OnsetImpactsWorld, MiddleOfARowFeelsOnlyWhatItKeeps) {
    b2Fixture& first = ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
    b2Fixture& middle = ball(0.499F, 0.0F, 0.0F, 0.0F, 0.0F);
    give(first, object);
    give(middle, camera);
    give(ball(0.998F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    give(ball(-1.0F, 0.0F, 6.0F, 0.0F, 0.0F), object);
    expectOne(run(60), middle);
}

TEST_F(OnsetImpactsWorld, ContactOfTheStepBeforeHandsOnInFull) {
    b2Fixture& last = give(ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    // touches in the second step, gently
    give(ball(-0.5005F, 0.0F, 0.1F, 0.0F, 0.0F), object);
    give(ball(-1.0455F, 0.0F, 3.0F, 0.0F, 0.0F), object); // strikes in the third
    expectOne(run(20), last, 0.08);                       // 0.05 m/s of it were gentle
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
            give(*row.back(), x > 0.2F ? camera : object);
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
    const CollisionEvent event = only(76); // the strike, and the step in which it has come through
    EXPECT_EQ(event.source.other, 3);
    const double spin = static_cast<double>(balls[4]->GetBody()->GetAngularVelocity());
    // about the hinge
    const double inertia = massKg(*balls[4]) * static_cast<double>(length * length + 0.5F * radius * radius);
    const double own = inertia * spin / static_cast<double>(length);
    EXPECT_GT(own, 1.0);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, own, 0.02 * own);
}

TEST_F(OnsetImpactsWorld, BulletsAreHandedOnToo) {
    b2Fixture& last = give(ball(0.0F, 0.0F, 0.0F, 0.0F, 0.0F), camera);
    give(ball(-0.499F, 0.0F, 0.0F, 0.0F, 0.0F), object);
    b2Fixture& bullet = ball(-3.0F, 0.0F, 45.0F, 0.0F, 0.0F); // 0.45 m per step
    bullet.GetBody()->SetBullet(true);
    give(bullet, object);
    const auto events = run(60);
    expectOne(events, last);
    EXPECT_NEAR(seconds(events.at(0)), (3.0 - 0.999) / 45.0, 0.01);
}

} // namespace physvib::onset_impacts_test
