// SPDX-License-Identifier: MIT
// The Pico's signal path: what passes unchanged, and how it starts, stops and misses packets.
#include "Signal/FrameBuffer.h"
#include "Signal/Indicator.h"
#include "Streams.h"
#include <gtest/gtest.h>

namespace physvib::pico_player_test {

using pico::tileFrames;
using test::Stream;
using test::tone;

template <int channels>
void expectEveryFrame() {
    Stream<channels> stream;
    stream.play(tone, 400);
    // Playing starts with the first frame that was sent; the gate is open after the soft start.
    const auto begin = stream.out.size() - 48 * 400;
    std::size_t first = begin;
    while (stream.out[first] == pico::Frame<channels>{}) ++first;
    first -= first % tileFrames; // the first frame is 0 on all channels
    int equal = 0;
    for (std::size_t n = 5000; first + n < stream.out.size(); ++n)
        for (int j = 0; j < channels; ++j) {
            ASSERT_EQ(stream.out[first + n][static_cast<std::size_t>(j)],
                      tone(static_cast<std::int64_t>(n), j))
                << n;
            ++equal;
        }
    EXPECT_GT(equal, channels * 13000);
    EXPECT_EQ(stream.player->underruns(), 0u);
    EXPECT_EQ(stream.player->buffer.overruns(), 0u);
    EXPECT_EQ(stream.player->limitedTiles(), 0u);
}

TEST(PicoPlayer, PassesEveryFrameAsItIs) {
    expectEveryFrame<4>();
    expectEveryFrame<8>();
}

TEST(PicoPlayer, StartsSoftly) {
    Stream<4> stream;
    stream.play([](auto, int) -> std::int16_t { return 20000; }, 10);
    for (std::size_t n = 1; n < stream.out.size(); ++n)
        ASSERT_LE(std::abs(stream.out[n][0] - stream.out[n - 1][0]),
                  20000 / (pico::Player<4>::startTiles * 16) + 1)
            << n;
}

// A sound server closes the card after a pause, and opens it for the next hit.
TEST(PicoPlayer, AHitThatBeginsTheStreamAfterAPauseIsFelt) {
    Stream<4> stream;
    const auto constant = [](auto, int) -> std::int16_t { return 800; };
    const auto share = [&] { // of the power of a hit that begins with the stream, in its first 100 ms
        const auto began = stream.sent;
        const auto hit = [began](auto n, int j) { // 200 Hz that ends within 100 ms
            return static_cast<std::int16_t>(tone(2 * (n - began), j) *
                                             std::exp(-double(n - began) / 1500.0));
        };
        const auto first = stream.out.size();
        stream.play(hit, 120);
        double sent = 0.0, felt = 0.0;
        for (std::int64_t n = began; n < began + 4800; ++n) sent += hit(n, 0) * hit(n, 0);
        for (std::size_t n = first; n < stream.out.size(); ++n) felt += stream.out[n][0] * stream.out[n][0];
        return felt / sent;
    };
    const auto pause = [&] {
        stream.isAllowed = false;
        stream.tiles(15000);
        stream.isAllowed = true;
    };
    stream.play(constant, 300);
    pause();
    EXPECT_GT(share(), 0.9);
    pause();
    stream.player->requestSoftStart(); // silence was commanded, or the computer suspended
    EXPECT_LT(share(), 0.2);
    stream.play(constant, 300);
    stream.isAttended = false; // the main loop hung
    stream.tiles(20);
    stream.isAttended = true;
    EXPECT_LT(share(), 0.2);
}

// Silence within 5 ms of the last packet, whatever it held, and no step on the way.
TEST(PicoPlayer, RampsToSilenceWhenPacketsStop) {
    Stream<4> stream;
    stream.play([](auto n, int) -> std::int16_t { return n / 240 % 2 == 0 ? 20000 : -20000; }, 300);
    const auto last = stream.out.size();
    stream.tiles(60);
    std::size_t end = stream.out.size();
    while (end > 0 && stream.out[end - 1] == pico::Frame<4>{}) --end;
    EXPECT_GT(end, last);
    constexpr std::size_t inOutput = 2 * tileFrames + 8; // what DMA and the FIFO of the chip hold
    EXPECT_LE(end - last + inOutput, 48u * 5);
    for (std::size_t n = end - tileFrames; n < end; ++n)
        EXPECT_LE(std::abs(stream.out[n][0] - stream.out[n - 1][0]), 20000 / 40) << n;
    EXPECT_FALSE(stream.player->isPlaying());
    EXPECT_EQ(stream.player->underruns(), 0u) << "a host may stop";
    stream.tiles(6);
    EXPECT_FALSE(stream.player->isAmplifierOn());
}

TEST(PicoPlayer, RampsToSilenceWhenItIsNotAllowed) {
    Stream<4> stream;
    stream.play([](auto, int) -> std::int16_t { return 800; }, 300);
    EXPECT_EQ(stream.out.back()[0], 800);
    EXPECT_TRUE(stream.player->isAmplifierOn());
    stream.isAllowed = false;
    stream.packet([](auto, int) -> std::int16_t { return 800; });
    stream.tiles(3);
    EXPECT_EQ(stream.out.back()[0], 0);
    EXPECT_GT(stream.out[stream.out.size() - tileFrames][0], 0);
    EXPECT_TRUE(stream.player->isAmplifierOn()) << "the output still holds the ramp";
    stream.play(tone, 20);
    EXPECT_EQ(stream.out.back()[1], 0);
    EXPECT_FALSE(stream.player->isAmplifierOn());
}

TEST(PicoPlayer, RampsToSilenceWhenTheMainLoopHangs) {
    Stream<4> stream;
    stream.play([](auto, int) -> std::int16_t { return 800; }, 300);
    stream.isAttended = false;
    stream.play([](auto, int) -> std::int16_t { return 800; }, 4);
    EXPECT_EQ(stream.out.back()[0], 0);
    EXPECT_EQ(stream.player->underruns(), 0u);
    EXPECT_EQ(stream.player->unattendedTiles(), 12u);
    stream.isAttended = true;
    stream.play([](auto, int) -> std::int16_t { return 800; }, 300);
    EXPECT_EQ(stream.out.back()[0], 800);
}

TEST(PicoPlayer, BridgesAPacket) {
    Stream<4> stream;
    stream.play(tone, 300);
    stream.tiles(3); // one is missing
    stream.play(tone, 100);
    EXPECT_EQ(stream.player->underruns(), 0u);
    EXPECT_TRUE(stream.player->isPlaying());
}

TEST(PicoPlayer, CountsWhatItCannotBridge) {
    Stream<4> stream;
    stream.play(tone, 300);
    for (int k = 0; k < 20; ++k)
        stream.packet(tone, 40), stream.tiles(3); // too few frames, as if time were slow
    EXPECT_EQ(stream.player->underruns(), 1u);
    stream.play(tone, 300);
    EXPECT_TRUE(stream.player->isPlaying());
    EXPECT_EQ(stream.player->underruns(), 1u);
}

TEST(PicoPlayer, DropsWhatWouldBeLatency) {
    Stream<4> stream;
    stream.play(tone, 300);
    for (int k = 0; k < 20; ++k) stream.packet(tone);
    EXPECT_GT(stream.player->buffer.overruns(), 0u);
    EXPECT_LE(stream.player->buffer.level(), pico::FrameBuffer<4>::maxFrames);
    EXPECT_TRUE(stream.player->isPlaying());
}

TEST(PicoPlayer, HasACeiling) {
    Stream<4> open, low(true);
    const auto loud = [](auto n, int) -> std::int16_t { return n / 60 % 2 == 0 ? 32767 : -32768; };
    open.play(loud, 300);
    low.play(loud, 300);
    int most = 0;
    for (const auto& frame : open.out) most = std::max(most, std::abs(static_cast<int>(frame[0])));
    EXPECT_EQ(most, 32767);
    EXPECT_GT(open.player->limitedTiles(), 0u);
    most = 0;
    for (const auto& frame : low.out) most = std::max(most, std::abs(static_cast<int>(frame[0])));
    EXPECT_EQ(most, 8191);
}

TEST(PicoPlayer, BeginsWithTheLowCeiling) { EXPECT_EQ(pico::Player<4>().ceiling(), 8191); }

// A wire that falls out is felt no longer than a tile; one that is put in is felt softly.
TEST(PicoPlayer, LowersItsCeilingAtOnceAndRaisesItSoftly) {
    Stream<4> stream;
    const auto constant = [](auto n, int) -> std::int16_t { return n / 24 % 2 == 0 ? 20000 : -20000; };
    stream.play(constant, 300);
    stream.player->setLowCeiling(true);
    const auto fell = stream.out.size();
    stream.play(constant, 20);
    for (std::size_t n = fell + tileFrames - 1; n < stream.out.size(); ++n)
        ASSERT_LE(std::abs(stream.out[n][0]), 5000) << n - fell;
    EXPECT_EQ(stream.player->ceiling(), 8191);
    stream.player->setLowCeiling(false);
    const auto rose = stream.out.size();
    stream.play(constant, 200);
    for (std::size_t n = rose; n < stream.out.size(); ++n)
        ASSERT_LE(std::abs(stream.out[n][0]), 5000 + 20000 * static_cast<int>(n - rose + 32) / 4760) << n;
    EXPECT_EQ(std::abs(stream.out.back()[0]), 20000);
    EXPECT_EQ(stream.player->ceiling(), 32767);
}

TEST(PicoCeilingJumper, CountsWhenItHasLainStill) {
    pico::CeilingJumper jumper;
    constexpr auto still = pico::CeilingJumper::debounceTiles;
    std::uint32_t t = 1;
    for (; t < 10 * still; ++t) // a contact that never lies still
        ASSERT_FALSE(jumper.update(t, t % still != 0)) << t;
    EXPECT_FALSE(jumper.update(t++, false));
    const auto tied = t;
    for (; t < tied + still; ++t) ASSERT_FALSE(jumper.update(t, true)) << t;
    EXPECT_TRUE(jumper.update(t++, true));
    EXPECT_FALSE(jumper.update(t++, false)) << "at once";
    EXPECT_FALSE(jumper.update(t++, true));
}

TEST(PicoPlayer, FollowsVolumesWithoutAStep) {
    Stream<4> stream;
    const auto constant = [](auto, int) -> std::int16_t { return 800; };
    stream.play(constant, 300);
    stream.player->setVolume(1, pico::unity / 4);
    const auto at = stream.out.size();
    stream.play(constant, 30);
    EXPECT_EQ(stream.out.back()[0], 800);
    EXPECT_EQ(stream.out.back()[1], 200);
    for (std::size_t n = at; n < stream.out.size(); ++n)
        ASSERT_LE(std::abs(stream.out[n][1] - stream.out[n - 1][1]), 3) << n;
}

// Packets that are missing, dropped or cut: what follows fades in, where a step would be a click.

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

constexpr int mostStep = 2 * 800 / pico::GapCrossfade<4>::fadeFrames + 2;

TEST(PicoDroppedFrames, AStreamWithoutGapsStepsAsItsSourceDoes) {
    EXPECT_EQ(stepAfter([](auto& stream, auto&, auto& turnsAt) { turnsAt = stream.sent; }), 1600);
}

TEST(PicoDroppedFrames, AMissingPacketFades) {
    EXPECT_LE(stepAfter([](auto& stream, auto&, auto& turnsAt) {
                  stream.tiles(3);
                  turnsAt = stream.sent;
                  stream.player->buffer.markGap();
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
    EXPECT_FALSE(missing.update(700, false)) << "the first one";
    EXPECT_FALSE(missing.update(701, true));
    EXPECT_TRUE(missing.update(703, true));
    EXPECT_FALSE(missing.update(703, true)) << "looked at late";
    EXPECT_FALSE(missing.update(704, true));
    EXPECT_EQ(missing.count(), 1u);
    EXPECT_FALSE(missing.update(2047, false)) << "a new stream";
    EXPECT_FALSE(missing.update(0, true)) << "eleven bits";
    EXPECT_TRUE(missing.update(3, true));
    EXPECT_EQ(missing.count(), 3u);
}

} // namespace physvib::pico_player_test
