// SPDX-License-Identifier: MIT
// Box2D keeps blocks of its own, in which what has been destroyed can still be read unnoticed. Where the address sanitizer
// watches, all tests of this program get plain memory instead, so that a look at something that is gone is seen.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PHYSVIB_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(PHYSVIB_ADDRESS_SANITIZER)
#include <box2d/box2d.h>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace {

// What each world has; it leaves some of it to its allocator when it ends. Never destroyed: worlds may be, later.
std::map<const b2BlockAllocator*, std::set<void*>>& blocks() {
    static auto* const all = new std::map<const b2BlockAllocator*, std::set<void*>>;
    return *all;
}

} // namespace

// Before those of the shared library, which calls them as everybody does.
b2BlockAllocator::b2BlockAllocator()
    : m_chunks(nullptr)
    , m_chunkCount(0)
    , m_chunkSpace(0)
    , m_freeLists{} {}
b2BlockAllocator::~b2BlockAllocator() { Clear(); }

void* b2BlockAllocator::Allocate(int32 size) {
    if (size == 0) return nullptr;
    return *blocks()[this].insert(std::malloc(static_cast<std::size_t>(size))).first;
}

void b2BlockAllocator::Free(void* block, int32 size) {
    if (size == 0) return;
    blocks()[this].erase(block);
    std::free(block);
}

void b2BlockAllocator::Clear() {
    for (void* block : blocks()[this]) std::free(block);
    blocks().erase(this);
}

TEST(PlainMemory, Box2DTakesIt) {
    const std::size_t before = blocks().size();
    b2World world({0.0F, 0.0F});
    const b2BodyDef def;
    world.CreateBody(&def);
    EXPECT_GT(blocks().size(), before);
}
#endif
