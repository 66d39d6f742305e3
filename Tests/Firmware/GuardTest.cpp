// SPDX-License-Identifier: MIT
// The guard in the image: what leaves the converters of the virtual board.
#include "Rig.h"
#include "Support/BoardHazards.h"
#include "Wire/SelfTest.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib {
namespace {

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

} // namespace
} // namespace physvib
