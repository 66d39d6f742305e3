// SPDX-License-Identifier: MIT
// PhysVib in the world of a stranger, who has listeners and user data and destroys at will.
#include "Physics/Attachment.h"
#include "AttachedWorld.h"
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace physvib::attachment_test {

/// Counts its calls and remembers who has been hit, as games do.
class Game : public b2ContactListener, public b2DestructionListener {
public:
    void BeginContact(b2Contact* contact) override {
        ++begins;
        struck = contact->GetFixtureB()->GetBody();
    }
    void EndContact(b2Contact*) override { ++ends; }
    void PreSolve(b2Contact*, const b2Manifold*) override { ++preSolves; }
    void PostSolve(b2Contact*, const b2ContactImpulse*) override { ++postSolves; }
    void SayGoodbye(b2Joint*) override { ++lostJoints; }
    void SayGoodbye(b2Fixture*) override { ++lostFixtures; }
    bool operator==(const Game& other) const {
        return begins == other.begins && ends == other.ends && preSolves == other.preSolves &&
               postSolves == other.postSolves;
    }

    int begins = 0, ends = 0, preSolves = 0, postSolves = 0, lostJoints = 0, lostFixtures = 0;
    b2Body* struck = nullptr;
};

/// A world that knows nothing of PhysVib: a ball that bounces on a floor, both with user data.
struct Foreign {
    Foreign() {
        world.SetContactListener(&game);
        world.SetDestructionListener(&game);
        b2BodyDef def;
        b2EdgeShape edge;
        edge.SetTwoSided({-5.0F, 0.0F}, {5.0F, 0.0F});
        b2FixtureDef fixture;
        fixture.shape = &edge;
        fixture.userData.pointer = 17;
        floor = world.CreateBody(&def)->CreateFixture(&fixture);
        ball = &add(1.0F);
    }
    b2Fixture& add(float y) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {0.0F, y};
        def.userData.pointer = 42;
        b2CircleShape circle;
        circle.m_radius = 0.2F;
        b2FixtureDef fixture;
        fixture.shape = &circle;
        fixture.density = 5.0F;
        fixture.restitution = 0.6F;
        fixture.userData.pointer = 43;
        return *world.CreateBody(&def)->CreateFixture(&fixture);
    }

    Game game;
    b2World world{{0.0F, -9.8F}};
    b2Fixture* floor;
    b2Fixture* ball;
};

/// That world with an attachment.
struct Felt : Foreign {
    explicit Felt(const HapticFixture& ofFloor = camera, const ImpactSettings& settings = unity())
        : attachment{world, settings} {
        (void)attachment.set(*floor, ofFloor);
    }
    std::vector<CollisionEvent> step(int steps, float stepSeconds = 1.0F / 60.0F) {
        std::vector<CollisionEvent> events;
        for (int i = 0; i < steps; ++i) {
            attachment.step(stepSeconds);
            attachment.take(events);
        }
        return events;
    }
    /// Destroys what was struck in this step.
    void destroyStruck() {
        if (b2Body* const body = std::exchange(game.struck, nullptr)) world.DestroyBody(body);
    }
    Attachment attachment;
};

TEST(Attachment, ForeignWorldIsFeltAndKeepsItsCallsAndUserData) {
    Foreign alone;
    Felt felt;
    (void)felt.attachment.set(*felt.ball, object);
    const auto events = felt.step(120);
    for (int i = 0; i < 120; ++i) alone.world.Step(1.0F / 60.0F, 8, 3);
    EXPECT_GE(events.size(), 3U);
    EXPECT_TRUE(felt.game == alone.game);
    EXPECT_GE(felt.game.begins, 3);
    EXPECT_GE(felt.game.ends, 3);
    EXPECT_GE(felt.game.preSolves, 3);
    EXPECT_GE(felt.game.postSolves, 3);
    EXPECT_EQ(felt.ball->GetUserData().pointer, 43U);
    EXPECT_EQ(felt.ball->GetBody()->GetUserData().pointer, 42U);
    EXPECT_EQ(felt.floor->GetUserData().pointer, 17U);
    EXPECT_EQ(felt.ball->GetBody()->GetPosition(), alone.ball->GetBody()->GetPosition()); // to the bit
}

