// SPDX-License-Identifier: MIT
// A body that is destroyed some time after it was disabled leaves all others as they are, to the bit: worlds
// may drop what is gone, and sessions that were saved while it only lay disabled play as before.
#include "Physics/Attachment.h"
#include <deque>
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

class Rain {
public:
    Rain(ImpactTiming timing, bool destroys)
        : destroys_(destroys) {
        ImpactSettings settings;
        settings.timing = timing;
        attachment_.configure(settings);
        const b2BodyDef ground;
        // clockwise: they stay inside
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {0.0F, 4.0F}, {4.0F, 4.0F}, {4.0F, 0.0F}};
        b2ChainShape chain;
        chain.CreateLoop(corners, 4);
        (void)attachment_.set(*world_.CreateBody(&ground)->CreateFixture(&chain, 0.0F),
                              {300.0, 50.0, true, 100.0, Voice::both}, next_++);
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
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {x, y};
        def.bullet = next_ % 3 == 0;
        b2CircleShape circle;
        circle.m_radius = 0.15F;
        b2Body& body = *world_.CreateBody(&def);
        b2Fixture& fixture = *body.CreateFixture(&circle, 10.0F);
        fixture.SetRestitution(0.4F);
        (void)attachment_.set(fixture, {200.0, 40.0, next_ % 2 == 0, 0.0, Voice::own}, next_);
        ++next_;
        return body;
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

} // namespace
} // namespace physvib
