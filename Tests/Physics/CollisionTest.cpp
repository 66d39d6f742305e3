// SPDX-License-Identifier: MIT
// A collision is what goes beyond load: what must be felt, and what must not, with the figures of a pencil.
#include "AttachedWorld.h"
#include "Contacts/ImpactTimings.h"
#include <algorithm>

namespace physvib::collision_test {

/// Gravity of 10 m/s^2 and a floor with a camera; nothing bounces, nothing sleeps.
class Collisions : public AttachedWorld {
protected:
    Collisions() {
        world.SetGravity({0.0F, -10.0F});
        world.SetAllowSleeping(false);
    }
    b2Fixture& block(b2Vec2 centre, b2Vec2 half, float density = 10.0F) {
        b2PolygonShape shape;
        shape.SetAsBox(half.x, half.y);
        b2Fixture& fixture = addTo(world, shape, centre, {0.0F, 0.0F}, density);
        fixture.SetFriction(0.9F);
        return fixture;
    }
    static double strongest(const std::vector<CollisionEvent>& events) {
        double most = 0.0;
        for (const CollisionEvent& event : events) most = std::max(most, event.source.impulseNewtonSeconds);
        return most;
    }
};

TEST_F(Collisions, HeadOfAPoleThatTopplesIsFelt) {
    give(floor(), camera);
    const float length = 4.0F, half = 0.05F;
    b2Fixture& pole = block({0.0F, 0.5F * length}, {half, 0.5F * length});
    pole.GetBody()->SetAngularVelocity(-0.3F);
    give(pole, object);
    double headSpeed = 0.0;
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 400 && events.empty(); ++i) {
        headSpeed = std::max(
            headSpeed,
            -static_cast<double>(pole.GetBody()->GetLinearVelocityFromLocalPoint({0.0F, 0.5F * length}).y));
        attachment.step(0.01F);
        attachment.take(events);
    }
    ASSERT_EQ(events.size(), 1U);
    EXPECT_GT(headSpeed, 5.0);
    EXPECT_NEAR(events[0].x, length, 0.3); // at the head, not at the foot
    // About the foot: I w = J l, I = m l^2 / 3; gravity adds 3/2 g dt to the head, and half the weight.
    const double expected = massKg(pole) * ((headSpeed + 1.5 * 10.0 * 0.01) / 3.0 + 0.5 * 10.0 * 0.01);
    EXPECT_NEAR(events[0].source.impulseNewtonSeconds, expected, 0.05 * expected);
}

TEST_F(Collisions, TippedCrateThatFallsBackIsFelt) {
    give(floor(), camera);
    b2Fixture& crate = give(block({0.0F, 0.5F}, {0.5F, 0.5F}), object);
    EXPECT_TRUE(run(50).empty());                      // it was created at rest
    crate.GetBody()->ApplyAngularImpulse(12.0F, true); // one corner lifts
    const auto events = run(150);
    ASSERT_GE(events.size(), 1U);
    EXPECT_GT(strongest(events), 0.5);
}

TEST_F(Collisions, EveryDominoIsFeltToFallOnce) {
    constexpr int count = 10;
    std::vector<std::int32_t> ids;
    const std::int32_t ground = attachment.set(floor(), camera).id;
    std::vector<b2Fixture*> dominos;
    for (int i = 0; i < count; ++i) {
        dominos.push_back(&block({0.6F * static_cast<float>(i), 0.5F}, {0.05F, 0.5F}));
        ids.push_back(attachment.set(*dominos.back(), camera).id);
    }
    run(20);
    dominos.front()->GetBody()->ApplyLinearImpulse({4.0F, 0.0F}, {0.0F, 1.0F}, true);
    const auto events = run(600);
    double struckAt = 0.0;
    for (int i = 1; i < count; ++i) { // each is struck by the one before it
        const auto isFall = [&](const CollisionEvent& event) {
            return event.source.fixture == ids[static_cast<std::size_t>(i)] &&
                   event.source.other == ids[static_cast<std::size_t>(i - 1)];
        };
        const auto fall = std::find_if(events.begin(), events.end(), isFall);
        ASSERT_NE(fall, events.end()) << i;
        EXPECT_GT(seconds(*fall), struckAt) << i; // one after the other
        struckAt = seconds(*fall);
        // Once: what follows within a tenth of a second is a faint rattle; later both come to lie, which is
        // another collision.
        for (auto later = fall + 1; later != events.end(); ++later)
            if (isFall(*later) && seconds(*later) < struckAt + 0.1)
                EXPECT_LT(later->source.impulseNewtonSeconds, 0.5 * fall->source.impulseNewtonSeconds) << i;
    }
    EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                            [&](const CollisionEvent& event) { return event.source.fixture == ground; }));
}

/// Lets bodies pass a platform until told otherwise.
class Gate : public b2ContactListener {
public:
    void PreSolve(b2Contact* contact, const b2Manifold*) override { contact->SetEnabled(isShut); }
    bool isShut = false;
};

TEST_F(Collisions, ContactEnabledLateIsFeltWhenItPushes) {
    Gate gate;
    world.SetContactListener(&gate); // after the attachment: it is heard all the same
    give(floor(), camera);
    b2Fixture& falling = give(ball(0.0F, 0.4F, 0.0F, -4.0F, 0.0F), object);
    EXPECT_TRUE(run(5).empty()); // sinks in
    gate.isShut = true;
    const double momentum = massKg(falling) * -static_cast<double>(falling.GetBody()->GetLinearVelocity().y);
    const CollisionEvent event = only(10);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, momentum, 0.05 * momentum);
}

