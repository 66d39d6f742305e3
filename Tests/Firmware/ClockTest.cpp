// SPDX-License-Identifier: MIT
// The link's clock through the image: random delays of 10 to 30 ms, a computer 300 ppm off.
#include "Rig.h"
#include "SoundLog.h"
#include "Wire/LinkClock.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <unistd.h>
#include <utility>

namespace physvib::clock_test {

TEST(BoardClock, OnsetsAreWithinTwoMillisecondsForThirtySeconds) {
    constexpr double drift = 300e-6, start = 1000.0; // the computer's clock: start + t (1 + drift)
    constexpr double step = 0.0005;
    const auto hostNs = [](double t) { return static_cast<std::int64_t>((start + t * (1.0 + drift)) * 1e9); };
    test::Rig rig;
    rig.connect();
    std::mt19937 random{12};
    const auto delay = [&] { return 0.010 + 0.020 * (random() / 4294967296.0); };
    LinkClock clock;
    std::array<std::int64_t, 256> sent{};
    std::multimap<double, wire::Pong> answers; // by when they are here
    wire::FrameDecoder decoder;
    std::vector<std::pair<double, std::uint32_t>> wanted; // true time, frame as estimated
    double nextPing = rig.board.seconds(), nextEvent = 3.0;
    std::uint8_t id = 0, sequence = 0xFF;
    while (rig.board.seconds() < 33.0) {
        const double now = rig.board.seconds();
        if (now >= nextPing) {
            sent[++id] = hostNs(now);
            rig.board.send(test::framed(wire::Ping{id}), now + delay());
            nextPing = now + 1.0 / (clock.isReady() ? wire::pingsPerSecond : wire::firstPingsPerSecond);
        }
        if (now >= nextEvent && clock.isReady()) {
            const double target = now + 0.2;
            BoardEvent e{static_cast<std::uint32_t>(clock.frameAt(hostNs(target)) + 0.5),
                         16 * 400,
                         16 * 200,
                         20,
                         {4000, 4000, 4000, 4000}};
            wanted.push_back({target, e.frame});
            rig.board.send(test::framed(wire::Strike{++sequence, e}), now + delay());
            nextEvent = now + 0.5;
        }
        rig.board.runUntil(now + step);
        for (const auto& byte : rig.board.received())
            if (wire::Pong pong; wire::decode(decoder.feed(byte.value), pong))
                answers.insert({static_cast<double>(byte.cycle) / 72e6 + delay(), pong});
        for (; !answers.empty() && answers.begin()->first <= rig.board.seconds();
             answers.erase(answers.begin())) {
            const auto& pong = answers.begin()->second;
            clock.add(sent[pong.id], pong.frame + pong.fraction / 256.0, hostNs(answers.begin()->first));
        }
    }
    double worst = 0;
    const auto& codes = rig.codes();
    for (const auto& [target, frame] : wanted) {
        std::size_t n = frame - 100;
        while (n < codes.size() && codes[n][0] == 128) ++n; // the first sample of a sine is zero
        ASSERT_LT(n, codes.size());
        ASSERT_EQ(n, frame + 1);
        worst = std::max(
            worst, std::abs(static_cast<double>(rig.board.peripherals().frameCycles[n - 1]) / 72e6 - target));
    }
    const auto t = rig.telemetry();
    std::cout << wanted.size() << " onsets, worst " << worst * 1e3 << " ms, drift " << clock.drift() * 1e6
              << " ppm\n";
    EXPECT_GE(wanted.size(), 55u);
    EXPECT_LT(worst, 0.002);
    EXPECT_EQ(t.late, 0u);
    EXPECT_NEAR(clock.drift(), -drift, 100e-6) << "the board is slow as the computer sees it";
}

// How busy the processor is, by both cost models, while the link is full of strikes.

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

// Of frames that are given by hand, each 9000 cycles of 72 MHz: in the log of physvib-virtual-board a silence
// begins where the sound ended, and 159 frames are none.
TEST(BoardClock, TheLogTellsWhereEachVibrationBeginsAndEnds) {
    const std::string path = testing::TempDir() + "physvib-sound-" + std::to_string(getpid());
    virtualboard::Peripherals io;
    virtualboard::SoundLog log{path};
    log.begin({});
    const auto play = [&](int frames, std::uint8_t code) {
        for (int i = 0; i < frames; ++i) {
            io.frameCycles.push_back(9000 * io.frames.size());
            io.frames.push_back({128, 128, code, 128});
        }
        log.writeFrames(io);
    };
    for (const auto& [frames, code] :
         {std::pair{100, 128}, {50, 129}, {159, 128}, {1, 0}, {100, 128}, {60, 128}, {240, 128}, {1, 255}})
        play(frames, static_cast<std::uint8_t>(code));
    std::ifstream file{path};
    const std::string written{std::istreambuf_iterator<char>{file}, {}};
    EXPECT_EQ(written, "steady_ns,what\n12500000,sound\n38750000,silence\n88750000,sound\n");
    std::filesystem::remove(path);
}

} // namespace physvib::clock_test
