// SPDX-License-Identifier: MIT
// Random worlds, with and without an attachment: they must move alike to the bit, whatever is done to them;
// and what is handed on in random clusters is never more than what struck.
#include "AttachedWorld.h"
#include <algorithm>
#include <random>
#include <utility>

namespace physvib::foreign_motion_test {

/// Bodies of all kinds, joints, sensors, bullets, filters, and a player who makes, destroys, pushes.
class RandomWorld {
public:
    explicit RandomWorld(unsigned seed)
        : random_(seed) {
        world.SetSubStepping(choose(4) == 0);
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {8.0F, 0.0F}, {8.0F, 6.0F}, {0.0F, 6.0F}};
        b2ChainShape chain;
        chain.CreateLoop(corners, 4);
        addStill(world, chain);
        for (int i = 0; i < 12; ++i) add();
        b2DistanceJointDef joint;
        joint.Initialize(bodies_[0], bodies_[1], bodies_[0]->GetPosition(), bodies_[1]->GetPosition());
        world.CreateJoint(&joint);
    }

    /// Before a step: what the player does; true if time stands.
    bool play() {
        world.SetGravity({static_cast<float>(choose(21) - 10), -9.8F});
        if (choose(10) == 0) add();
        if (choose(12) == 0 && bodies_.size() > 4) destroy();
        if (choose(6) == 0)
            bodies_[choose(bodies_.size())]->ApplyLinearImpulseToCenter(
                {static_cast<float>(choose(9)) - 4.0F, 3.0F}, true);
        return choose(15) == 0;
    }
    void destroy() {
        const std::size_t which = choose(bodies_.size());
        world.DestroyBody(bodies_[which]);
        bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(which));
    }
    unsigned choose(std::size_t count) { return random_() % static_cast<unsigned>(count); }
    int choose(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

    b2World world{{0.0F, -9.8F}};

private:
    void add() {
        b2BodyDef def;
        def.type = choose(8) == 0 ? b2_kinematicBody : b2_dynamicBody;
        def.bullet = choose(4) == 0;
        def.position = {1.0F + 0.5F * static_cast<float>(choose(12)),
                        1.0F + 0.5F * static_cast<float>(choose(8))};
        def.linearVelocity = {static_cast<float>(choose(41) - 20), static_cast<float>(choose(41) - 20)};
        def.gravityScale = choose(5) == 0 ? 3.0F : 1.0F;
        b2CircleShape circle;
        circle.m_radius = 0.2F;
        b2PolygonShape box;
        box.SetAsBox(0.25F, 0.15F);
        b2FixtureDef fixture;
        fixture.shape = choose(2) == 0 ? static_cast<const b2Shape*>(&circle) : &box;
        fixture.density = 1.0F + static_cast<float>(choose(10));
        fixture.restitution = 0.1F * static_cast<float>(choose(10));
        fixture.isSensor = choose(10) == 0;
        fixture.filter.groupIndex = static_cast<int16>(choose(10) == 0 ? -1 : 0);
        bodies_.push_back(world.CreateBody(&def));
        bodies_.back()->CreateFixture(&fixture);
    }

    std::mt19937 random_;
    std::vector<b2Body*> bodies_;
};

bool moveAlike(const b2World& one, const b2World& two) {
    const b2Body *a = one.GetBodyList(), *b = two.GetBodyList();
    for (; a != nullptr && b != nullptr; a = a->GetNext(), b = b->GetNext())
        if (a->GetPosition() != b->GetPosition() || a->GetAngle() != b->GetAngle() ||
            a->GetLinearVelocity() != b->GetLinearVelocity() ||
            a->GetAngularVelocity() != b->GetAngularVelocity())
            return false;
    return a == b;
}

TEST(ForeignMotion, IsTheSameToTheBitInTwoHundredRandomWorlds) {
    std::size_t events = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        RandomWorld plain(seed), felt(seed);
        ImpactSettings settings = unity();
        settings.timing = seed % 2 == 0 ? ImpactTiming::onset : ImpactTiming::release;
        settings.location = seed % 4 < 2 ? ImpactLocation::contact : ImpactLocation::fixture;
        Attachment attachment(felt.world, settings);
        std::vector<CollisionEvent> taken;
        for (int step = 0; step < 120; ++step) {
            const bool stands = plain.play();
            felt.play();
            const float seconds = stands ? 0.0F : 0.01F;
            for (const b2Body* body = felt.world.GetBodyList(); body != nullptr; body = body->GetNext())
                if (!attachment.find(*body->GetFixtureList()))
                    (void)attachment.set(*body->GetFixtureList(), camera);
            plain.world.Step(seconds, 8, 3);
            if (step % 11 == 10) {
                felt.world.Step(seconds, 8, 3); // not told
            } else {
                attachment.beginStep(static_cast<double>(seconds));
                felt.world.Step(seconds, 8, 3);
                if (step % 17 == 16) plain.destroy(), felt.destroy();
                attachment.endStep();
            }
            attachment.take(taken);
            ASSERT_TRUE(moveAlike(plain.world, felt.world)) << "seed " << seed << ", step " << step;
        }
        events += taken.size();
        EXPECT_EQ(attachment.drops(), 0U);
    }
    EXPECT_GT(events, 2000U);
}

