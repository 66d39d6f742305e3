// SPDX-License-Identifier: MIT
// What a session takes from the heap. Tests/House/size.sh reads the line that is printed.
#include "FakeHost.h"
#include "Support/HeapBytes.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(SessionMemory, APreparedSessionTakesTwoMegabytes) {
    if (!test::countsHeap) GTEST_SKIP() << "only glibc counts it";
    auto setup = test::shakeTheBoxSetup(0.02);
    setup.modes = 256;
    const std::size_t before = test::heapBytes();
    const auto session = std::make_unique<Session>(setup);
    session->prepare(48000, 512);
    const std::size_t prepared = test::heapBytes() - before;
    std::printf("sizeof RenderControl %zu, PartPanners %zu, Session %zu; a prepared session %zu bytes\n",
                sizeof(RenderControl), sizeof(PartPanners), sizeof(Session), prepared);
    EXPECT_LT(prepared, 2'000'000U);
    EXPECT_GT(prepared, 500'000U) << "it is counted";
}

} // namespace
} // namespace physvib
