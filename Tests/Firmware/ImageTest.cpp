// SPDX-License-Identifier: MIT
// The image itself: how large it is, what is not in it, and its self-test.
#include "Rig.h"
#include "Wire/SelfTest.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib {
namespace {

TEST(BoardImage, FitsTheProcessor) {
    const auto image = virtualboard::readElf(PHYSVIB_BOARD_IMAGE);
    std::size_t flash = 0;
    for (const auto& segment : image.segments) flash += segment.bytes.size();
    const auto at = [&](const char* name) { return image.symbols.at(name).address; };
    const auto stack = at("linkStackTop") - at("linkStackBottom"), used = at("linkStackBottom") - 0x20000000u,
               fast = at("linkFastEnd") - 0x10000000u;
    std::cout << "flash " << flash << " of 65536, memory " << used << " + stack " << stack
              << " of 12288, beside the core " << fast << " of 4096\n";
    EXPECT_LT(flash, 65536u);
    EXPECT_EQ(used + stack, 12288u);
    EXPECT_GE(stack, 1792u); // 2048 before the guard; of it 1 KB is never used (BoardLoad)
    EXPECT_LE(fast, 4096u);
}

TEST(BoardImage, HasNoHeapAndNoExceptions) {
    for (const auto& [name, symbol] : virtualboard::readElf(PHYSVIB_BOARD_IMAGE).symbols)
        for (const char* word :
             {"malloc", "calloc", "_sbrk", "_Znw", "_Zna", "__cxa_throw", "__aeabi_d", "printf"})
            // __aeabi_d: double precision, which the processor has not
            EXPECT_FALSE(name.starts_with(word)) << name;
}

TEST(BoardImage, SelfTestGivesTheBitsOfThisComputer) {
    test::Rig rig;
    rig.connect();
    rig.send(wire::Gains{{1000, -2000, 0, 4096}}); // of who played before
    const auto onBoard = *rig.ask<wire::SelfTestReply>(wire::SelfTest{});
    BoardRenderer renderer;
    const auto reply = wire::expectedSelfTest(renderer);
    std::cout << onBoard.modes << " modes: " << onBoard.blockCycles << " of " << onBoard.cyclesPerBlock
              << " cycles a block\n";
    EXPECT_EQ(onBoard.hash, reply.hash);
    EXPECT_EQ(onBoard.modes, 128);
    EXPECT_LT(2 * onBoard.blockCycles, onBoard.cyclesPerBlock);
    EXPECT_EQ(rig.telemetry().missedFrames, 0u);
    const test::BoardFrame silence{128, 128, 128, 128};
    for (const auto& frame : rig.codes()) ASSERT_EQ(frame, silence) << "the self-test is not heard";
}

} // namespace
} // namespace physvib
