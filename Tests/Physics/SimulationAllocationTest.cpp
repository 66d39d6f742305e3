// SPDX-License-Identifier: MIT
// Counts every `new` of this test program: stepping must not need any. (Box2D's pools use malloc.)
#include "DropScene.h"
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
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace physvib {
namespace {

TEST(SimulationAllocation, SteppingAllocatesNothingOfOurs) {
    Simulation simulation(shakenScene(), 1, 100);
    std::vector<CollisionEvent> events;
    events.reserve(10'000);
    const long before = allocations;
    for (int i = 0; i < 3000; ++i) simulation.step(events);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(before, 0);
    EXPECT_GT(events.size(), 100U);
}

} // namespace
} // namespace physvib
