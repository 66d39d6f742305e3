// SPDX-License-Identifier: MIT
// What games do to worlds, and what must not break: listeners, lives and addresses that come and go.
#include "AttachedWorld.h"
#include <limits>
#include <memory>

namespace physvib::foreign_world_test {

class ForeignWorld : public AttachedWorld {
protected:
    /// A ball that strikes a floor with a camera.
    void land() {
        give(floor(), camera);
        give(ball(0.0F, 0.5F, 0.0F, -5.0F), object);
    }
};

class Listener : public b2ContactListener, public b2DestructionListener {
public:
    void BeginContact(b2Contact*) override { ++begins; }
    void SayGoodbye(b2Joint*) override {}
    void SayGoodbye(b2Fixture*) override { ++goodbyes; }
    int begins = 0, goodbyes = 0;
};

TEST_F(ForeignWorld, WithoutAListenerIsFeltAsWell) {
    b2World bare({0.0F, 0.0F});
    bare.SetContactListener(nullptr);
    Attachment onBare(bare, unity());
    onBare.step(0.01F);
    land();
    world.SetContactListener(nullptr);
    EXPECT_EQ(run(20).size(), 1U);
}

TEST_F(ForeignWorld, ListenerSetLaterIsCalledAndTheWorldIsFelt) {
    Listener later;
    land();
    world.SetContactListener(&later);
    world.SetDestructionListener(&later);
    EXPECT_EQ(run(20).size(), 1U);
    EXPECT_EQ(later.begins, 1);
    world.DestroyBody(world.GetBodyList());
    EXPECT_EQ(later.goodbyes, 1);
}

/// Hands every call on to the listener it found, as we do.
class Forwarding : public b2ContactListener {
public:
    explicit Forwarding(b2World& world)
        : behind(world.GetContactManager().m_contactListener) {
        world.SetContactListener(this);
    }
    void BeginContact(b2Contact* contact) override {
        ++begins;
        behind->BeginContact(contact);
    }
    void EndContact(b2Contact* contact) override { behind->EndContact(contact); }
    void PreSolve(b2Contact* contact, const b2Manifold* before) override {
        behind->PreSolve(contact, before);
    }
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
        behind->PostSolve(contact, impulse);
    }
    b2ContactListener* behind;
    int begins = 0;
};

TEST_F(ForeignWorld, ListenerThatHandsCallsBackIsCalledOnce) {
    Forwarding game(world);
    land();
    EXPECT_EQ(run(20).size(), 1U);
    EXPECT_EQ(game.begins, 1);
}

TEST_F(ForeignWorld, FixtureMadeBetweenBeginAndStepIsFelt) {
    give(floor(), camera);
    run(3);
    attachment.beginStep(0.01);
    std::vector<b2Fixture*> late;
    for (int i = 0; i < 100; ++i) late.push_back(&ball(0.6F * static_cast<float>(i), 0.26F, 0.0F, -5.0F));
    for (b2Fixture* each : late) give(*each, camera);
    world.Step(0.01F, 8, 3);
    attachment.endStep();
    std::size_t count = 0;
    for (const CollisionEvent& event : run(3)) count += event.source.fixture == 0 ? 1 : 0;
    EXPECT_EQ(count, 100U);
}

class DestroyedBeforeTheEnd : public AttachedWorld, public testing::WithParamInterface<ImpactTiming> {};

TEST_P(DestroyedBeforeTheEnd, FixturesAndBodiesAreFeltByWhatTheStepKnew) {
    ImpactSettings settings = unity();
    settings.location = ImpactLocation::fixture;
    settings.timing = GetParam();
    attachment.configure(settings);
    give(floor(), object);
    Listener own;
    for (int round = 0; round < 3; ++round) {
        b2Fixture& struck = give(ball(0.0F, 0.26F, 0.0F, -5.0F), camera);
        attachment.beginStep(0.01);
        world.Step(0.01F, 8, 3);
        if (round == 0) struck.GetBody()->DestroyFixture(&struck);
        if (round == 1) world.DestroyBody(struck.GetBody());
        if (round == 2) {
            world.SetDestructionListener(&own); // and nobody tells us
            world.DestroyBody(struck.GetBody());
        }
        attachment.endStep();
        EXPECT_EQ(run(10).size(), 1U) << round;
    }
}
INSTANTIATE_TEST_SUITE_P(Timings, DestroyedBeforeTheEnd,
                         testing::Values(ImpactTiming::onset, ImpactTiming::release));

TEST(ForeignWorldLife, WorldMayEndBeforeItsAttachment) {
    auto world = std::make_unique<b2World>(b2Vec2{0.0F, -10.0F});
    const auto attachment = std::make_unique<Attachment>(*world);
    attachment->step(0.01F);
    world.reset();
}

TEST(ForeignWorldLife, AttachmentsMayEndInAnyOrderAndTheGameIsStillCalled) {
    Listener game;
    b2World world({0.0F, -10.0F});
    world.SetContactListener(&game);
    b2EdgeShape edge;
    edge.SetTwoSided({-9.0F, 0.0F}, {9.0F, 0.0F});
    addStill(world, edge);
    for (int i = 0; i < 100; ++i) Attachment{world}.step(0.01F);
    auto first = std::make_unique<Attachment>(world), second = std::make_unique<Attachment>(world);
    first.reset();
    addTo(world, discOf(0.2F), {0.0F, 0.3F}, {0.0F, 0.0F}, 1.0F);
    for (int i = 0; i < 50; ++i) second->step(0.01F);
    EXPECT_EQ(game.begins, 1);
    second->detach();
    second.reset();
}