TEST_F(Collisions, ContactThatBeginsWhileTimeStandsIsFeltWhenItGoesOn) {
    world.SetGravity({0.0F, 0.0F});
    give(floor(), camera);
    b2Fixture& falling = give(ball(0.0F, 0.25F, 0.0F, -3.0F, 0.0F), object);
    for (int i = 0; i < 5; ++i) attachment.step(0.0F);
    EXPECT_EQ(attachment.timeNs(), 0);
    const CollisionEvent event = only(5);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, massKg(falling) * 3.0, 0.01 * massKg(falling) * 3.0);
}

TEST_F(Collisions, HitsOfStepsThatAreNotToldAreFeltAtTheNextThatIs) {
    give(floor(), camera);
    b2Fixture& falling = give(ball(0.0F, 0.5F, 0.0F, -3.0F, 0.0F), object);
    for (int i = 0; i < 20; ++i) world.Step(0.01F, 8, 3); // a game that pauses our part
    const CollisionEvent event = only(3);
    EXPECT_EQ(event.timeNs, 0);
    EXPECT_GT(event.source.impulseNewtonSeconds, 2.9 * massKg(falling));
}

/// Over the seams of a flat chain with ghost vertices, at a gravity scale.
class CollisionsOnAChain : public Collisions, public testing::WithParamInterface<float> {
protected:
    b2Fixture& chain() {
        std::vector<b2Vec2> points;
        // this winding: solid from above
        for (int i = 0; i <= 100; ++i) points.push_back({50.0F - static_cast<float>(i), 0.0F});
        b2ChainShape shape;
        shape.CreateChain(points.data(), static_cast<int>(points.size()), {51.0F, 0.0F}, {-51.0F, 0.0F});
        return addStill(world, shape);
    }
};

TEST_P(CollisionsOnAChain, BallThatRollsFeelsNoSeams) {
    give(chain(), camera);
    b2Fixture& rolling = ball(-20.0F, 0.25F, 6.0F, 0.0F, 0.0F);
    rolling.GetBody()->SetGravityScale(GetParam());
    give(rolling, camera);
    EXPECT_TRUE(run(400).empty());
    EXPECT_GT(rolling.GetBody()->GetPosition().x, -5.0F); // over many of them
}

TEST_P(CollisionsOnAChain, CartFeelsNoSeams) {
    give(chain(), camera);
    b2Fixture& deck = block({-20.0F, 0.7F}, {1.0F, 0.1F});
    deck.GetBody()->SetGravityScale(GetParam());
    give(deck, object);
    for (const float x : {-20.8F, -19.2F}) {
        b2Fixture& wheel = ball(x, 0.25F, 0.0F, 0.0F, 0.0F);
        wheel.GetBody()->SetGravityScale(GetParam());
        give(wheel, camera);
        b2RevoluteJointDef axle;
        axle.Initialize(deck.GetBody(), wheel.GetBody(), {x, 0.25F});
        axle.enableMotor = true;
        axle.maxMotorTorque = 100.0F;
        axle.motorSpeed = -20.0F;
        world.CreateJoint(&axle);
    }
    run(100); // settles
    EXPECT_TRUE(run(400).empty());
    EXPECT_GT(deck.GetBody()->GetPosition().x, -10.0F);
}
INSTANTIATE_TEST_SUITE_P(GravityScales, CollisionsOnAChain, testing::Values(1.0F, 3.0F));

TEST_F(Collisions, WhatIsCreatedAtRestIsNotFelt) {
    give(floor(), camera);
    for (int i = 0; i < 5; ++i)
        give(block({0.0F, 0.505F + 1.01F * static_cast<float>(i)}, {0.5F, 0.5F}), camera);
    EXPECT_TRUE(run(200).empty());
}

TEST_F(Collisions, GentleHitsAreNotFelt) {
    world.SetGravity({0.0F, 0.0F});
    give(floor(), camera);
    give(ball(0.0F, 0.3F, 0.0F, -0.09F, 1.0F), camera);
    EXPECT_TRUE(run(200).empty());
}

class CollisionsBesideAMachine : public Collisions, public testing::WithParamInterface<ImpactTiming> {};

TEST_P(CollisionsBesideAMachine, SmallStrikeDoesNotHandOnItsHumming) {
    ImpactSettings settings = attachment.settings();
    settings.timing = GetParam();
    attachment.configure(settings);
    give(floor(), camera);
    b2Fixture& machine = give(block({50.0F, 0.5F}, {0.5F, 0.5F}, 600.0F), object);
    // lie, and carry the pebbles
    for (const float x : {0.0F, 3.0F}) give(ball(x, 0.25F, 0.0F, 0.0F, 0.0F), object);
    run(50);
    double pebbles = 0.0;
    for (const float x : {0.0F, 3.0F}) {
        b2Fixture& pebble = ball(x, 0.9F, 0.0F, -1.0F, 0.0F);
        pebble.SetDensity(0.15F);
        pebble.GetBody()->ResetMassData();
        give(pebble, object);
        // it falls at 2 m/s, and lies for the two steps of a collision
        pebbles += massKg(pebble) * (2.0 + 2 * 0.1);
    }
    for (int i = 0; i < 60; ++i) { // it shakes the floor by 60 N s
        machine.GetBody()->ApplyLinearImpulseToCenter({0.0F, i % 2 == 0 ? -60.0F : 30.0F}, true);
        for (const CollisionEvent& event : run(0))
            EXPECT_LT(event.source.impulseNewtonSeconds, 1.05 * pebbles);
    }
}
INSTANTIATE_TEST_SUITE_P(, CollisionsBesideAMachine,
                         testing::Values(ImpactTiming::onset, ImpactTiming::release));

} // namespace physvib::collision_test
