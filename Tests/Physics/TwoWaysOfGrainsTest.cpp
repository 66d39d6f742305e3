// SPDX-License-Identifier: MIT
// Grains become events as they are found, or by a list where times are looked at first: the same events, in
// 400 random worlds.
#include "Physics/Attachment.h"
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace physvib {
namespace {

class Yard {
public:
    explicit Yard(std::uint32_t seed)
        : random_{seed} {
        const b2BodyDef def;
        b2EdgeShape floor;
        floor.SetTwoSided({-20.0F, 0.0F}, {20.0F, 0.0F});
        give(*world_.CreateBody(&def)->CreateFixture(&floor, 0.0F), true);
        for (int i = 0; i < 6; ++i) addBody(static_cast<float>(i));
    }
    /// Events of both attachments after so many steps.
    void run(int steps, std::vector<CollisionEvent>& direct, std::vector<CollisionEvent>& listed) {
        for (int i = 0; i < steps; ++i) {
            if (i % 20 == 0) world_.SetGravity({4.0F * drawn() - 2.0F, -9.8F});
            listed_.beginStep(0.01);
            direct_.step(0.01F);
            listed_.endStep();
            direct_.take(direct);
            listed_.take(listed);
        }
    }

private:
    float drawn() { return static_cast<float>(random_() % 1000) / 1000.0F; }
    void give(const b2Fixture& fixture, bool isSource) {
        HapticFixture values{200.0, 40.0, isSource, 5.0, static_cast<Voice>(random_() % 3)};
        values.texture.grainMetres = random_() % 3 == 0 ? 0.0 : 0.001 + 0.02 * static_cast<double>(drawn());
        values.texture.pattern = random_() % 2 == 0 ? GrainPattern::random : GrainPattern::regular;
        values.gain = random_() % 6 == 0 ? 0.0 : 1.0;
        if (random_() % 3 == 0) values.overtones[1] = {500.0, 60.0, 0.5};
        ASSERT_TRUE(direct_.set(fixture, values));
        ASSERT_TRUE(listed_.set(fixture, values));
    }
    void addBody(float x) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {1.2F * x - 3.0F, 0.3F};
        def.linearVelocity = {3.0F * drawn() - 1.5F, 0.0F};
        b2CircleShape circle;
        circle.m_radius = 0.25F;
        b2PolygonShape box;
        box.SetAsBox(0.3F, 0.2F);
        const bool isDisc = random_() % 2 == 0;
        b2Fixture& fixture =
            *world_.CreateBody(&def)->CreateFixture(isDisc ? static_cast<b2Shape*>(&circle) : &box, 10.0F);
        fixture.SetFriction(drawn());
        give(fixture, random_() % 2 == 0);
    }

    std::mt19937 random_;
    b2World world_{{0.0F, -9.8F}};
    Attachment direct_{world_};
    Attachment listed_{world_, {.settlingSeconds = 1.0e-12}}; // leaves nothing out, but looks at every time
};

TEST(TwoWaysOfGrains, MakeTheSameEvents) {
    std::size_t grains = 0;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        std::vector<CollisionEvent> direct, listed;
        Yard{seed}.run(60, direct, listed);
        ASSERT_EQ(direct, listed) << "world " << seed;
        for (const CollisionEvent& event : direct) grains += event.source.kind != ContactKind::hit ? 1 : 0;
    }
    EXPECT_GT(grains, 10'000U);
}

} // namespace
} // namespace physvib