/// Those of a cluster that meet after they have been struck: what bounces strikes again, and these are
/// collisions of their own.
struct SecondCollisions : b2ContactListener {
    void BeginContact(b2Contact* contact) override {
        met.emplace_back(contact->GetFixtureA(), contact->GetFixtureB());
    }
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
        const b2Fixture *a = contact->GetFixtureA(), *b = contact->GetFixtureB();
        if (a != striker && b != striker && have(a, b))
            newtonSeconds += static_cast<double>(impulse->normalImpulses[0]);
    }
    bool have(const b2Fixture* a, const b2Fixture* b) const {
        return std::any_of(met.begin(), met.end(), [&](const auto& pair) {
            return pair == std::pair{a, b} || pair == std::pair{b, a};
        });
    }

    const b2Fixture* striker = nullptr;
    std::vector<std::pair<const b2Fixture*, const b2Fixture*>> met;
    double newtonSeconds = 0.0;
};

class RandomClusters : public testing::TestWithParam<ImpactTiming> {};

TEST_P(RandomClusters, HandOnNoMoreThanWhatStruck) {
    constexpr int stepsToCome = 6; // until all is told in either timing
    std::mt19937 random(3);
    int handedOn = 0;
    for (int round = 0; round < 300; ++round) {
        SecondCollisions second;
        b2World world({0.0F, 0.0F});
        world.SetContactListener(&second);
        ImpactSettings settings = unity();
        settings.timing = GetParam();
        Attachment attachment(world, settings);
        std::vector<const b2Fixture*> fixtures; // by id
        const auto add = [&](float x, float y, float vx) {
            b2Fixture& fixture =
                addTo(world, discOf(0.25F), {x, y}, {vx, 0.0F}, 1.0F + static_cast<float>(random() % 20));
            fixture.SetRestitution(0.1F * static_cast<float>(random() % 10));
            const auto id = static_cast<std::size_t>(attachment.set(fixture, camera).id);
            EXPECT_EQ(id, fixtures.size());
            fixtures.push_back(&fixture);
            return &fixture;
        };
        for (int row = 0; row < 3; ++row) // touching, as oranges in a crate
            for (int column = 0; column < 4; ++column)
                if (random() % 4 != 0)
                    add(0.499F * (static_cast<float>(column) + 0.5F * static_cast<float>(row % 2)),
                        0.432F * static_cast<float>(row), 0.0F);
        for (int i = 0; i < 5; ++i) attachment.step(0.01F);
        std::vector<CollisionEvent> events;
        attachment.flush(events);
        events.clear();
        b2Fixture& fixture =
            *add(-1.5F, 0.1F * static_cast<float>(random() % 10), 2.0F + static_cast<float>(random() % 10));
        const std::int32_t striker = attachment.set(fixture, camera).id;
        second.striker = &fixture;
        second.met.clear();
        const b2Vec2 before = fixture.GetBody()->GetLinearVelocity();
        const auto isDirect = [&](const CollisionEvent& e) {
            return e.source.fixture == striker || e.source.other == striker;
        };
        for (int i = 0; i < 100 && std::none_of(events.begin(), events.end(), isDirect); ++i) {
            attachment.step(0.01F);
            attachment.flush(events);
        }
        for (int i = 0; i < stepsToCome; ++i) attachment.step(0.01F);
        attachment.flush(events);
        const double struck =
            massKg(fixture) * static_cast<double>((fixture.GetBody()->GetLinearVelocity() - before).Length());
        for (const CollisionEvent& event : events) {
            const auto fixtureOf = [&](std::int32_t id) { return fixtures[static_cast<std::size_t>(id)]; };
            if (isDirect(event) ||
                second.have(fixtureOf(event.source.fixture), fixtureOf(event.source.other)))
                continue;
            ++handedOn;
            EXPECT_LE(event.source.impulseNewtonSeconds, 1.05 * (struck + second.newtonSeconds)) << round;
        }
    }
    EXPECT_GT(handedOn, 300);
}
INSTANTIATE_TEST_SUITE_P(, RandomClusters, testing::Values(ImpactTiming::onset, ImpactTiming::release));

} // namespace physvib::foreign_motion_test
