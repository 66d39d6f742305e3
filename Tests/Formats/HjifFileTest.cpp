// SPDX-License-Identifier: MIT
// MPEG's JSON: what was written is read again and sounds the same; what others write is read or refused.
#include "ClipTesting.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace physvib::hjif_file_test {

using namespace test;

Clip scene() {
    Clip clip = clipOf(hits(40), 0.001);
    clip.title = "hits";
    clip.extentWidthMetres = 0.12;
    clip.extentHeightMetres = 0.06;
    for (std::size_t j = 0; j < 4; ++j) {
        clip.channels[j].label = std::string(1, static_cast<char>('A' + j));
        clip.channels[j].place = ActuatorPlace{j % 2 == 0 ? 0.0 : 0.12, j < 2 ? 0.06 : 0.0};
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

// Times are ticks of the file's timescale, amplitudes shares of the channel's gain; an actuator's largest
// amplitude is an acceleration in m/s^2: 9.80665 for each g. The grid has no unit there, and 1 mm here.
TEST(HjifFile, WritesEachNumberInTheUnitOfTheFormat) {
    ClipChannel channel{"A", ActuatorPlace{0.003, 0.004}, {50.0, 400.0, 205.0, 2.5}};
    channel.bands = {{{{0.25, 1.5, ClipWaveform::sine, {{0.0, 4.0}, {0.5, 1.0}}, {{0.0, 120.0}}}}}};
    channel.transients = {{2.0, 0.5, 90.0}};
    const ClipChannel unknown{"B", {}, {}, {}, channel.transients};
    auto file = nlohmann::json::parse(hjifText({"units", 0.01, 0.02, {channel, unknown}}));
    const double ticks = file["timescale"];
    const std::string device = "reference_devices/0/", wave = "channels/0/bands/0/effects/0/",
                      transient = "channels/0/bands/1/effects/0/";
    for (const auto& [at, value] : {std::pair{device + "minimum_frequency", 50.0},
                                    {device + "maximum_frequency", 400.0},
                                    {device + "resonance_frequency", 205.0},
                                    {device + "maximum_amplitude", 24.516625},
                                    {"channels/0/gain", 4.0},
                                    {"channels/0/actuator_resolution/X", 11.0},
                                    {"channels/0/actuator_resolution/Y", 21.0},
                                    {"channels/0/actuator_target/0/X", 3.0},
                                    {"channels/0/actuator_target/0/Y", 4.0},
                                    {wave + "position", 0.25 * ticks},
                                    {wave + "phase", 1.5},
                                    {wave + "keyframes/0/amplitude_modulation", 1.0},
                                    {wave + "keyframes/0/frequency_modulation", 120.0},
                                    {wave + "keyframes/1/relative_position", 0.5 * ticks},
                                    {wave + "keyframes/1/amplitude_modulation", 0.25},
                                    {transient + "position", 2.0 * ticks},
                                    {transient + "keyframes/0/amplitude_modulation", 0.125},
                                    {transient + "keyframes/0/frequency_modulation", 90.0}})
        EXPECT_NEAR(file["perceptions"][0].at(nlohmann::json::json_pointer{"/" + at}).get<double>(), value,
                    1e-6)
            << at;
    EXPECT_EQ(file["perceptions"][0]["reference_devices"][1].size(), 2u)
        << "number and name: no more is known";
    file["perceptions"][0]["channels"][1].erase("gain");
    EXPECT_EQ(read(file.dump()).channels[1].transients, channel.transients) << "not by the other's gain";
}

TEST(HjifFile, ReadsWhatMpegsEncoderCallsOther) {
    const auto perceptions = [](const std::string& modality, const std::string& band) {
        return R"({"perceptions": [{"perception_modality": ")" + modality + R"(", "channels": [{"bands": [)" +
               band + "]}]}]}";
    };
    const std::string effects =
        R"("effects": [{"effect_type": "Basis", "position": 10, "keyframes": [{"relative_position": 0, "amplitude_modulation": 1, "frequency_modulation": 90}, {"relative_position": 5, "amplitude_modulation": 1}]}]})";
    const std::string transients = R"({"band_type": "Transient", )" + effects,
                      waves = R"({"band_type": "VectorialWave", )" + effects,
                      curve = R"({"band_type": "Curve", )" + effects; // a force, a position
    EXPECT_EQ(read(perceptions("Other", transients)).channels[0].transients.size(), 2u);
    EXPECT_EQ(read(perceptions("Other", waves)).channels[0].bands.size(), 1u);
    for (const auto& none : {perceptions("Other", curve), perceptions("Force", waves),
                             perceptions("Other", waves + R"(, {"band_type": "WaveletWave"})")})
        EXPECT_EQ(refusal(none),
                  "f: perceptions: expected a vibrotactile perception with channels, found none");
    std::string both = perceptions("Vibrotactile", waves);
    both.insert(both.size() - 2, R"(, {"perception_modality": "Force", "channels": []})");
    EXPECT_EQ(read(both).omissions, "left out: a perception of Force (1)");
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
    EXPECT_EQ(refusal(file("")), "f: perceptions: expected something to feel, found silence");
    const std::string band = "f: perceptions[0].channels[0].bands[0].";
    EXPECT_EQ(refusal(file(R"({"band_type": "WaveletWave", "effects": []})")),
              band + "band_type: expected waves, transients or curves, found wavelets, which are not read");
    for (const auto& [effect, error] :
         {std::pair{R"({"effect_type": "Composite"})",
                    "effect_type: expected one of Basis, Reference, found \"Composite\""},
          {R"({"effect_type": "Reference", "id": 1})",
           "id: expected an effect of the library, found none of that number"},
          {R"({"effect_type": "Basis", "keyframes": [{"relative_position": 9}, {"relative_position": 8}]})",
           "keyframes[1].relative_position: expected keyframes in time order"},
          {R"({"effect_type": "Basis", "position": 1e9, "keyframes": []})",
           "position: expected a number from 0 to 6e+05, found 1000000000.0"}})
        EXPECT_EQ(refusal(file(vectorial(effect))), band + "effects[0]." + error);
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

// Android's control points: what a phone makes of them, by its documented formula, against the envelope.

using nlohmann::json;

/// A hit as export draws it: lines through its exponential, each 1 % apart at most.
ClipWave hit(double start, double hertz, double amplitude, double decay) {
    ClipWave wave{start, 0.0, ClipWaveform::sine, {}, {{0.0, hertz}}};
    for (double t = 0.0; amplitude * std::exp(-decay * t) > 1e-4; t += 0.28 / decay)
        wave.amplitude.push_back({t, amplitude * std::exp(-decay * t)});
    wave.amplitude.push_back({wave.amplitude.back().seconds + 0.28 / decay, 0.0});
    return wave;
}

/// Forty hits in 12 s, which overlap, and transients.
ClipChannel manyHits() {
    std::mt19937 random{7};
    const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
    ClipChannel channel;
    for (int i = 0; i < 40; ++i) { // one after the other: compilers differ in the order of arguments
        const double start = 0.3 * i + 0.2 * share(), hertz = 70.0 + 200.0 * share();
        const double amplitude = 0.05 + 0.4 * share(), decay = 2.0 + 60.0 * share();
        channel.bands.push_back({{hit(start, hertz, amplitude, decay)}});
    }
    for (int i = 0; i < 5; ++i) channel.transients.push_back({1.0 + 2.0 * i, 0.1 + 0.1 * i, 150.0});
    return channel;
}

struct Moment {
    double amplitude, hertz;
    bool isRising; ///< within an effect's first millisecond, or between effects
};

/// Amplitude and frequency go along lines from point to point, from 0 and the initial frequency.
Moment rendered(const json& file, double ms) {
    for (const json& effect : file["effects"]) {
        double at = effect["start_ms"], amplitude = 0.0, hertz = effect["initial_hz"];
        const double start = at;
        if (ms < at) return {0.0, hertz, false};
        for (const json& point : effect["points"]) {
            const double next = at + point[2].get<double>();
            if (ms < next) {
                const double share = (ms - at) / (next - at);
                return {std::lerp(amplitude, point[0].get<double>(), share),
                        std::lerp(hertz, point[1].get<double>(), share), ms < start + 1.0};
            }
            at = next, amplitude = point[0], hertz = point[1];
        }
    }
    return {0.0, 0.0, false};
}

TEST(AndroidEnvelope, WhatAPhonePlaysIsTheEnvelopeWithinATenthOfADecibel) {
    ClipChannel channel = manyHits();
    const json file = json::parse(clipBytes({"forty hits", 0, 0, {channel}}, ClipFormat::envelope));
    for (const ClipTransient& transient : channel.transients) channel.bands.push_back({{transient.wave()}});
    const auto envelope = makeEnvelope(channel);
    double worst = 0.0, pitch = 0.0;
    int compared = 0;
    for (int ms = 0; ms < 12500; ++ms) {
        const EnvelopePoint is = envelopeAt(envelope, 1e-3 * ms);
        const Moment plays = rendered(file, ms);
        if (is.amplitude < 0.02 || is.amplitude > 1.0 || plays.isRising) continue;
        ++compared;
        worst = std::max(worst, std::abs(20.0 * std::log10(plays.amplitude / is.amplitude)));
        pitch = std::max(pitch, std::abs(plays.hertz - is.frequencyHz));
    }
    EXPECT_GT(compared, 3000);
    EXPECT_LT(worst, 0.1);
    EXPECT_LT(pitch, 1.2);
    RecordProperty("worst_db_thousandths", static_cast<int>(1000 * worst));
}

TEST(AndroidEnvelope, EveryPhoneTakesItsPointsAndASilenceHasNone) {
    const ClipChannel channel = manyHits();
    int last = 0;
    std::size_t points = 0;
    for (const AndroidEffect& effect : androidEffects(channel)) {
        EXPECT_GE(effect.startMs, last) << "one effect ends another";
        last = effect.startMs;
        EXPECT_GE(effect.points.size(), 1u);
        EXPECT_LE(effect.points.size(), 16u);
        for (const AndroidPoint& p : effect.points) {
            EXPECT_GE(p.durationMs, 1);
            EXPECT_LE(p.durationMs, 1000);
            EXPECT_GE(p.frequencyHz, 65.0);
            EXPECT_LE(p.frequencyHz, 300.0);
            EXPECT_LE(p.amplitude, 1.0);
            last += p.durationMs;
        }
        points += effect.points.size();
    }
    EXPECT_LT(points, 900u) << "far fewer than 12,000 ms";
    EXPECT_TRUE(androidEffects({}).empty());
    ClipChannel apart;
    apart.bands.push_back({{hit(0.5, 100.0, 0.5, 50.0), hit(3.0, 100.0, 0.5, 50.0)}});
    const auto two = androidEffects(apart);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(two[1].startMs, 3000, 1);
    EXPECT_EQ(two[0].points.back().amplitude, 0.0);
    ClipChannel held;
    held.bands.push_back({{{0.0, 0.0, ClipWaveform::sine, {{0.0, 0.5}, {5.0, 0.5}}, {{0.0, 20.0}}}}});
    EXPECT_EQ(androidEffects(held).front().points.size(), 7u) << "a second each, after the rise";
    EXPECT_EQ(androidEffects(held).front().initialHz, 65.0);
}

TEST(AndroidEnvelope, ItIsWrittenAndNotRead) {
    EXPECT_EQ(readClip("{}", "a.envelope", ClipFormat::envelope).error,
              "a.envelope: Android's envelopes are written, not read");
}

} // namespace physvib::hjif_file_test