TEST(Attachment, LeavesTheWorldWithTheListenersItHadOrThatWereSetLater) {
    for (const bool areSetLater : {false, true}) {
        Foreign foreign;
        Game later;
        Game& game = areSetLater ? later : foreign.game;
        Attachment attachment(foreign.world);
        EXPECT_NE(foreign.world.GetContactManager().m_contactListener, &foreign.game);
        if (areSetLater) {
            foreign.world.SetContactListener(&later);
            foreign.world.SetDestructionListener(&later);
        }
        attachment.detach();
        EXPECT_EQ(foreign.world.GetContactManager().m_contactListener, &game);
        foreign.world.DestroyBody(foreign.ball->GetBody());
        EXPECT_EQ(game.lostFixtures, 1);
    }
}

TEST(Attachment, HandsOnGoodbyes) {
    Foreign foreign;
    Attachment attachment(foreign.world);
    b2Fixture& other = foreign.add(3.0F);
    b2DistanceJointDef joint;
    joint.Initialize(foreign.ball->GetBody(), other.GetBody(), {0.0F, 1.0F}, {0.0F, 3.0F});
    foreign.world.CreateJoint(&joint);
    foreign.world.DestroyBody(other.GetBody());
    EXPECT_EQ(foreign.game.lostJoints, 1);
    EXPECT_EQ(foreign.game.lostFixtures, 1);
}

TEST(Attachment, AttachesToAWorldInWhichBodiesTouchAlready) {
    Foreign foreign;
    b2Fixture& upper = foreign.add(3.0F);
    upper.SetRestitution(0.0F);
    foreign.ball->SetRestitution(0.0F);
    for (int i = 0; i < 30; ++i) foreign.world.Step(1.0F / 60.0F, 8, 3); // the ball lies, the other falls
    Attachment attachment(foreign.world, unity());
    (void)attachment.set(*foreign.floor, camera);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 60; ++i) attachment.step(1.0F / 60.0F);
    attachment.take(events);
    EXPECT_EQ(events.size(), 1U); // handed on by the one that lies
}

/// As one destroys who may not do so inside the callback.
TEST(Attachment, HitsOfWhatIsDestroyedRightAfterTheStepAreFeltIfTheyAreKept) {
    for (const bool isKept : {false, true})
        for (const auto& [ofFloor, ofBall] :
             {std::pair{&object, &camera}, {&camera, &object}, {&camera, nullptr}}) {
            ImpactSettings settings = unity();
            settings.keepsHitsOfDestroyed = isKept;
            Felt felt{*ofFloor, settings};
            if (ofBall != nullptr) (void)felt.attachment.set(*felt.ball, *ofBall);
            std::vector<CollisionEvent> events;
            for (int i = 0; i < 120; ++i) {
                felt.attachment.step(1.0F / 60.0F);
                felt.destroyStruck();
                felt.attachment.take(events);
            }
            EXPECT_EQ(felt.game.lostFixtures, 1);
            EXPECT_EQ(events.size(), isKept ? 1U : 0U) << ofFloor->isCamera << (ofBall != nullptr);
        }
}

TEST(Attachment, SurvivesFixturesThatVanishUnnoticed) {
    Felt felt;
    felt.world.SetDestructionListener(nullptr); // nobody tells
    for (int i = 0; i < 40; ++i) {
        b2Fixture& ball = felt.add(0.5F);
        (void)felt.attachment.set(ball, camera);
        felt.step(17); // most lie on the floor by then
        if (i % 2 == 0)
            felt.world.DestroyBody(ball.GetBody());
        else
            ball.GetBody()->DestroyFixture(&ball);
        felt.step(1);
        EXPECT_EQ(felt.attachment.find(felt.add(9.0F)), nullptr); // often at the same address
    }
    EXPECT_GE(felt.step(60).size(), 1U);
}

