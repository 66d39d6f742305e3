// SPDX-License-Identifier: MIT
// Packets that are missing, dropped or cut: what follows fades in, where a step would be a click.
#include "Signal/FrameBuffer.h"
#include "Streams.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using test::Stream;

int largestStep(const Stream<4>& stream, std::size_t from) {
    int most = 0;
    for (std::size_t n = from; n < stream.out.size(); ++n)
        most = std::max(most, std::abs(stream.out[n][0] - stream.out[n - 1][0]));
    return most;
}
// A source that turns exactly where frames are missing: from there on the other sign.
template <class Lose>
int stepAfter(Lose&& lose) {
    Stream<4> stream;
    std::int64_t turnsAt = -1;
    const auto source = [&](std::int64_t n, int) -> std::int16_t {
        return static_cast<std::int16_t>(turnsAt < 0 || n < turnsAt ? 800 : -800);
    };
    stream.play(source, 300);
    const auto from = stream.out.size();
    lose(stream, source, turnsAt);
    stream.play(source, 200);
    EXPECT_EQ(stream.out.back()[0], -800);
    for (std::size_t n = from; n < stream.out.size(); ++n)
        EXPECT_LE(std::abs(stream.out[n][0]), 800) << "stronger than what was sent";
    return largestStep(stream, from);
}

constexpr int mostStep = 2 * 800 / pico::DroppedFrames<4>::fadeFrames + 2;

TEST(PicoDroppedFrames, AStreamWithoutGapsStepsAsItsSourceDoes) {
    EXPECT_EQ(stepAfter([](auto& stream, auto&, auto& turnsAt) { turnsAt = stream.sent; }), 1600);
}

TEST(PicoDroppedFrames, AMissingPacketFades) {
    EXPECT_LE(stepAfter([](auto& stream, auto&, auto& turnsAt) {
                  stream.tiles(3);
                  turnsAt = stream.sent;
                  stream.player->buffer.miss();
              }),
              mostStep);
}

TEST(PicoDroppedFrames, APacketThatDoesNotFitFades) {
    EXPECT_LE(stepAfter([](auto& stream, auto& source, auto& turnsAt) {
                  const auto before = stream.player->buffer.overruns();
                  while (stream.player->buffer.overruns() == before) stream.packet(source);
                  turnsAt = stream.sent;
                  stream.tiles(6);
              }),
              mostStep);
}

// Frames come again while the gate still closes over those that were missing.
TEST(PicoDroppedFrames, WhatComesWhileItStopsFades) {
    EXPECT_LE(stepAfter([](auto& stream, auto& source, auto& turnsAt) {
                  while (stream.player->underruns() == 0) stream.packet(source, 10), stream.tiles(1);
                  turnsAt = stream.sent;
                  stream.packet(source);
                  stream.tiles(3);
              }),
              800 / 40 + mostStep);
}

TEST(PicoMissingPackets, AreCountedByTheNumbersOfTheBus) {
    pico::MissingPackets missing;
    EXPECT_FALSE(missing.see(700, false)) << "the first one";
    EXPECT_FALSE(missing.see(701, true));
    EXPECT_TRUE(missing.see(703, true));
    EXPECT_FALSE(missing.see(703, true)) << "looked at late";
    EXPECT_FALSE(missing.see(704, true));
    EXPECT_EQ(missing.count(), 1u);
    EXPECT_FALSE(missing.see(2047, false)) << "a new stream";
    EXPECT_FALSE(missing.see(0, true)) << "eleven bits";
    EXPECT_TRUE(missing.see(3, true));
    EXPECT_EQ(missing.count(), 3u);
}

} // namespace
} // namespace physvib
