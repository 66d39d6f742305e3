// SPDX-License-Identifier: MIT
// Worlds whose owners break the one rule: fixtures are destroyed by DestroyFixture without a word, and their
// bodies then, so that Box2D says nothing of either. That may cost values, never memory: the address
// sanitizer watches, see PlainMemoryTest.cpp. How many worlds and steps: PHYSVIB_SEEDS and PHYSVIB_STEPS of
// the environment; Tests/Physics/freed.sh runs 200 of 1,500 with Box2D built for it.
#include "AttachedWorld.h"
#include <algorithm>
#include <cstdlib>
#include <random>

namespace physvib::broken_rules_test {

TEST_F(AttachedWorld, AStaticBodyThatWentUnheardWeighsNothing) {
    b2Fixture& heavy = edge({-100.0F, -5.0F}, {100.0F, -5.0F});
    HapticFixture values = camera;
    values.staticMassKg = 1000.0;
    give(heavy, values);
    ImpactSettings settings;
    settings.normalisation = 1.0; // the hand's mass is the largest in the world
    attachment.configure(settings);
    ball(0.0F, 1.0F, 0.0F, 0.0F);
    run(1);
    EXPECT_EQ(attachment.impactModel().handMassKg, 1000.0);
    b2Body* const body = heavy.GetBody();
    body->DestroyFixture(&heavy);
    world.DestroyBody(body);
    run(1);
    EXPECT_LT(attachment.impactModel().handMassKg, 10.0);
}

// Its type is a matter of the engine's, which tells nobody where nothing touches.
TEST_F(AttachedWorld, ABodyIsTheHandFromWhenItStandsUntilItCanMove) {
    HapticFixture values = camera;
    values.staticMassKg = 1000.0;
    b2Body& body = *give(ball(0.0F, 0.0F, 0.0F, 0.0F), values).GetBody();
    ImpactSettings settings;
    settings.normalisation = 1.0;
    attachment.configure(settings);
    for (const b2BodyType type :
         {b2_dynamicBody, b2_staticBody, b2_dynamicBody, b2_kinematicBody, b2_dynamicBody}) {
        body.SetType(type);
        run(1);
        EXPECT_EQ(attachment.impactModel().handMassKg == 1000.0, type != b2_dynamicBody) << type;
    }
}

TEST_F(AttachedWorld, AnIdBelowZeroAndADecayThatIsMissingAreRefusedAndNothingIsChanged) {
    b2Fixture& fixture = ball(0.0F, 0.0F, 0.0F, 0.0F);
    EXPECT_EQ(attachment.set(fixture, camera, -5).refusal, "id: expected a number from 0 on");
    EXPECT_EQ(attachment.set(fixture, {.frequencyHz = 200.0, .isCamera = true}).refusal.substr(0, 6),
              "decay:");
    EXPECT_EQ(attachment.find(fixture), nullptr);
    EXPECT_TRUE(attachment.set(fixture, camera, 5));
}

TEST_F(AttachedWorld, WhyNothingIsFeltIsSaid) {
    b2Fixture& slow = ball(0.0F, 0.3F, 0.0F, -0.05F);
    floor();
    (void)run(150);
    const std::string why = attachment.explain();
    EXPECT_NE(why.find("haptic source: set isCamera"), std::string::npos) << why;
    EXPECT_EQ(attachment.counts().withoutSource, attachment.counts().contacts);
    give(slow, camera);
    slow.GetBody()->SetTransform({0.0F, 0.3F}, 0.0F);
    slow.GetBody()->SetLinearVelocity({0.0F, -0.05F});
    EXPECT_TRUE(run(150).empty());
    EXPECT_EQ(attachment.counts().belowThreshold, 1U);
    const std::string now = attachment.explain();
    EXPECT_NE(now.find("slower than the threshold of 0.15 m/s (the strongest impact had 0.075 m/s)"),
              std::string::npos)
        << now;
}

/// Everything is made, changed and destroyed at any time, told and untold.
class Rampage {
public:
    explicit Rampage(unsigned seed)
        : random_(seed) {
        ImpactSettings settings;
        settings.timing = seed % 2 == 0 ? ImpactTiming::onset : ImpactTiming::release;
        settings.location = seed % 4 < 2 ? ImpactLocation::contact : ImpactLocation::fixture;
        settings.keepsHitsOfDestroyed = seed % 3 != 0;
        if (seed % 5 == 0) settings.hitsPerStep = 3;
        attachment_.configure(settings);
        for (int i = 0; i < 25; ++i) add();
    }

