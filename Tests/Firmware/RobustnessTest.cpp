// SPDX-License-Identifier: MIT
// What goes wrong on a line and around a board: noise, a pulled plug, faults, a falling supply; and stop-all.
#include "Rig.h"
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace physvib::robustness_test {

using test::BoardFrame;
constexpr BoardFrame silence{128, 128, 128, 128};

BoardEvent tone(std::uint32_t frame, int durationMs = 0) {
    return {frame, 16 * 205, 16, static_cast<std::uint16_t>(durationMs), {3000, -3000, 2000, 1000}};
}

// Bytes as a bad line delivers them: one in 300 flipped, dropped, doubled, or with another before it.
std::vector<std::uint8_t> disturbed(const std::vector<std::uint8_t>& bytes, std::mt19937& random) {
    std::vector<std::uint8_t> out;
    for (std::uint8_t byte : bytes) {
        const auto fault = random() % 1200;
        if (fault == 0) byte = static_cast<std::uint8_t>(byte ^ 1u << random() % 8);
        if (fault == 1) continue;
        if (fault == 2) out.push_back(byte);
        if (fault == 3) out.push_back(static_cast<std::uint8_t>(random()));
        out.push_back(byte);
    }
    return out;
}

TEST(BoardRobustness, ThirtySecondsOfNoiseGiveNoResetAndNoWrongCode) {
    constexpr std::uint32_t frames = 240'000;
    test::Rig rig;
    rig.connect();
    std::mt19937 random{31};
    const auto events = test::randomBoardEvents({9000, 2000, frames - 4000, 50, 0.2, 0.1}, 9);
    wire::FrameDecoder asOnBoard;
    BoardRenderer here;
    here.prepare();
    std::vector<BoardFrame> expected;
    BoardRenderer::Codes block;
    std::uint8_t sequence = 0xFF, last = 0xFF;
    int accepted = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
        rig.runTo(events[i].frame - 480.0);
        auto bytes = test::framed(wire::Strike{++sequence, events[i]});
        if (i % 20 == 0) // a frame that comes twice as a whole
            for (const auto b : test::framed(wire::Strike{sequence, events[i]})) bytes.push_back(b);
        bytes = disturbed(bytes, random);
        rig.board.send(bytes);
        while (expected.size() + 400 < events[i].frame) { // behind the board, but before the event's time
            here.render(block);
            expected.insert(expected.end(), block.begin(), block.end());
        }
        for (const auto byte : bytes) {
            wire::Strike got;
            if (!wire::decode(asOnBoard.feed(byte), got) || got.sequence == last) continue;
            last = got.sequence;
            here.schedule(got.event);
            ++accepted;
        }
    }
    rig.runTo(frames);
    const auto t = rig.telemetry();
    while (expected.size() < frames) {
        here.render(block);
        expected.insert(expected.end(), block.begin(), block.end());
    }
    std::size_t wrong = 0;
    for (std::size_t n = 0; n < frames; ++n) wrong += expected[n] != rig.codes()[n] ? 1 : 0;
    std::cout << "sent " << events.size() << ", accepted " << accepted << ", bad frames " << t.bad
              << ", lost by the sequence " << t.lost << ", wrong codes " << wrong << '\n';
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(t.played, static_cast<std::uint32_t>(accepted));
    EXPECT_GT(t.bad, 300u);
    EXPECT_LT(accepted, 8990);
    EXPECT_EQ(t.missedFrames + t.late + t.overruns, 0u);
    EXPECT_EQ(rig.board.resets() + rig.board.faults(), 0);
}

TEST(BoardRobustness, AFullLineLosesNothingItDelivered) {
    test::Rig rig;
    rig.connect();
    const auto before = rig.telemetry();
    constexpr int strikes = 7200; // ten seconds without a gap between two bytes
    const std::uint32_t first = rig.frame() + 160;
    for (int i = 0; i < strikes; ++i) {
        BoardEvent e = tone(0);
        e.frame = first + static_cast<std::uint32_t>(i * 8000 / 720);
        e.frequency16 = static_cast<std::uint16_t>(800 + i % 100);
        e.decay16 = 16 * 20;
        e.amplitudes = {64, 32, -32, 96};
        rig.send(wire::toCompact({static_cast<std::uint8_t>(i), e}));
        if (i % 32 == 31) rig.board.runUntil(rig.board.seconds() + 32.0 * 16 / 11520 - 1e-6);
    }
    rig.board.runUntil(rig.board.seconds() + 0.5);
    const auto t = rig.telemetry();
    EXPECT_EQ(t.good - before.good, static_cast<std::uint32_t>(strikes) + 1);
    EXPECT_EQ(t.played, static_cast<std::uint32_t>(strikes));
    EXPECT_EQ(t.overruns + t.lost + t.dropped + t.missedFrames + t.bad, 0u);
}