TEST(Attachment, FixtureRemovedBeforeItIsDestroyedLeavesNothingToItsHeir) {
    Felt felt{object};
    const std::int32_t id = felt.attachment.set(*felt.ball, camera).id;
    b2Body& body = *felt.ball->GetBody();
    felt.attachment.remove(*felt.ball);
    EXPECT_EQ(felt.attachment.find(*felt.ball), nullptr);
    body.DestroyFixture(felt.ball);
    b2Fixture& heir = felt.add(1.0F);
    EXPECT_EQ(felt.attachment.find(heir), nullptr);
    EXPECT_TRUE(felt.step(120).empty());
    EXPECT_GT(felt.attachment.set(heir, camera).id, id); // ids are not used again
}

TEST(Attachment, RemovedFixtureTakesItsEventsAlong) {
    Felt felt;
    while (felt.game.begins == 0) felt.attachment.step(1.0F / 60.0F);
    felt.attachment.remove(*felt.floor);
    EXPECT_TRUE(felt.step(10).empty());
}

TEST(Attachment, BodiesOfDestructionsBetweenStepAndEndAreSafe) {
    Felt felt;
    (void)felt.attachment.set(*felt.ball, camera);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 60; ++i) {
        felt.attachment.beginStep(1.0 / 60.0);
        felt.world.Step(1.0F / 60.0F, 8, 3);
        felt.destroyStruck();
        felt.attachment.endStep();
        felt.attachment.take(events);
    }
    EXPECT_EQ(felt.game.lostFixtures, 1);
    EXPECT_EQ(events.size(), 2U); // what breaks is felt, by both
}

TEST(Attachment, ContactsAtTheAddressOfDestroyedOnesAreFelt) {
    Felt felt;
    felt.world.DestroyBody(felt.ball->GetBody());
    for (int round = 0; round < 4; ++round) {
        std::vector<b2Body*> balls;
        for (int i = 0; i < 3; ++i) balls.push_back(felt.add(0.4F).GetBody());
        for (int i = 0; i < 3; ++i)
            balls[static_cast<std::size_t>(i)]->SetTransform({static_cast<float>(i), 0.4F}, 0.0F);
        if (round % 2 == 0) std::reverse(balls.begin(), balls.end()); // another address is the next free one
        for (const int begins = felt.game.begins; felt.game.begins == begins;) {
            felt.attachment.beginStep(0.01);
            felt.world.Step(0.01F, 8, 3);
            if (felt.game.begins != begins)
                for (b2Body* body : balls) felt.world.DestroyBody(body);
            felt.attachment.endStep();
        }
        b2Fixture& next = felt.add(0.4F);
        // of those that broke, and its first bounce
        EXPECT_EQ(felt.step(30, 0.01F).size(), 4U) << round;
        felt.world.DestroyBody(next.GetBody());
    }
}

TEST(Attachment, AttachmentsOfTwoWorldsDoNotDisturbEachOther) {
    Felt one, two, alone;
    two.ball->SetRestitution(0.2F);
    for (Felt* felt : {&one, &two, &alone}) (void)felt->attachment.set(*felt->ball, object);
    std::vector<CollisionEvent> events, others;
    for (int i = 0; i < 120; ++i) {
        one.attachment.step(1.0F / 60.0F);
        two.attachment.step(1.0F / 60.0F);
        one.attachment.take(events);
        two.attachment.take(others);
    }
    EXPECT_EQ(events, alone.step(120));
    EXPECT_NE(events, others);
    EXPECT_GE(others.size(), 1U);
}

