// SPDX-License-Identifier: MIT
// Counts every `new` of this test program: after warm-up stepping must not need any. (Box2D's pools use
// malloc.)
#include "DropScene.h"
#include "Physics/Attachment.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

namespace {
long allocations = 0; // one thread
}

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
// std::stable_sort asks this one; a sanitizer would bring its own, and miss our delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace physvib {
namespace {

TEST(SimulationAllocation, SteppingAllocatesNothingOfOurs) {
    Simulation simulation(shakenScene(), 1, 100);
    std::vector<CollisionEvent> events;
    events.reserve(10'000);
    simulation.step(events);
    const long before = allocations;
    for (int i = 0; i < 3000; ++i) simulation.step(events);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(before, 0);
    EXPECT_GT(events.size(), 100U);
}

/// A hundred balls, all of them cameras, in a box that is shaken.
class AttachmentAllocation : public testing::TestWithParam<ImpactTiming> {
protected:
    AttachmentAllocation() {
        ImpactSettings settings;
        settings.timing = GetParam();
        attachment.configure(settings);
        const b2BodyDef ground;
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {4.0F, 0.0F}, {4.0F, 4.0F}, {0.0F, 4.0F}};
        b2EdgeShape edge;
        for (int i = 0; i < 4; ++i) {
            edge.SetTwoSided(corners[i], corners[(i + 1) % 4]);
            (void)attachment.set(*world.CreateBody(&ground)->CreateFixture(&edge, 0.0F),
                                 {300.0, 50.0, true, 100.0, Voice::both});
        }
        b2BodyDef def;
        def.type = b2_dynamicBody;
        b2CircleShape circle;
        circle.m_radius = 0.15F;
        for (int i = 0; i < 100; ++i) {
            def.position = {0.2F + 0.36F * static_cast<float>(i % 10),
                            0.2F + 0.36F * static_cast<float>(i / 10)};
            (void)attachment.set(*world.CreateBody(&def)->CreateFixture(&circle, 10.0F),
                                 {200.0, 40.0, true, 0.0, Voice::own});
        }
    }
    void shake(int step) {
        world.SetGravity({step / 20 % 2 == 0 ? 30.0F : -30.0F, -9.8F});
        attachment.step(0.01F);
        attachment.take(events);
    }
    b2World world{{0.0F, -9.8F}};
    Attachment attachment{world};
    std::vector<CollisionEvent> events;
};

TEST_P(AttachmentAllocation, NothingAfterWarmUp) {
    events.reserve(1'000'000);
    for (int i = 0; i < 600; ++i) shake(i); // lists have grown to what this world needs
    const std::size_t known = events.size();
    const long before = allocations;
    for (int i = 600; i < 1600; ++i) shake(i);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(events.size(), known + 1000);
    EXPECT_EQ(attachment.drops(), 0U);
}
INSTANTIATE_TEST_SUITE_P(Timings, AttachmentAllocation,
                         testing::Values(ImpactTiming::onset, ImpactTiming::release));

} // namespace
} // namespace physvib
