// SPDX-License-Identifier: MIT
// The image's converters against this computer's renderer, code for code, bit for bit, a million frames.
#include "Rig.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>

namespace physvib::parity_test {

void expectParity(const test::BoardListSettings& list, std::uint32_t seed, std::uint32_t frames,
                  bool compact = false) {
    test::Rig rig;
    const auto parity = test::comparePlay(rig, list, seed, frames, compact);
    const auto& t = parity.telemetry;
    std::cout << "frames " << parity.frames << ", differing " << parity.differing << ", state "
              << (parity.sameState ? "equal" : "differs") << ", closed form within "
              << parity.worstFromClosedForm << ", events " << t.played << ", guard " << parity.episodes
              << " times\n";
    EXPECT_GE(parity.frames, frames);
    EXPECT_EQ(parity.differing, 0u);
    EXPECT_TRUE(parity.sameState);
    EXPECT_LE(parity.worstFromClosedForm, 1);
    EXPECT_EQ(parity.episodes, parity.exactEpisodes);
    EXPECT_EQ(parity.timingViolations, 0);
    EXPECT_EQ(t.played, static_cast<std::uint32_t>(list.events));
    EXPECT_EQ(t.late + t.dropped + t.stolen + t.lost + t.missedFrames + t.overruns + t.bad, 0u);
    EXPECT_EQ(rig.board.resets() + rig.board.faults(), 0);
}

test::BoardListSettings listOf(int events, std::uint32_t span, int materials, double loudest,
                               double gated = 0) {
    return {events, 2000, span, materials, loudest, gated};
}

// Together 1,010,000 frames.
TEST(BoardParity, FewMaterials) { expectParity(listOf(3000, 290'000, 12, 0.3), 1, 300'000); }
TEST(BoardParity, ManyMaterialsAndTheLinkedGain) {
    expectParity(listOf(4000, 150'000, 128, 0.5), 2, 160'000);
}
TEST(BoardParity, Durations) { expectParity(listOf(4000, 240'000, 60, 0.2, 0.5), 3, 250'000); }
TEST(BoardParity, TheCompactForm) { expectParity(listOf(8000, 140'000, 40, 0.1), 4, 150'000, true); }
TEST(BoardParity, Sparse) { expectParity(listOf(300, 140'000, 300, 0.9), 5, 150'000); }

// So loud that the guard turns it down again and again.
TEST(BoardParity, WhatTheGuardTurnsDown) {
    test::Rig rig;
    const auto parity = test::comparePlay(rig, listOf(3000, 90'000, 60, 2.0), 11, 100'000);
    std::cout << "guard " << parity.episodes << " times, closed form within " << parity.worstGivenLeft
              << '\n';
    EXPECT_EQ(parity.differing, 0u);
    EXPECT_TRUE(parity.sameState);
    EXPECT_GE(parity.episodes, 3u);
    EXPECT_LE(parity.worstGivenLeft, 1);
    EXPECT_EQ(parity.telemetry.missedFrames, 0u);
}

// Three tones that move, of long and of short segments, between strikes.
TEST(BoardParity, Segments) {
    test::Rig rig;
    rig.connect();
    const auto events = test::randomBoardEvents(listOf(700, 60'000, 20, 0.1, 0.2), 8);
    auto segments = test::randomBoardSegments(2, 2000, 60'000, 320, 9);
    for (const BoardSegment& segment : test::randomBoardSegments(1, 2000, 60'000, 150, 10))
        segments.push_back(segment);
    std::ranges::stable_sort(segments, {}, &BoardSegment::frame);
    rig.play(events, segments, 63'000);
    const auto t = rig.telemetry();
    const auto here = std::make_unique<BoardRenderer>();
    here->prepare();
    const auto codes = test::renderBoardEvents(*here, events, 63'000, 160, segments);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < codes.size(); ++n) differing += codes[n] != rig.codes()[n] ? 1 : 0;
    std::cout << segments.size() << " legs, " << events.size() << " strikes, differing " << differing << '\n';
    EXPECT_EQ(differing, 0u);
    EXPECT_EQ(t.played, events.size() + segments.size());
    EXPECT_EQ(here->status().played, events.size() + segments.size());
    EXPECT_EQ(t.late + t.dropped + t.stolen + t.lost + t.missedFrames + t.overruns + t.bad, 0u);
}

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

} // namespace physvib::parity_test