TEST(Attachment, TwoOfTheSameWorldFeelTheSame) {
    Foreign foreign;
    Attachment inner(foreign.world, unity());
    Attachment outer(foreign.world, unity());
    for (Attachment* attachment : {&inner, &outer}) (void)attachment->set(*foreign.floor, camera);
    std::vector<CollisionEvent> innerEvents, outerEvents;
    for (int i = 0; i < 60; ++i) {
        for (Attachment* attachment : {&inner, &outer}) attachment->beginStep(1.0 / 60.0);
        foreign.world.Step(1.0F / 60.0F, 8, 3);
        for (Attachment* attachment : {&inner, &outer}) attachment->endStep();
        inner.take(innerEvents);
        outer.take(outerEvents);
    }
    EXPECT_EQ(innerEvents, outerEvents);
    EXPECT_GE(innerEvents.size(), 1U);
}

TEST(Attachment, StepsOfDifferentLengthsAddUpToTheTime) {
    Felt felt;
    (void)felt.attachment.set(*felt.ball, object);
    std::vector<CollisionEvent> events;
    std::int64_t expected = 0;
    for (int i = 0; events.empty() && i < 200; ++i) {
        const float length = i % 3 == 0 ? 0.004F : 0.011F;
        felt.attachment.step(length);
        expected += std::llround(static_cast<double>(length) * 1.0e9);
        felt.attachment.take(events);
        EXPECT_EQ(felt.attachment.timeNs(), expected);
    }
    ASSERT_EQ(events.size(), 1U);
    const double fall = 1.0 - 0.2 - static_cast<double>(b2_polygonRadius);
    EXPECT_NEAR(seconds(events[0]), std::sqrt(2.0 * fall / 9.8), 0.006); // Box2D falls half a step ahead
}

/// Two bodies that move sink into each other in the step before the one that tells of it, maybe a long one.
TEST_F(AttachedWorld, HitsOfTwoMovingBodiesAreTimedInStepsOfAnyLength) {
    constexpr int count = 40;
    for (int i = 0; i < count; ++i) {
        (void)attachment.set(ball(-2.0F - 0.01F * static_cast<float>(i), static_cast<float>(i), 3.0F, 0.0F),
                             camera, i);
        (void)attachment.set(ball(2.0F, static_cast<float>(i), -2.0F, 0.0F), object, count + i);
    }
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 80; ++i) attachment.step(i % 2 == 0 ? 0.004F : 0.033F);
    attachment.take(events);
    ASSERT_EQ(events.size(), static_cast<std::size_t>(count));
    for (const CollisionEvent& event : events)
        EXPECT_NEAR(seconds(event), (3.5 + 0.01 * event.source.fixture) / 5.0, 1.0e-5);
}

TEST(Attachment, StepsThatTakeNoTimeDoNothing) {
    Foreign foreign;
    Attachment attachment(foreign.world);
    for (const float length : {0.0F, -1.0F, std::nanf("")}) attachment.step(length);
    EXPECT_EQ(attachment.timeNs(), 0);
    EXPECT_EQ(foreign.ball->GetBody()->GetPosition().y, 1.0F);
}

