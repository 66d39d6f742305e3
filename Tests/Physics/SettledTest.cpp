// SPDX-License-Identifier: MIT
// What settledNs() promises is kept, whatever is removed and whenever: events come in time order, and none
// before the time that was reported as settled.
#include "Contacts/ContactFeed.h"
#include "Physics/Attachment.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

constexpr int settledSeeds = 36;

/// Takes events, and checks each against what was promised.
template <class World>
class SettledEvents {
public:
    void take(World& world) {
        taken_.clear();
        world.take(taken_);
        for (const CollisionEvent& event : taken_) {
            EXPECT_GE(event.timeNs, latest_);
            EXPECT_GE(event.timeNs, promised_);
            EXPECT_LT(event.timeNs, world.settledNs());
            latest_ = event.timeNs;
        }
        EXPECT_GE(world.settledNs(), promised_);
        promised_ = world.settledNs();
        count += taken_.size();
    }
    std::size_t count = 0;

private:
    std::int64_t latest_ = 0, promised_ = 0;
    std::vector<CollisionEvent> taken_;
};

/// Rows of balls and a few boxes that hand impacts on, shaken, of which bodies, fixtures and joints go at any
/// time between steps. What a callback of the step has chosen goes right after it.
class Removals : b2ContactListener {
public:
    explicit Removals(unsigned seed)
        : random_(seed) {
        world_.SetContactListener(this);
        ImpactSettings settings;
        settings.timing = seed % 3 == 0 ? ImpactTiming::release : ImpactTiming::onset;
        settings.keepsHitsOfDestroyed = seed % 4 != 3;
        attachment_.configure(settings);
        const b2BodyDef still;
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {0.0F, 3.0F}, {4.0F, 3.0F}, {4.0F, 0.0F}};
        b2ChainShape walls;
        walls.CreateLoop(corners, 4);
        (void)attachment_.set(*world_.CreateBody(&still)->CreateFixture(&walls, 0.0F), values());
        for (int i = 0; i < 40; ++i) add();
    }

    std::size_t run(int steps) {
        SettledEvents<Attachment> events;
        const auto play = [&] {
            for (int count = choose(3); count > 0; --count) remove(any());
            if (choose(2) == 0) events.take(attachment_);
            if (world_.GetBodyCount() < 40) add();
        };
        for (int step = 0; step < steps; ++step) {
            world_.SetGravity({step / 20 % 2 == 0 ? 15.0F : -15.0F, -10.0F});
            const float seconds = choose(4) == 0 ? 0.004F : 0.016F; // what met in a step of another length
            play();
            attachment_.beginStep(static_cast<double>(seconds));
            play();
            doomed_.clear();
            world_.Step(seconds, 8, 3);
            std::sort(doomed_.begin(), doomed_.end());
            doomed_.erase(std::unique(doomed_.begin(), doomed_.end()), doomed_.end());
            for (b2Body* body : doomed_) remove(body);
            play();
            attachment_.endStep();
            events.take(attachment_);
        }
        return events.count;
    }

private:
    int choose(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    HapticFixture values() { return {200.0, 40.0, choose(2) == 0, 10.0, Voice::own}; }
    void BeginContact(b2Contact* contact) override {
        if (b2Body* const body = contact->GetFixtureB()->GetBody(); choose(60) == 0) doomed_.push_back(body);
    }
    b2Body* any() {
        b2Body* body = world_.GetBodyList();
        for (int skip = choose(world_.GetBodyCount()); skip > 0; --skip) body = body->GetNext();
        return body;
    }
    void remove(b2Body* body) {
        if (body->GetType() == b2_staticBody || choose(2) == 0) return;
        if (choose(3) == 0 && body->GetJointList() != nullptr)
            world_.DestroyJoint(body->GetJointList()->joint);
        else if (choose(3) == 0 && body->GetFixtureList() != nullptr)
            body->DestroyFixture(body->GetFixtureList());
        else
            world_.DestroyBody(body);
    }
    void add() { // two or three that touch in a row
        b2Body* last = nullptr;
        const float x = 0.3F + 0.3F * static_cast<float>(choose(9)),
                    y = 0.3F + 0.3F * static_cast<float>(choose(8));
        for (int i = 0; i < 3; ++i) {
            b2BodyDef def;
            def.type = b2_dynamicBody;
            def.position = {x + 0.2F * static_cast<float>(i), y};
            def.linearVelocity = {static_cast<float>(choose(13) - 6), 0.0F};
            def.bullet = choose(3) == 0;
            b2Body* const body = world_.CreateBody(&def);
            b2CircleShape ball;
            ball.m_radius = 0.1F;
            b2Fixture& fixture = *body->CreateFixture(&ball, 10.0F);
            fixture.SetRestitution(0.1F * static_cast<float>(choose(8)));
            (void)attachment_.set(fixture, values());
            b2DistanceJointDef joint;
            if (last != nullptr && choose(4) == 0) {
                joint.Initialize(last, body, last->GetPosition(), body->GetPosition());
                world_.CreateJoint(&joint);
            }
            last = body;
        }
    }

    std::mt19937 random_;
    b2World world_{{0.0F, -10.0F}};
    Attachment attachment_{world_};
    std::vector<b2Body*> doomed_;
};

TEST(Settled, IsKeptWhenBodiesFixturesAndJointsGoAtAnyTime) {
    for (unsigned seed = 1; seed <= settledSeeds; ++seed) {
        SCOPED_TRACE(seed);
        EXPECT_GT(Removals(seed).run(400), 200U);
        if (HasFailure()) return;
    }
}

/// The same of a row that an engine reports: contacts begin up to a step ago, bodies go between steps.
std::size_t feedRemovals(unsigned seed) {
    constexpr int bodies = 12;
    std::mt19937 random(seed);
    const auto choose = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    ContactFeed feed;
    const auto add = [&](int id) {
        EXPECT_EQ(feed.set(id, {.massKg = 1.0}, {200.0, 40.0, id % 2 == 0, 0.0, Voice::own}), "");
    };
    for (int id = 0; id < bodies; ++id) add(id);
    SettledEvents<ContactFeed> events;
    std::int64_t endNs = 0;
    for (int step = 0; step < 400; ++step) {
        EXPECT_EQ(feed.beginStep(endNs += choose(3) == 0 ? 4'000'000 : 16'000'000, 9.81), "");
        events.take(feed);
        for (int a = 0; a + 1 < bodies; ++a) {
            if (choose(3) == 0) continue;
            FedContact contact;
            contact.a = a, contact.b = a + 1;
            contact.point = {0.1F * static_cast<float>(a), 0.0F}, contact.normal = {1.0F, 0.0F};
            contact.impulseNewtonSeconds = 0.5 + choose(5);
            contact.approachMetresPerSecond = choose(3);
            contact.fraction = 0.1 * choose(20) - 1.0;
            EXPECT_EQ(feed.touch(contact), "");
        }
        EXPECT_EQ(feed.endStep(), "");
        events.take(feed);
        for (int count = choose(3); count > 0; --count) {
            const int id = choose(bodies);
            EXPECT_EQ(feed.remove(id), "");
            events.take(feed);
            add(id);
        }
    }
    return events.count;
}

TEST(Settled, IsKeptWhenReportedBodiesGoBetweenSteps) {
    for (unsigned seed = 1; seed <= settledSeeds; ++seed) {
        SCOPED_TRACE(seed);
        EXPECT_GT(feedRemovals(seed), 500U);
        if (HasFailure()) return;
    }
}

} // namespace
} // namespace physvib
