// SPDX-License-Identifier: MIT
// MPEG's JSON: what was written is read again and sounds the same; what others write is read or refused.
#include "ClipTesting.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;

Clip scene() {
    Clip clip = clipOf(hits(40), 0.001);
    clip.title = "hits";
    clip.extentWidthMetres = 0.12;
    clip.extentHeightMetres = 0.06;
    constexpr EnchanterPlace places[] = {{0.0, 0.06}, {0.12, 0.06}, {0.0, 0.0}, {0.12, 0.0}};
    for (std::size_t j = 0; j < 4; ++j) {
        clip.channels[j].label = std::string(1, static_cast<char>('A' + j));
        clip.channels[j].place = places[j];
    }
    return clip;
}

Clip read(const std::string& text) {
    auto clip = readHjif(text, "f");
    EXPECT_EQ(clip.error, "");
    return std::move(clip.value);
}

std::string refusal(const std::string& text) {
    const auto clip = readHjif(text, "f");
    EXPECT_FALSE(clip);
    EXPECT_EQ(clip.error.find('\n'), std::string::npos);
    return clip.error;
}

/// One channel with these bands, at 1000 ticks.
std::string file(const std::string& bands, const std::string& library = "") {
    return R"({"version": "2023", "avatars": [], "perceptions": [{"perception_modality": "Vibrotactile", "effect_library": [)" +
           library +
           R"(], "channels": [{"id": 0, "description": "left", "gain": 0.5, "mixing_coefficient": 1, "bands": [)" +
           bands + "]}]}]}";
}

std::string vectorial(const std::string& effects) {
    return R"({"band_type": "VectorialWave", "lower_frequency_limit": 0, "upper_frequency_limit": 1000, "effects": [)" +
           effects + "]}";
}

TEST(HjifFile, SoundsTheSameWhenReadAgain) {
    const Clip clip = scene();
    const Clip again = read(hjifText(clip));
    // a phase just below 2 pi is rounded to their limit
    EXPECT_LE(farthest(clipSound(clip, rateHz).channels, clipSound(again, rateHz).channels), 6e-6);
    EXPECT_EQ(again.title, "hits");
    for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_EQ(again.channels[j].label, clip.channels[j].label);
        ASSERT_TRUE(again.channels[j].place);
        EXPECT_NEAR(again.channels[j].place->xMetres, clip.channels[j].place->xMetres, 1e-12);
        EXPECT_NEAR(again.channels[j].place->yMetres, clip.channels[j].place->yMetres, 1e-12);
    }
    EXPECT_NEAR(again.extentWidthMetres, 0.12, 1e-12);
}

TEST(HjifFile, IsWrittenTheSameTwice) {
    const std::string text = hjifText(scene());
    EXPECT_TRUE(text == hjifText(scene()));
    EXPECT_TRUE(text == hjifText(read(text)));
}

TEST(HjifFile, KeepsWhatIsLouderThanFullScaleAsAGain) {
    CollisionEvent loud{0, 200.0, 40.0, 3.0, 0.0, 1.0};
    const Clip clip = clipOf({&loud, 1}, 0.001);
    const std::string text = hjifText(clip);
    EXPECT_NE(text.find("\"gain\": 3,"), std::string::npos);
    EXPECT_LE(farthest(clipSound(clip, rateHz).channels, clipSound(read(text), rateHz).channels), 1e-6);
}

TEST(HjifFile, CarriesTransients) {
    Clip clip{"", 0, 0, {ClipChannel{"A", {}, {}, {}, {{0.5, 0.25, 120.0}, {0.75, 1.0, 200.0}}}}};
    EXPECT_EQ(read(hjifText(clip)).channels, clip.channels);
}

TEST(HjifFile, ReadsWhatOthersWrite) {
    const Clip clip = read(file(
        vectorial(R"({"effect_type": "Basis", "position": 100, "phase": 1, "base_signal": "Square",
        "keyframes": [{"relative_position": 0, "frequency_modulation": 60}, {"amplitude_modulation": 1, "relative_position": 50}, {"relative_position": 200, "frequency_modulation": 90}], "more": 1},
        {"effect_type": "Reference", "position": 400, "id": 7})") +
            R"(, {"band_type": "Transient", "effects": [{"effect_type": "Basis", "position": 10, "keyframes": [{"relative_position": 5, "amplitude_modulation": 1, "frequency_modulation": 90}]}]})"
            R"(, {"band_type": "Curve", "curve_type": "Cubic", "effects": [{"effect_type": "Basis", "position": 0, "keyframes": [{"relative_position": 0, "amplitude_modulation": 0}, {"relative_position": 8, "amplitude_modulation": 1}]}]})",
        R"({"id": 7, "effect_type": "Basis", "keyframes": [{"relative_position": 0, "amplitude_modulation": 1, "frequency_modulation": 100}, {"relative_position": 30, "amplitude_modulation": 0}]})"));
    ASSERT_EQ(clip.channels.size(), 1u);
    const ClipChannel& channel = clip.channels[0];
    EXPECT_EQ(channel.label, "left");
    EXPECT_FALSE(channel.place);
    ASSERT_EQ(channel.bands.size(), 2u);
    const ClipWave first{
        0.1, 1.0, ClipWaveform::square, {{0.05, 0.5}, {0.2, 0.5}}, {{0.0, 60.0}, {0.2, 90.0}}};
    const ClipWave second{0.4, 0.0, ClipWaveform::sine, {{0.0, 0.5}, {0.03, 0.0}}, {{0.0, 100.0}}};
    EXPECT_EQ(channel.bands[0].waves, (std::vector<ClipWave>{first, second}));
    // 3 s^2 - 2 s^3
    EXPECT_NEAR(valueAt(channel.bands[1].waves[0].amplitude, 0.002), 0.5 * (0.0625 * 2.5), 1e-12);
    EXPECT_EQ(channel.transients, (std::vector<ClipTransient>{{0.015, 0.5, 90.0}}));
}