TEST(Attachment, StepCountClockDoesNotDrift) {
    Foreign foreign;
    Attachment attachment(foreign.world);
    for (std::int64_t i = 1; i <= 60; ++i) {
        attachment.beginStepUntil(i * 1'000'000'000 / 60);
        foreign.world.Step(1.0F / 60.0F, 8, 3);
        attachment.endStep();
    }
    EXPECT_EQ(attachment.timeNs(), 1'000'000'000);
}

TEST(Attachment, EventsAreHandedOutSortedAndOnceSettled) {
    Felt felt;
    (void)felt.attachment.set(*felt.ball, camera);
    for (int i = 2; i < 30; ++i) (void)felt.attachment.set(felt.add(static_cast<float>(i)), camera);
    std::int64_t latest = 0;
    std::size_t count = 0;
    for (int i = 0; i < 600; ++i)
        for (const CollisionEvent& event : felt.step(1)) {
            EXPECT_GE(event.timeNs, latest);
            EXPECT_LT(event.timeNs, felt.attachment.settledNs());
            latest = event.timeNs;
            ++count;
        }
    EXPECT_GT(count, 50U);
    EXPECT_EQ(felt.attachment.drops(), 0U);
}

TEST(Attachment, NormalisationFollowsTheWorldUnlessItIsGiven) {
    Foreign foreign;
    ImpactSettings settings;
    settings.fieldWidthMetres = 5.0;
    Attachment attachment(foreign.world, settings);
    const auto expectHand = [&](double massKg) {
        attachment.step(1.0F / 60.0F);
        EXPECT_DOUBLE_EQ(attachment.impactModel().handMassKg, massKg);
    };
    expectHand(massKg(*foreign.ball));
    EXPECT_DOUBLE_EQ(attachment.impactModel().normalisation, 0.1); // Eq. 5.7
    (void)attachment.set(*foreign.floor, camera);                  // 10 kg
    expectHand(10.0);
    b2Fixture& heavy = foreign.add(4.0F);
    heavy.SetDensity(1000.0F);
    heavy.GetBody()->ResetMassData();
    expectHand(massKg(heavy));
    heavy.GetBody()->SetEnabled(false); // out of the game, not out of the world
    expectHand(10.0);
    heavy.GetBody()->SetEnabled(true);
    expectHand(massKg(heavy));
    foreign.world.DestroyBody(heavy.GetBody());
    expectHand(10.0);
    foreign.floor->GetBody()->SetType(b2_dynamicBody);
    expectHand(std::max(massKg(*foreign.floor), massKg(*foreign.ball)));
    foreign.floor->GetBody()->SetType(b2_staticBody);
    expectHand(10.0);
    settings.normalisation = 0.5;
    settings.handMassKg = 3.0;
    settings.driveGain = 2.0;
    attachment.configure(settings);
    attachment.step(1.0F / 60.0F);
    EXPECT_DOUBLE_EQ(attachment.impactModel().amplitude(1.0, 1.0), 2.0 * 0.5 / 4.0);
}

TEST(Attachment, IdsAreInOrderOrTheCallers) {
    Foreign foreign;
    Attachment attachment(foreign.world);
    EXPECT_EQ(attachment.set(*foreign.floor, camera).id, 0);
    (void)attachment.set(*foreign.ball, object, 7);
    EXPECT_EQ(attachment.set(*foreign.floor, object).id, 0);
    EXPECT_EQ(attachment.set(foreign.add(3.0F), object).id, 8);
    ASSERT_NE(attachment.find(*foreign.ball), nullptr);
    EXPECT_EQ(attachment.find(*foreign.ball)->frequencyHz, object.frequencyHz);
}

TEST(Attachment, RefusesNonsense) {
    Foreign foreign, other;
    Attachment attachment(foreign.world);
    EXPECT_FALSE(attachment.set(*other.ball, camera));
    void (*const changes[])(ImpactSettings&,
                            double){[](ImpactSettings& s, double x) { s.fieldWidthMetres = x; },
                                    [](ImpactSettings& s, double x) { s.handMassKg = x; },
                                    [](ImpactSettings& s, double x) { s.normalisation = x; },
                                    [](ImpactSettings& s, double x) { s.driveGain = x; },
                                    [](ImpactSettings& s, double x) { s.thresholdMetresPerSecond = x; }};
    for (const auto change : changes)
        for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
            ImpactSettings settings;
            change(settings, bad);
            EXPECT_THROW(Attachment(other.world, settings), std::invalid_argument);
            EXPECT_THROW(attachment.configure(settings), std::invalid_argument);
        }
    EXPECT_EQ(other.world.GetContactManager().m_contactListener, &other.game); // nothing half attached
}

} // namespace physvib::attachment_test
