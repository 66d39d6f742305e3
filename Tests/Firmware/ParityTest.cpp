// SPDX-License-Identifier: MIT
// The image's converters against this computer's renderer, code for code and bit for bit, over a million frames.
#include "Rig.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib {
namespace {

void expectParity(const test::BoardListSettings& list, std::uint32_t seed, std::uint32_t frames, bool compact = false) {
    test::Rig rig;
    const auto parity = test::comparePlay(rig, list, seed, frames, compact);
    const auto& t = parity.telemetry;
    std::cout << "frames " << parity.frames << ", differing " << parity.differing << ", state " << (parity.sameState ? "equal" : "differs") << ", closed form within "
              << parity.worstFromClosedForm << ", events " << t.played << '\n';
    EXPECT_GE(parity.frames, frames);
    EXPECT_EQ(parity.differing, 0u);
    EXPECT_TRUE(parity.sameState);
    EXPECT_LE(parity.worstFromClosedForm, 1);
    EXPECT_EQ(parity.timingViolations, 0);
    EXPECT_EQ(t.played, static_cast<std::uint32_t>(list.events));
    EXPECT_EQ(t.late + t.dropped + t.stolen + t.lost + t.missedFrames + t.overruns + t.bad, 0u);
    EXPECT_EQ(rig.board.resets() + rig.board.faults(), 0);
}

test::BoardListSettings listOf(int events, std::uint32_t span, int materials, double loudest, double gated = 0) {
    return {events, 2000, span, materials, loudest, gated};
}

// Together 1,010,000 frames.
TEST(BoardParity, FewMaterials) { expectParity(listOf(3000, 290'000, 12, 0.3), 1, 300'000); }
TEST(BoardParity, ManyMaterialsAndTheLinkedGain) { expectParity(listOf(4000, 150'000, 128, 0.5), 2, 160'000); }
TEST(BoardParity, Durations) { expectParity(listOf(4000, 240'000, 60, 0.2, 0.5), 3, 250'000); }
TEST(BoardParity, TheCompactForm) { expectParity(listOf(8000, 140'000, 40, 0.1), 4, 150'000, true); }
TEST(BoardParity, Sparse) { expectParity(listOf(300, 140'000, 300, 0.9), 5, 150'000); }

TEST(BoardParity, WithTheInternalOscillator) {
    test::Rig rig(PHYSVIB_BOARD_IMAGE, virtualboard::CostModel::optimistic, false);
    const auto parity = test::comparePlay(rig, listOf(200, 18'000, 20, 0.2), 6, 20'000);
    EXPECT_EQ(rig.connect().crystal, 0);
    EXPECT_EQ(parity.differing, 0u);
    EXPECT_EQ(parity.timingViolations, 0);
}

TEST(BoardParity, OverTheBluetoothLine) {
    test::Rig rig(PHYSVIB_BLUETOOTH_IMAGE);
    const auto parity = test::comparePlay(rig, listOf(200, 18'000, 20, 0.2), 7, 20'000);
    EXPECT_EQ(parity.differing, 0u);
    EXPECT_TRUE(parity.sameState);
}

} // namespace
} // namespace physvib