    void run(int steps) {
        for (int step = 0; step < steps; ++step) {
            world_.SetGravity({static_cast<float>(choose(31) - 15), static_cast<float>(choose(31) - 20)});
            play();
            if (choose(3) == 0) {
                attachment_.step(0.01F);
            } else {
                attachment_.beginStep(0.01);
                play();
                world_.Step(0.01F, 8, 3);
                play();
                attachment_.endStep();
            }
            attachment_.take(events);
            if (events.size() > 100000) events.clear();
        }
    }
    std::vector<CollisionEvent> events;

private:
    int choose(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    b2Body* any() {
        if (world_.GetBodyCount() == 0) return nullptr;
        b2Body* body = world_.GetBodyList();
        for (int skip = choose(world_.GetBodyCount()); skip > 0; --skip) body = body->GetNext();
        return body;
    }
    void play() {
        for (int count = choose(4); count > 0; --count) {
            b2Body* const body = any();
            b2Fixture* const fixture = body != nullptr ? body->GetFixtureList() : nullptr;
            switch (choose(12)) {
            case 0:
            case 1:
            case 2: add(); break;
            case 3:
                if (body != nullptr) addFixture(*body);
                break;
            case 4:
            case 5:
                if (fixture != nullptr) body->DestroyFixture(fixture);
                break; // without a word
            case 6:
                if (body == nullptr) break;
                while (b2Fixture* each = body->GetFixtureList()) body->DestroyFixture(each);
                world_.DestroyBody(body);
                break;
            case 7:
                if (body != nullptr && world_.GetBodyCount() > 10) world_.DestroyBody(body);
                break;
            case 8:
                if (body != nullptr) body->SetType(static_cast<b2BodyType>(choose(3)));
                break;
            case 9:
                if (body != nullptr) body->SetEnabled(!body->IsEnabled());
                break;
            case 10:
                if (fixture != nullptr) attachment_.remove(*fixture);
                break;
            default: join(body, any()); break;
            }
        }
        if (world_.GetBodyCount() > 60) world_.DestroyBody(world_.GetBodyList());
    }
    void add() {
        b2BodyDef def;
        def.type = static_cast<b2BodyType>(choose(5) == 0 ? choose(2) : 2);
        def.bullet = choose(4) == 0;
        def.position = {0.4F * static_cast<float>(choose(10)), 0.4F * static_cast<float>(choose(10))};
        def.linearVelocity = {static_cast<float>(choose(21) - 10), static_cast<float>(choose(21) - 10)};
        b2Body& body = *world_.CreateBody(&def);
        for (int count = choose(3); count >= 0; --count) addFixture(body);
    }
    void addFixture(b2Body& body) {
        b2CircleShape circle;
        circle.m_radius = 0.15F + 0.05F * static_cast<float>(choose(4));
        circle.m_p = {0.1F * static_cast<float>(choose(5) - 2), 0.0F};
        b2PolygonShape box;
        box.SetAsBox(0.3F, 0.15F);
        const b2Shape& shape = choose(2) == 0 ? static_cast<const b2Shape&>(circle) : box;
        b2Fixture& fixture = *body.CreateFixture(&shape, 1.0F + static_cast<float>(choose(5)));
        fixture.SetRestitution(0.1F * static_cast<float>(choose(10)));
        HapticFixture values{100.0 + choose(300), 20.0, choose(2) == 0, static_cast<double>(choose(100)),
                             Voice::both};
        if (choose(3) == 0) values.texture = {.grainMetres = 0.005};
        if (choose(4) != 0) (void)attachment_.set(fixture, values);
    }
    void join(b2Body* a, b2Body* b) {
        if (a == nullptr || b == nullptr || a == b) return;
        b2DistanceJointDef joint;
        joint.Initialize(a, b, a->GetPosition(), b->GetPosition());
        world_.CreateJoint(&joint);
    }

    std::mt19937 random_;
    b2World world_{{0.0F, -10.0F}};
    Attachment attachment_{world_};
};

int numberOf(const char* name, int otherwise) {
    const char* const told = std::getenv(name);
    return told == nullptr ? otherwise : std::atoi(told);
}

TEST(BrokenRules, CostValuesAndNoMemory) {
    const int seeds = numberOf("PHYSVIB_SEEDS", 8), steps = numberOf("PHYSVIB_STEPS", 300);
    for (int seed = 1; seed <= seeds; ++seed) {
        Rampage rampage(static_cast<unsigned>(seed));
        rampage.run(steps);
        EXPECT_FALSE(rampage.events.empty()) << seed;
        const auto isSound = [](const CollisionEvent& event) {
            return std::isfinite(event.amplitude) && std::isfinite(event.x) && std::isfinite(event.y);
        };
        EXPECT_TRUE(std::all_of(rampage.events.begin(), rampage.events.end(), isSound)) << seed;
    }
}

} // namespace physvib::broken_rules_test
