// SPDX-License-Identifier: MIT
// Box2D keeps blocks of its own, in which what has been destroyed can still be read unnoticed. Where the
// address sanitizer watches, all tests of this program get plain memory instead, so that a look at something
// that is gone is seen.
#include "Support/Sanitizers.h"
#if defined(PHYSVIB_ADDRESS_SANITIZER)
#include <box2d/box2d.h>
#include <cstdlib>
#include <gtest/gtest.h>

namespace {

/// Before each block: what a world has, since it leaves some of it to its allocator when it ends.
struct Link {
    Link *before, *after;
};
int given = 0;

} // namespace

// These come before those of the shared library, which calls them, too. The list hangs at m_chunks.
b2BlockAllocator::b2BlockAllocator()
    : m_chunks(nullptr)
    , m_chunkCount(0)
    , m_chunkSpace(0)
    , m_freeLists{} {}
b2BlockAllocator::~b2BlockAllocator() { Clear(); }

void* b2BlockAllocator::Allocate(int32 size) {
    if (size == 0) return nullptr;
    ++given;
    auto* const first = reinterpret_cast<Link*>(m_chunks);
    auto* const link = static_cast<Link*>(std::malloc(sizeof(Link) + static_cast<std::size_t>(size)));
    *link = {nullptr, first};
    if (first != nullptr) first->before = link;
    m_chunks = reinterpret_cast<b2Chunk*>(link);
    return link + 1;
}

void b2BlockAllocator::Free(void* block, int32 size) {
    if (size == 0) return;
    auto* const link = static_cast<Link*>(block) - 1;
    if (link->after != nullptr) link->after->before = link->before;
    if (link->before != nullptr)
        link->before->after = link->after;
    else
        m_chunks = reinterpret_cast<b2Chunk*>(link->after);
    std::free(link);
}

void b2BlockAllocator::Clear() {
    while (m_chunks != nullptr) Free(reinterpret_cast<Link*>(m_chunks) + 1, 1);
}

TEST(PlainMemory, Box2DTakesIt) {
    const int before = given;
    b2World world({0.0F, 0.0F});
    const b2BodyDef def;
    world.CreateBody(&def);
    EXPECT_GT(given, before);
}
#endif
