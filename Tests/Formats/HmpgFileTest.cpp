// SPDX-License-Identifier: MIT
// MPEG's bits: where each stands, what 8 bits of amplitude cost, what others write, and what is refused in
// one line.
#include "Formats/HmpgFile.h"
#include "ClipTesting.h"
#include "Formats/BitStream.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipLimits.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;

Clip readBack(const std::string& bytes) {
    auto clip = readHmpg(bytes, "f");
    EXPECT_EQ(clip.error, "");
    return std::move(clip.value);
}

std::string refusal(const std::string& bytes) {
    const auto clip = readHmpg(bytes, "f");
    EXPECT_FALSE(clip);
    EXPECT_EQ(clip.error.find('\n'), std::string::npos);
    return clip.error;
}

/// "0110" and numbers as "value:bits", apart from one another by spaces; filled up to a whole byte.
std::string bits(const std::string& text) {
    BitWriter out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size()), colon = text.find(':', at);
        if (end > at) {
            if (colon < end)
                out.number(static_cast<std::uint64_t>(std::stoll(text.substr(at))),
                           std::stoi(text.substr(colon + 1)));
            else
                for (std::size_t i = at; i < end; ++i) out.number(text[i] == '1', 1);
        }
        at = end + 1;
    }
    return out.bytes();
}

std::string packet(int type, const std::string& content) {
    return bits(std::to_string(type) + ":6 " + std::to_string(content.size()) + ":17 0") + content;
}
std::string unit(int type, int ticks, const std::string& packets) {
    return bits(std::to_string(type) + ":6 0:2 0:4 " + std::to_string(ticks) + ":24 " +
                std::to_string(packets.size()) + ":32 0:4") +
           packets;
}

/// At 1000 ticks: a vibrotactile perception 3 and one of heat, a channel 9 of gain 0.5, bands by their
/// descriptions.
std::string head(const std::string& bands, const std::string& library = "") {
    return unit(0, 0,
                packet(11, bits("0:32 1000:32 128:24 0:24 0")) +
                    packet(1, bits("4:8 50:8 48:8 50:8 53:8 0:8 1:8 0:8 1:8 120:8 2:8 0:8")) +
                    packet(2, bits("3:8 0:8 0:8 6:8 0:8 0:16 0 253:8 0:8 0:8 1:16")) +
                    packet(2, bits("4:8 0:8 0:8 5:8 0:8 0:16 0 253:8 0:8 0:8 1:16")) + library +
                    packet(3, bits("9:16 3:8 0:8 1:8 65:8 255:8 2147591022:32 429496:32 2:8 20:8 10:8 1:8 "
                                   "0:8 1:8 4:8 5:8 0:8 0:32 0:16 3:8")) +
                    packet(3, bits("10:16 4:8 0:8 0:8 255:8 0:32 0:32 0:8 0:32 0:16 0:8")) + bands);
}

const std::string wave = packet(4, bits("0:8 3:8 9:16 0:8 2:3 0:16 1000:16 1:16"));

/// Data of a band of channel 9 of that many effects.
std::string data(int band, int effects, const std::string& content) {
    return packet(
        5, bits("0 3:8 9:16 " + std::to_string(band) + ":8 " + std::to_string(effects) + ":16 " + content));
}

