// SPDX-License-Identifier: MIT
// How busy the processor is, by both cost models, while the link is full of strikes.
#include "Rig.h"
#include <gtest/gtest.h>
#include <iostream>

namespace physvib {
namespace {

using virtualboard::CostModel;

struct Load {
    double share = 0;
    wire::Telemetry telemetry;
};

// Strikes of `modes` notes in turn, compact, until all sound; then for two seconds as many as told, beside so
// many tones that move.
Load measure(int modes, double perSecond, CostModel model, int tones = 0) {
    test::Rig rig(PHYSVIB_BOARD_IMAGE, model);
    rig.connect();
    const auto strikes = [modes](std::uint32_t first, double rate, double seconds) {
        std::vector<BoardEvent> events;
        for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
            BoardEvent e;
            e.frame = first + static_cast<std::uint32_t>(i * 8000 / rate);
            e.frequency16 = static_cast<std::uint16_t>(16 * 40 + 37 * (i % modes));
            e.decay16 = 8;
            e.amplitudes = {200, static_cast<std::int16_t>(-64 - i % 50), 32, 96};
            events.push_back(e);
        }
        return events;
    };
    rig.play(strikes(1200, 600, 0.3), 3200, true);
    const auto events = strikes(4000, perSecond, 2.0);
    rig.play({events.begin(), events.begin() + 10}, events[10].frame - 480, true);
    const auto began = rig.board.cycle(), idle = rig.board.idleCycles();
    const auto segments = test::randomBoardSegments(tones, events[10].frame, events.back().frame, 320, 3);
    rig.play({events.begin() + 10, events.end()}, segments, events.back().frame + 100, true);
    Load load;
    load.share = 1.0 - static_cast<double>(rig.board.idleCycles() - idle) /
                           static_cast<double>(rig.board.cycle() - began);
    load.telemetry = rig.telemetry();
    return load;
}

constexpr double fullLine = 11520.0 / 16.0 * 0.99, someStrikes = 100, besideSegments = 400;

void expectLoad(int modes, double perSecond, CostModel model, double most, int tones = 0) {
    const auto load = measure(modes, perSecond, model, tones);
    const auto& t = load.telemetry;
    std::cout << modes << " modes, " << perSecond << " strikes/s, " << tones << " tones that move, "
              << (model == CostModel::optimistic ? "optimistic" : "pessimistic") << ": load "
              << 100 * load.share << " %, worst block " << t.worstBlockCycles
              << " of 36000 cycles, stack free " << t.stackFree << '\n';
    EXPECT_LT(load.share, most);
    EXPECT_EQ(t.modes, modes);
    EXPECT_EQ(t.missedFrames + t.lost + t.dropped + t.late + t.overruns + t.stolen, 0u);
    EXPECT_GE(t.stackFree, 1024);
}

TEST(BoardLoad, AllModesOnAFullLineOptimistic) { expectLoad(128, fullLine, CostModel::optimistic, 0.50); }
TEST(BoardLoad, AllModesOnAFullLinePessimistic) { expectLoad(128, fullLine, CostModel::pessimistic, 0.50); }
TEST(BoardLoad, HalfTheModesOptimistic) { expectLoad(64, someStrikes, CostModel::optimistic, 0.25); }
// 0.25 before the guard.
TEST(BoardLoad, HalfTheModesPessimistic) { expectLoad(64, someStrikes, CostModel::pessimistic, 0.27); }
TEST(BoardLoad, AllModesAndFourTonesThatMoveOptimistic) {
    expectLoad(128, besideSegments, CostModel::optimistic, 0.60, 4);
}
TEST(BoardLoad, AllModesAndFourTonesThatMovePessimistic) {
    expectLoad(128, besideSegments, CostModel::pessimistic, 0.60, 4);
}
TEST(BoardLoad, HalfTheModesOnAFullLine) { expectLoad(64, fullLine, CostModel::pessimistic, 0.34); }

} // namespace
} // namespace physvib