TEST_F(ForeignWorld, OriginMovesAndEventsStayInTheField) {
    give(floor(), camera);
    give(ball(2.0F, 0.26F, 0.0F, -5.0F), object);
    attachment.step(0.01F); // struck, and not yet final
    attachment.shiftOrigin({1000.0F, 0.0F});
    const auto events = run(2);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].x, 2.0, 0.01);
    give(ball(-995.0F, 0.26F, 0.0F, -5.0F), object);
    const auto later = run(2);
    ASSERT_EQ(later.size(), 1U);
    EXPECT_NEAR(later[0].x, 5.0, 0.01);
}

/// Events of a row whose end feels what is handed on, and of a ball that is struck itself; the origin moves
/// by `perStep` after each step.
std::vector<CollisionEvent> feltWhileTheOriginMoves(ImpactTiming timing, b2Vec2 perStep) {
    b2World world({0.0F, 0.0F});
    ImpactSettings settings = unity();
    settings.timing = timing;
    Attachment attachment(world, settings);
    const auto add = [&](float x, float y, float speed, const HapticFixture& values) {
        (void)attachment.set(addTo(world, discOf(0.25F), {x, y}, {speed, 0.0F}), values);
    };
    for (int i = 0; i < 5; ++i) add(0.499F * static_cast<float>(i), 0.0F, 0.0F, i == 4 ? camera : object);
    add(-1.0F, 0.0F, 3.0F, object);
    add(1.0F, 2.0F, 0.0F, camera);
    add(-0.5F, 2.0F, 3.0F, object);
    for (int i = 0; i < 40; ++i) attachment.step(0.01F), attachment.shiftOrigin(perStep);
    std::vector<CollisionEvent> events;
    attachment.take(events);
    return events;
}

TEST(MovingOrigin, LeavesEveryEventOfEitherTimingWhereItWas) {
    for (const ImpactTiming timing : {ImpactTiming::onset, ImpactTiming::release}) {
        const auto still = feltWhileTheOriginMoves(timing, {0.0F, 0.0F}),
                   moved = feltWhileTheOriginMoves(timing, {8.0F, -4.0F});
        ASSERT_EQ(still.size(), 2U);
        ASSERT_EQ(moved.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(moved[i].x, still[i].x, 0.01);
            EXPECT_NEAR(moved[i].y, still[i].y, 0.01);
        }
    }
}

TEST_F(ForeignWorld, FieldMayLieAnywhereAndMove) {
    give(floor(), camera);
    ImpactSettings settings = unity();
    settings.fieldOrigin = {-41.0F, -1.0F};
    attachment.configure(settings);
    give(ball(-41.0F, 0.26F, 0.0F, -5.0F), object);
    auto events = run(2);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].x, 0.0, 0.01);
    EXPECT_NEAR(events[0].y, 1.0, 0.01);
    settings.fieldOrigin = {3.0F, 0.0F};
    settings.fieldRadians = 0.5F * b2_pi; // the device lies on its side
    attachment.configure(settings);
    give(ball(3.0F, 0.26F, 0.0F, -5.0F), object);
    give(ball(8.0F, 0.26F, 0.0F, -5.0F), object);
    events = run(2);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_NEAR(std::min(events[0].y, events[1].y), -5.0, 0.01);
}

TEST_F(ForeignWorld, AddressUsedAgainInheritsNothing) {
    give(floor(), camera);
    for (int i = 0; i < 50; ++i) {
        b2Fixture& first = give(ball(0.0F, 5.0F, 0.0F, 0.0F), {100.0, 10.0, true, 0.0, Voice::own});
        world.SetDestructionListener(nullptr);
        if (i % 2 == 0) run(0); // notices what happened to the listener, or not
        b2Body* const body = first.GetBody();
        if (i % 3 == 0)
            body->DestroyFixture(&first);
        else if (i % 2 == 0)
            world.DestroyBody(body);
        else
            continue; // without a step in between nobody could know
        const b2Fixture& heir = ball(0.0F, 7.0F, 0.0F, 0.0F);
        EXPECT_EQ(attachment.find(heir), nullptr) << i;
    }
}

TEST_F(ForeignWorld, RefusesWhatCannotBePlayed) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    b2Fixture& ground = floor();
    for (const HapticFixture& bad : {HapticFixture{nan, 10.0},
                                     {-5.0, 10.0},
                                     {1.0e6, 10.0},
                                     {100.0, nan},
                                     {100.0, 5000.0},
                                     {100.0, 10.0, true, nan},
                                     {100.0, 10.0, true, -1.0}}) {
        const SetResult result = attachment.set(ground, bad);
        EXPECT_FALSE(result);
        EXPECT_EQ(result.id, -1);
        EXPECT_EQ(attachment.find(ground), nullptr);
    }
    EXPECT_EQ(attachment.set(ground, camera, 7).id, 7);
    EXPECT_FALSE(attachment.set(ball(0.0F, 1.0F, 0.0F, 0.0F), camera, 7)) << "one id twice";
}

TEST_F(ForeignWorld, FlushGivesEventsAtOnce) {
    give(floor(), camera);
    give(ball(0.0F, 0.26F, 0.0F, -5.0F), object);
    std::vector<CollisionEvent> events;
    attachment.step(0.01F);
    attachment.take(events);
    EXPECT_TRUE(events.empty());
    attachment.flush(events);
    EXPECT_EQ(events.size(), 1U);
}

} // namespace physvib::foreign_world_test