TEST(HjifFile, GivesEveryChannelABodyPartForMpegsReader) {
    const std::string text = hjifText(scene());
    std::size_t channels = 0;
    for (std::size_t at = text.find("\"body_part_mask\": 0,"); at != std::string::npos;
         at = text.find("\"body_part_mask\": 0,", at + 1))
        ++channels;
    EXPECT_EQ(channels, 4u);
}

TEST(HjifFile, ReadsWhatMpegsEncoderCallsOther) {
    const auto perceptions = [](const std::string& modality, const std::string& band) {
        return R"({"perceptions": [{"perception_modality": ")" + modality + R"(", "channels": [{"bands": [)" +
               band + "]}]}]}";
    };
    const std::string effects =
        R"("effects": [{"effect_type": "Basis", "position": 10, "keyframes": [{"relative_position": 0, "amplitude_modulation": 1, "frequency_modulation": 90}, {"relative_position": 5, "amplitude_modulation": 1}]}]})";
    EXPECT_EQ(
        read(perceptions("Other", R"({"band_type": "Transient", )" + effects)).channels[0].transients.size(),
        2u);
    EXPECT_EQ(
        read(perceptions("Other", R"({"band_type": "VectorialWave", )" + effects)).channels[0].bands.size(),
        1u);
    const std::string none = "f: perceptions: expected a vibrotactile perception with channels, found none";
    EXPECT_EQ(refusal(perceptions("Other", R"({"band_type": "Curve", )" + effects)),
              none); // a force, a position
    EXPECT_EQ(refusal(perceptions("Other", R"({"band_type": "VectorialWave", )" + effects +
                                               R"(, {"band_type": "WaveletWave"})")),
              none);
    EXPECT_EQ(refusal(perceptions("Force", R"({"band_type": "VectorialWave", )" + effects)), none);
    std::string both = perceptions("Vibrotactile", R"({"band_type": "VectorialWave", )" + effects);
    both.insert(both.size() - 2, R"(, {"perception_modality": "Force", "channels": []})");
    EXPECT_EQ(read(both).leftOut, "left out: a perception of Force (1)");
}

TEST(HjifFile, LetsAnEffectEndWhereTheNextOfItsBandBegins) {
    const std::string effect =
        R"("effect_type": "Basis", "keyframes": [{"relative_position": 0, "amplitude_modulation": 1, "frequency_modulation": 100}, {"relative_position": 100, "amplitude_modulation": 0}]})";
    const Clip clip = read(file(vectorial("{\"position\": 50, " + effect + ", {\"position\": 0, " + effect)));
    const auto& waves = clip.channels[0].bands[0].waves;
    ASSERT_EQ(waves.size(), 2u);
    EXPECT_EQ(waves[0].amplitude, (std::vector<ClipPoint>{{0.0, 0.5}, {0.05, 0.25}}));
}

TEST(HjifFile, RefusesInOneLine) {
    EXPECT_EQ(refusal("{}"), "f: field \"perceptions\" is missing");
    EXPECT_EQ(refusal(R"({"timescale": 0, "perceptions": []})"),
              "f: timescale: expected at least one tick per second, found 0");
    EXPECT_EQ(refusal(R"({"perceptions": [{"perception_modality": "Temperature"}]})"),
              "f: perceptions: expected a vibrotactile perception with channels, found none");
    EXPECT_EQ(refusal(file(R"({"band_type": "WaveletWave", "effects": []})")),
              "f: perceptions[0].channels[0].bands[0].band_type: expected waves, transients or curves, found "
              "wavelets, which are not read");
    EXPECT_EQ(refusal(file(vectorial(R"({"effect_type": "Composite"})"))),
              "f: perceptions[0].channels[0].bands[0].effects[0].effect_type: expected one of Basis, "
              "Reference, found \"Composite\"");
    EXPECT_EQ(refusal(file(vectorial(R"({"effect_type": "Reference", "id": 1})"))),
              "f: perceptions[0].channels[0].bands[0].effects[0].id: expected an effect of the library, "
              "found none of that number");
    EXPECT_EQ(
        refusal(file(vectorial(
            R"({"effect_type": "Basis", "keyframes": [{"relative_position": 9}, {"relative_position": 8}]})"))),
        "f: perceptions[0].channels[0].bands[0].effects[0].keyframes[1].relative_position: expected "
        "keyframes in time order");
    EXPECT_EQ(refusal(file("")), "f: perceptions: expected something to feel, found silence");
    EXPECT_EQ(refusal(file(vectorial(R"({"effect_type": "Basis", "position": 1e9, "keyframes": []})"))),
              "f: perceptions[0].channels[0].bands[0].effects[0].position: expected a number from 0 to "
              "6e+05, found 1000000000.0");
}

TEST(HjifFile, RefusesAMillionKeyframes) {
    std::string frames;
    for (std::size_t i = 0; i <= limits::maxClipPoints; ++i) frames += "{},";
    frames.pop_back();
    EXPECT_EQ(refusal(file(vectorial(R"({"effect_type": "Basis", "keyframes": [)" + frames + "]}"))),
              "f: perceptions[0].channels[0].bands[0].effects[0].keyframes: expected at most 500000 "
              "keyframes in the file, found more");
    EXPECT_NE(refusal(std::string(limits::maxClipFileBytes + 1, ' ')).find("expected at most 24000000 bytes"),
              std::string::npos);
}

} // namespace
} // namespace physvib