TEST(HmpgFile, PutsEveryBitWhereMpegsSoftwareDoes) {
    const Clip clip{
        "x",
        0.0,
        0.0,
        {ClipChannel{
            "A",
            {},
            {0.0, 250.0, 0.0, 0.0},
            {{{ClipWave{0.25, 0.0, ClipWaveform::square, {{0.0, 0.5}, {0.5, -0.5}}, {{0.0, 200.0}}}}}},
            {}}}};
    const std::string gain = std::to_string(std::llround(10'000.5 / 20'000.0 * 4294967295.0)) + ":32",
                      one = std::to_string(std::llround(4294967295.0 / 10'000.0)) + ":32";
    std::string date;
    for (const char c : std::string{"1970-01-01T00:00:00Z"}) date += " " + std::to_string(c) + ":8";
    const std::string wanted =
        unit(
            0, 0,
            packet(11, bits("0:32 48000:32 24000:24 0:24 0")) +
                packet(1, bits("4:8 50:8 48:8 50:8 51:8 4:8 77:8 97:8 105:8 110:8 1:8 20:8" + date +
                               " 1:8 120:8 1:8 1:8 1:8 0:8 1:8")) +
                packet(2,
                       bits("0:8 0:8 1:8 120:8 6:8 1:8 0:16 0 253:8 0:8 1:8 1:8 1:8 65:8 0:32 100000000000 " +
                            std::to_string(std::llround(0.025 * 4294967295.0)) + ":32 1:16")) +
                packet(3, bits("0:16 0:8 0:8 1:8 65:8 1:8 " + gain + " " + one + " 0:8 0:32 0:16 1:8")) +
                packet(4, bits("0:8 0:8 0:16 0:8 2:3 0:16 1000:16 1:16"))) +
        unit(3, 12000, "") +
        unit(1, 24000,
             packet(5, bits("0 0:8 0:16 0:8 1:16 0:16 0:2 0:25 0 2:16 0:16 1:4 11 255:8 0:16 200:16 01 0:8 "
                            "24000:16")));
    EXPECT_TRUE(hmpgBytes(clip).value == wanted);
}

TEST(HmpgFile, ComesBackAsItsEightBitsExplain) {
    Clip clip = clipOf(hits(40), 0.001);
    clip.extentWidthMetres = 0.12;
    clip.extentHeightMetres = 0.06;
    constexpr EnchanterPlace places[] = {{0.0, 0.06}, {0.12, 0.06}, {0.0, 0.0}, {0.12, 0.0}};
    for (std::size_t j = 0; j < 4; ++j)
        clip.channels[j].label = std::string(1, static_cast<char>('A' + j)),
        clip.channels[j].place = places[j];
    const std::string bytes = hmpgBytes(clip).value;
    const Clip again = readBack(bytes);
    const double step = hmpgStep(clip), modes = 2.0; // at once; phases have 16 bits, of 1e-4 rad
    const double found = farthest(clipSound(clip, rateHz).channels, clipSound(again, rateHz).channels);
    RecordProperty("farthest", std::to_string(found));
    EXPECT_LE(found, modes * (step + 1e-4 * 255.0 * step));
    EXPECT_GE(found, 0.5 * step); // no finer than 8 bits
    for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_EQ(again.channels[j].label, clip.channels[j].label);
        ASSERT_TRUE(again.channels[j].place);
        EXPECT_NEAR(again.channels[j].place->xMetres, places[j].xMetres, 1e-12);
        EXPECT_NEAR(again.channels[j].place->yMetres, places[j].yMetres, 1e-12);
        ASSERT_EQ(again.channels[j].bands.size(), clip.channels[j].bands.size());
        for (std::size_t b = 0; b < clip.channels[j].bands.size(); ++b)
            for (std::size_t w = 0; w < clip.channels[j].bands[b].waves.size(); ++w) // onsets to the tick
                EXPECT_EQ(std::llround(again.channels[j].bands[b].waves[w].startSeconds * rateHz),
                          std::llround(clip.channels[j].bands[b].waves[w].startSeconds * rateHz));
    }
    EXPECT_TRUE(bytes == hmpgBytes(clip).value);
    EXPECT_TRUE(bytes == hmpgBytes(again).value); // nothing more is lost
}

TEST(HmpgFile, CarriesLongWavesTransientsAndSilences) {
    Clip clip{
        "",
        0,
        0,
        {ClipChannel{
            "A",
            {},
            {},
            {{{ClipWave{
                500.0, 0.3, ClipWaveform::sine, {{0.0, 1.0}, {3.9, 0.5}}, {{0.0, 50.0}, {3.0, 90.0}}}}}},
            {{0.5, 0.25, 120.0}, {0.75, 1.0, 200.0}}}}};
    const Clip again = readBack(hmpgBytes(clip).value);
    ASSERT_EQ(again.channels.size(), 1u);
    EXPECT_EQ(again.channels[0].bands[0].waves.size(), 3u); // 16 bits of ticks are 1.37 s
    EXPECT_EQ(again.channels[0].transients.size(), 2u);
    for (double t = 0.0; t < 3.9; t += 0.1) // the phase goes on where a piece ends; a piece's frequency ends
                                            // on a whole Hz
        for (const ClipWave& piece : again.channels[0].bands[0].waves)
            if (t >= piece.startSeconds - 500.0 && t < piece.endSeconds() - 500.0) {
                EXPECT_NEAR(valueAt(piece.frequencyHz, t + 500.0 - piece.startSeconds),
                            std::min(90.0, 50.0 + 40.0 * t / 3.0), 0.51);
                EXPECT_NEAR(valueAt(piece.amplitude, t + 500.0 - piece.startSeconds), 1.0 - 0.5 * t / 3.9,
                            0.004);
            }
    EXPECT_LT(hmpgBytes(clip).value.size(), 600u); // 500 s of silence take 9 bytes for each 349 s
}

TEST(HmpgFile, TellsJsonByItsBeginning) {
    const std::string json = "f: expected the bits of an .hmpg, found JSON: this looks like .hjif";
    EXPECT_EQ(refusal("{}"), json);
    EXPECT_EQ(refusal(" \r\n\t{\"version\": \"2023\"}"), json);
    EXPECT_NE(refusal(" "), json);
}

TEST(HmpgFile, ReadsWhatOthersWrite) {
    // effects cut at units, as MPEG's software has it unless told otherwise; a word for what they mean; an
    // effect of the library; curves; silence
    const std::string library =
        packet(6, bits("3:8 2:16  7:16 0:2 1 513:12 0:25 0:16 0:4 2:16 111 0:16 255:8 100:16 011 30:16 0:8 "
                       "0:16  8:16 2:2 0 0:25 0:16 1:16 9:16 0:2 0 0:25 0:16 0:4 0:16 0:16"));
    const std::string bands = wave + packet(4, bits("1:8 3:8 9:16 0:8 0:3 0:16 1000:16 1:16")) +
                              packet(4, bits("2:8 3:8 9:16 0:8 1:3 1:4 0:16 1000:16 1:16")) +
                              packet(4, bits("3:8 4:8 10:16 0:8 3:3 0:8 0:16 1000:16 1:16"));
    const Clip clip = readBack(
        head(bands, library) + unit(3, 128, "") +
        unit(1, 128,
             data(0, 1, "5:16 0:2 22:25 1 513:12 2:16 10430:16 1:4 10 0:16 60:16 01 255:8 50:16") +
                 data(1, 1, "6:16 0:2 10:25 0 1:16 255:8 5:16 90:16") +
                 data(2, 1, "6:16 0:2 0:25 0 2:16 128:8 0:16 255:8 8:16") +
                 packet(5, bits("0 4:8 10:16 3:8 1:16 1:16 0:2 0 111"))) +
        unit(1, 128, data(0, 2, "5:16 0:2 -106:25 0 1:16 10430:16 1:4 10 200:16 90:16  7:16 1:2 100:25")) +
        unit(2, 0, packet(5, "?")) + unit(3, 9, packet(0, bits("0:32"))));
    ASSERT_EQ(clip.channels.size(), 1u);
    const ClipChannel& channel = clip.channels[0];
    EXPECT_EQ(channel.label, "A");
    EXPECT_EQ(clip.title, "x");
    ASSERT_TRUE(channel.place);
    EXPECT_NEAR(channel.place->yMetres, 0.005, 1e-12);
    ASSERT_EQ(channel.bands.size(), 2u);
    ASSERT_EQ(channel.bands[0].waves.size(), 2u);
    const ClipWave &first = channel.bands[0].waves[0], &second = channel.bands[0].waves[1];
    EXPECT_NEAR(first.startSeconds, 0.15, 1e-12);
    EXPECT_NEAR(first.phaseRadians, 1.0, 1e-4);
    EXPECT_EQ(first.waveform, ClipWaveform::square);
    EXPECT_NEAR(first.seconds(), 0.2, 1e-9);
    EXPECT_NEAR(valueAt(first.amplitude, 0.1), 0.5, 1e-5);
    EXPECT_EQ(first.frequencyHz, (std::vector<ClipPoint>{{0.0, 60.0}, {0.2, 90.0}}));
    EXPECT_NEAR(second.startSeconds, 0.356, 1e-12);
    EXPECT_NEAR(valueAt(second.amplitude, 0.0), 0.5, 1e-5);
    EXPECT_NEAR(valueAt(second.amplitude, 0.03), -0.5, 1e-5);
    // 3 s^2 - 2 s^3
    EXPECT_NEAR(valueAt(channel.bands[1].waves[0].amplitude, 0.002), 0.5 * (0.0625 * 2.5), 0.003);
    ASSERT_EQ(channel.transients.size(), 1u);
    EXPECT_NEAR(channel.transients[0].seconds, 0.143, 1e-12);
    EXPECT_EQ(channel.transients[0].frequencyHz, 90.0);
}

TEST(HmpgFile, RefusesInOneLine) {
    EXPECT_EQ(refusal(""), "f: expected a vibrotactile perception with channels, found none");
    EXPECT_EQ(refusal("|}"), "f: byte 0: expected a unit of type 0 to 3, found 31");
    EXPECT_EQ(refusal(std::string(4, '\0')), "f: byte 1: expected 3 more bytes, found 2");
    EXPECT_EQ(refusal(unit(1, 1, "")), "f: byte 0: expected a unit of type 0 first, found 1");
    EXPECT_EQ(refusal(unit(0, 0, "")), "f: byte 0: expected a timescale in the first unit");
    EXPECT_EQ(refusal(bits("0:6 0:2 0:4 0:24 4294967295:32 0:4")),
              "f: byte 9: expected 4294967295 more bytes, found 0");
    EXPECT_EQ(refusal(unit(0, 0, bits("1:6 131071:17 0"))),
              "f: byte 12: expected 131071 more bytes, found 0");
    EXPECT_EQ(refusal(head(wave)), "f: expected something to feel, found silence");
    EXPECT_NE(refusal(head(packet(4, bits("0:8 3:8 9:16 0:8 3:3 0:8 0:16 0:16 0:16"))))
                  .find("expected waves, transients or curves, found wavelets, which are not read"),
              std::string::npos);
    EXPECT_NE(
        refusal(head(wave) + unit(1, 9, data(1, 1, ""))).find("expected data of a band that was told before"),
        std::string::npos);
    EXPECT_NE(refusal(head(wave) + unit(1, 9, data(0, 1, "5:16 2:2 0:25"))).find("found a composite"),
              std::string::npos);
    EXPECT_NE(refusal(head(wave) + unit(1, 9, data(0, 1, "5:16 1:2 0:25")))
                  .find("expected an effect of the library, found none"),
              std::string::npos);
    EXPECT_NE(refusal(head(wave) + unit(1, 9, data(0, 1, "5:16 0:2 -1:25 0 0:16 0:16 0:4")))
                  .find("expected an effect that begins within 0 to 600 s, found -0.001"),
              std::string::npos);
    EXPECT_NE(refusal(head(wave) + unit(1, 9, data(0, 1, "5:16 0:2 0:25 0 2:16 0:16 0:4 00 9:16 00 8:16")))
                  .find("expected keyframes in time order"),
              std::string::npos);
    EXPECT_NE(refusal(head(wave) + unit(1, 9, data(0, 1, "5:16 0:2 0:25 0 65535:16 0:16 0:4")))
                  .find("more bytes, found"),
              std::string::npos);
}

TEST(HmpgFile, IsBounded) {
    std::string nested; // a library whose effects lie within one another
    for (int i = 0; i < 3000; ++i) nested += " 1:16 2:2 0 0:25 0:16 1:16";
    EXPECT_NE(refusal(head(wave, packet(6, bits("3:8 1:16" + nested)))).find("found more than 8"),
              std::string::npos);
    BitWriter many; // effects of nothing
    many.number(0, 1), many.number(3, 8), many.number(9, 16), many.number(0, 8), many.number(2000, 16);
    for (int i = 0; i < 2000; ++i) many.number(7, 16), many.number(1, 2), many.number(0, 25);
    const std::string library = packet(6, bits("3:8 1:16 7:16 0:2 0 0:25 0:16 0:4 0:16 0:16"));
    std::string units = head(wave, library);
    for (std::size_t i = 0; i <= limits::maxClipPoints / 2000; ++i)
        units += unit(1, 1, packet(5, many.bytes()));
    EXPECT_NE(refusal(units).find("expected at most 500000 effects and keyframes in the file, found more"),
              std::string::npos);
    EXPECT_NE(refusal(std::string(limits::maxClipFileBytes + 1, ' ')).find("expected at most 24000000 bytes"),
              std::string::npos);
    Clip wide{
        "",
        0,
        0,
        {ClipChannel{"A",
                     {},
                     {},
                     std::vector<ClipBand>(300, ClipBand{{ClipWave{0, 0, {}, {{0, 1}, {1, 1}}, {{0, 80}}}}}),
                     {}}}};
    EXPECT_EQ(hmpgBytes(wide).error, "expected at most 256 bands, found 300");
}

} // namespace
} // namespace physvib