TEST(BoardRobustness, UnpluggedItIsSilentInTimeAndGoesOnWithoutARestart) {
    test::Rig rig;
    rig.connect(500);
    rig.play({tone(500), tone(1500)}, 1560); // the second was the last message: 480 frames before its onset
    const std::size_t heard = 1020 + 17;     // and 2 ms on the line
    rig.board.runUntil(rig.board.seconds() + 5.0);
    const auto& codes = rig.codes();
    const std::size_t deadline = heard + 4000;
    EXPECT_NE(codes[deadline - 100], silence) << "still sounding before";
    for (std::size_t n = deadline; n < codes.size(); ++n) ASSERT_EQ(codes[n], silence);
    ASSERT_GT(codes.size(), 40'000u);
    EXPECT_EQ(rig.telemetry().silenced, 0) << "a message ends the silence";
    rig.connect(500);
    const auto again = rig.frame();
    rig.play({tone(again + 600)}, again + 1200);
    EXPECT_NE(rig.codes()[again + 700], silence);
    EXPECT_EQ(rig.board.resets(), 0);
}

TEST(BoardRobustness, NoHelloCanMakeItSoundOnForLonger) {
    test::Rig rig;
    EXPECT_EQ(rig.connect(65535).watchdogMs, wire::defaultWatchdogMs);
    rig.play({tone(500)}, 560);
    rig.board.runUntil(rig.board.seconds() + 1.0);
    const std::size_t deadline = 20 + 17 + 4000 + 80; // it came at frame 20, took 2 ms; the hello
    const auto& codes = rig.codes();
    ASSERT_GT(codes.size(), deadline + 1000);
    EXPECT_NE(codes[deadline - 300], silence);
    for (std::size_t n = deadline; n < codes.size(); ++n) ASSERT_EQ(codes[n], silence) << n;
}

TEST(BoardRobustness, NothingIsStruckBeforeAHelloOrTwice) {
    test::Rig rig;
    rig.start();
    rig.send(wire::Strike{0, tone(400, 20)});
    rig.runTo(800);
    EXPECT_EQ(rig.telemetry().played, 0u);
    for (const auto& frame : rig.codes()) ASSERT_EQ(frame, silence);
    rig.connect();
    const std::uint32_t first = rig.frame() + 400;
    for (std::uint8_t i = 0; i < 3; ++i) rig.send(wire::Strike{i, tone(first + 100u * i, 5)});
    // the line says it all again
    for (std::uint8_t i = 0; i < 3; ++i) rig.send(wire::Strike{i, tone(first + 100u * i, 5)});
    rig.runTo(first + 600);
    rig.send(wire::Strike{0, tone(first, 5)}); // and later
    rig.runTo(first + 1000);
    const auto t = rig.telemetry();
    EXPECT_EQ(t.played, 3u);
    EXPECT_EQ(t.lost, 0u);
}

TEST(BoardRobustness, StopAllIsSilenceWithinTwoMilliseconds) {
    test::Rig rig;
    rig.connect();
    std::vector<BoardEvent> events;
    for (std::uint16_t i = 0; i < 128; ++i) { // with all modes busy
        BoardEvent e = tone(1000 + 30u * i);
        e.frequency16 = static_cast<std::uint16_t>(16 * 60 + 40 * i);
        events.push_back(e);
    }
    for (int i = 0; i < 20; ++i) {
        for (std::size_t k = 0; k < events.size(); ++k)
            events[k].frame = rig.frame() + 600 + 30u * static_cast<std::uint32_t>(k);
        // each time at another moment of a block
        rig.play(events, events.back().frame + 50 + static_cast<std::uint32_t>(i));
        const auto bytes = test::framed(wire::StopAll{});
        const double at = rig.board.seconds() + i * 0.000037;
        rig.board.send(bytes, at);
        const auto last = static_cast<std::uint64_t>(at * 72e6) + bytes.size() * 6250;
        rig.board.runUntil(rig.board.seconds() + 0.05);
        const auto& cycles = rig.board.peripherals().frameCycles;
        int checked = 0;
        for (std::size_t n = 0; n < cycles.size(); ++n)
            if (cycles[n] > last + 144'000 && cycles[n] < last + 2'000'000) {
                ASSERT_EQ(rig.codes()[n], silence) << i;
                ++checked;
            }
        ASSERT_GT(checked, 100);
    }
    EXPECT_EQ(rig.telemetry().pending, 0);
}

TEST(BoardRobustness, AFaultIsSilenceAndARestart) {
    test::Rig rig;
    rig.connect();
    rig.play({tone(500)}, 900);
    EXPECT_NE(rig.codes().back(), silence);
    const auto poll = rig.image().findSymbol("Link4poll").address & ~1u;
    const auto whole = rig.board.memory(poll, 2);
    const std::vector<std::uint8_t> undefined{0x00, 0xDE}; // UDF #0
    rig.board.writeMemory(poll, undefined);
    rig.board.runUntil(rig.board.seconds() + 0.002);
    EXPECT_EQ(rig.board.faults(), 1);
    EXPECT_EQ(rig.board.peripherals().converters.codes(), silence);
    rig.board.writeMemory(poll, whole);
    rig.board.runUntil(rig.board.seconds() + 0.08);
    EXPECT_EQ(rig.board.resets(), 1);
    EXPECT_EQ(rig.connect().resets, 1);
    EXPECT_EQ(rig.board.peripherals().converters.codes(), silence);
}

TEST(BoardRobustness, AFallingSupplyIsSilence) {
    test::Rig rig;
    rig.connect();
    rig.play({tone(500)}, 900);
    rig.board.peripherals().brownOut();
    rig.board.runUntil(rig.board.seconds() + 0.001);
    EXPECT_EQ(rig.board.peripherals().converters.codes(), silence);
}

} // namespace physvib::robustness_test
