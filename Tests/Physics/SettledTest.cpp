// SPDX-License-Identifier: MIT
// What settledNs() promises is kept, whatever is removed and whenever: events come in time order, and none
// before the time that was reported as settled.
#include "AttachedWorld.h"
#include "Contacts/ContactFeed.h"
#include <algorithm>
#include <deque>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace physvib::settled_test {

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
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {0.0F, 3.0F}, {4.0F, 3.0F}, {4.0F, 0.0F}};
        b2ChainShape walls;
        walls.CreateLoop(corners, 4);
        (void)attachment_.set(addStill(world_, walls), values());
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
            b2Fixture& fixture = addTo(world_, discOf(0.1F), {x + 0.2F * static_cast<float>(i), y},
                                       {static_cast<float>(choose(13) - 6), 0.0F});
            b2Body* const body = fixture.GetBody();
            body->SetBullet(choose(3) == 0);
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

void expectKept(std::size_t events, const std::function<std::size_t(unsigned)>& removals) {
    for (unsigned seed = 1; seed <= 36 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        EXPECT_GT(removals(seed), events);
    }
}

TEST(Settled, IsKeptWhenBodiesFixturesAndJointsGoAtAnyTime) {
    expectKept(200, [](unsigned seed) { return Removals(seed).run(400); });
}

TEST(Settled, IsKeptWhenReportedBodiesGoBetweenSteps) { expectKept(500, feedRemovals); }

// A body that is destroyed some time after it was disabled leaves all others as they are, to the bit: worlds
// may drop what is gone, and sessions that were saved while it only lay disabled play as before.

class Rain {
public:
    Rain(ImpactTiming timing, bool destroys)
        : destroys_(destroys) {
        ImpactSettings settings;
        settings.timing = timing;
        attachment_.configure(settings);
        // clockwise: they stay inside
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {0.0F, 4.0F}, {4.0F, 4.0F}, {4.0F, 0.0F}};
        b2ChainShape chain;
        chain.CreateLoop(corners, 4);
        (void)attachment_.set(addStill(world_, chain), {300.0, 50.0, true, 100.0, Voice::both}, next_++);
        for (int i = 0; i < 20; ++i) add(0.3F + 0.17F * static_cast<float>(i), 0.5F);
    }

    void run(int steps) {
        for (int step = 0; step < steps; ++step) {
            if (random_() % 4 == 0) {
                const auto x = 0.3F + 3.4F * static_cast<float>(random_() % 1000) / 1000.0F;
                notes_.push_back(&add(x, 3.5F));
            }
            if (notes_.size() > 8) {
                notes_.front()->SetEnabled(false);
                leaving_.push_back({step + 50, notes_.front()});
                notes_.pop_front();
            }
            for (; !leaving_.empty() && leaving_.front().step <= step; leaving_.pop_front())
                if (destroys_) world_.DestroyBody(leaving_.front().body);
            world_.SetGravity({step / 20 % 2 == 0 ? 20.0F : -20.0F, -9.8F});
            attachment_.step(0.01F);
            attachment_.take(events);
        }
    }
    int bodies() const { return world_.GetBodyCount(); }
    std::vector<CollisionEvent> events;

private:
    struct Leaving {
        int step;
        b2Body* body;
    };
    b2Body& add(float x, float y) {
        b2Fixture& fixture = addTo(world_, discOf(0.15F), {x, y});
        fixture.GetBody()->SetBullet(next_ % 3 == 0);
        fixture.SetRestitution(0.4F);
        (void)attachment_.set(fixture, {200.0, 40.0, next_ % 2 == 0, 0.0, Voice::own}, next_);
        ++next_;
        return *fixture.GetBody();
    }

    bool destroys_;
    std::mt19937 random_{3};
    b2World world_{{0.0F, -9.8F}};
    Attachment attachment_{world_};
    std::int32_t next_ = 0;
    std::deque<b2Body*> notes_;
    std::deque<Leaving> leaving_;
};

class DestroyedBodies : public testing::TestWithParam<ImpactTiming> {};

TEST_P(DestroyedBodies, LeaveTheMotionAndTheHitsOfAllOthersAsTheyAre) {
    Rain destroying(GetParam(), true), disabling(GetParam(), false);
    destroying.run(4000);
    disabling.run(4000);
    EXPECT_GT(disabling.bodies(), 900);
    EXPECT_LT(destroying.bodies(), 60);
    EXPECT_GT(disabling.events.size(), 3000U);
    ASSERT_EQ(destroying.events.size(), disabling.events.size());
    EXPECT_TRUE(destroying.events == disabling.events);
}
INSTANTIATE_TEST_SUITE_P(Timings, DestroyedBodies,
                         testing::Values(ImpactTiming::onset, ImpactTiming::release));

} // namespace physvib::settled_test
