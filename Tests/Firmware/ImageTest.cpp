// SPDX-License-Identifier: MIT
// The image itself: how large it is, what is not in it, and its self-test.
#include "Rig.h"
#include "Support/BoardHazards.h"
#include "Wire/SelfTest.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib::image_test {

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

// Images with a planted fault: each must be found by what the other tests look at.

test::Parity play(test::Rig& rig) {
    return test::comparePlay(rig, {300, 2000, 28'000, 20, 0.2, 0}, 8, 30'000);
}
std::string mutant(const std::string& name) { return PHYSVIB_MUTANTS "/" + name + "/build/physvib-f334.elf"; }

TEST(BoardMutants, WithoutSetUpDelayTheConvertersTimesAreViolated) {
    test::Rig rig(mutant("no-delay"));
    EXPECT_GT(play(rig).timingViolations, 1000);
    const auto& t = rig.board.peripherals().converters.observedTimes();
    EXPECT_LT(t.writePulse, 50.0);
}

// The same converters without an image, each change a microsecond after the other: no time is too short.
TEST(BoardMutants, ALineThatChangesWhileALatchIsOpenIsAViolation) {
    constexpr std::uint32_t idle = 0xFFF, write = 1u << 9, chip1 = 1u << 10;
    for (int line = 0; line < 12; ++line) {
        if (1u << line == write) continue;
        for (const bool isOpen : {false, true}) {
            virtualboard::Converters converters;
            double ns = 0.0;
            const auto set = [&](std::uint32_t pins) { converters.drive(pins, ns += 1000.0); };
            const std::uint32_t selected = idle & ~chip1, changed = selected ^ 1u << line;
            set(selected);
            set(selected & ~write);
            if (isOpen) set(changed & ~write);
            set(isOpen ? changed : selected);
            set(changed);
            EXPECT_EQ(converters.observedTimes().violations, isOpen ? 1 : 0) << "PC" << line;
            EXPECT_EQ(converters.observedTimes().writes, 1);
        }
    }
}

TEST(BoardMutants, SwappedChipSelectsPlayWrongCodes) {
    test::Rig rig(mutant("swapped-chips"));
    EXPECT_GT(play(rig).differing, 1000u);
}

TEST(BoardMutants, ContractedFloatsLeaveAnotherState) {
    test::Rig rig(mutant("contracted"));
    const auto parity = play(rig);
    EXPECT_FALSE(parity.sameState);
    EXPECT_LE(parity.worstFromClosedForm, 1) << "which the codes alone hardly show";
}

TEST(BoardMutants, WithoutTheGuardDirectCurrentLeaves) {
    test::Rig rig(mutant("no-guard"));
    rig.connect();
    const auto hazard = test::boardHazards(2000, 1).front();
    rig.play(hazard.events, 2000 + 2 * 8000);
    EXPECT_GT(test::worstSlowFigures(rig.codes()).mean, 5 * limits::guardShare);
}

TEST(BoardMutants, AnotherPolynomialDoesNotAnswer) {
    test::Rig rig(mutant("polynomial"));
    EXPECT_THROW(rig.connect(), std::runtime_error);
}

// The guard in the image: what leaves the converters of the virtual board.

// Codes as this computer's renderer has them, and within the bounds.
TEST(BoardGuardOnTheImage, KeepsWhatIsSlowWithinItsShare) {
    constexpr std::uint32_t first = 2000, frames = first + 5 * 8000;
    for (const auto& hazard : test::boardHazards(first, 4)) {
        test::Rig rig(PHYSVIB_BOARD_IMAGE, virtualboard::CostModel::pessimistic);
        rig.connect();
        rig.play(hazard.events, hazard.segments, frames);
        const auto here = std::make_unique<BoardRenderer>();
        here->prepare();
        const auto codes = test::renderBoardEvents(*here, hazard.events, frames, 160, hazard.segments);
        auto played = rig.codes();
        played.resize(frames);
        const auto worst = test::worstSlowFigures(played);
        const auto t = rig.telemetry();
        std::cout << hazard.name << ": mean " << worst.mean << ", rms " << worst.rms << ", worst block "
                  << t.worstBlockCycles << " of 36000 cycles, stack free " << t.stackFree << '\n';
        EXPECT_EQ(played, codes) << hazard.name;
        EXPECT_LE(worst.mean, limits::guardShare) << hazard.name;
        EXPECT_LE(worst.rms, limits::guardShare) << hazard.name;
        EXPECT_GT(here->guard().episodes(), 0u) << hazard.name;
        EXPECT_EQ(rig.renderer().guard().episodes(), here->guard().episodes()) << hazard.name;
        EXPECT_EQ(t.guarded, here->guard().episodes()) << hazard.name;
        EXPECT_EQ(t.missedFrames + t.lost + t.dropped + t.late, 0u) << hazard.name;
    }
}

// It is not heard, so it is not turned down.
TEST(BoardGuardOnTheImage, LeavesTheSelfTestItsBits) {
    test::Rig rig;
    rig.connect();
    rig.play({{600, 16, 1, 3000, {4096, 4096, 4096, 4096}}}, 600 + 4000);
    ASSERT_LT(rig.renderer().guard().gain(), 0.5f);
    const auto onBoard = *rig.ask<wire::SelfTestReply>(wire::SelfTest{});
    BoardRenderer renderer;
    EXPECT_EQ(onBoard.hash, wire::expectedSelfTest(renderer).hash);
    EXPECT_LT(rig.renderer().guard().gain(), 1.0f) << "what has left is not forgotten";
}

} // namespace physvib::image_test
