// SPDX-License-Identifier: MIT
// Meta's and Apple's files: rules are kept, what both carry comes back, breaches are refused in one line.
#include "ClipTesting.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace physvib::phone_files_test {

using namespace test;
using nlohmann::json;

/// The rules of Meta's files, as they state them.
std::string metaFault(const std::string& text) {
    const json file = json::parse(text);
    if (file["version"]["major"] != 1) return "version";
    const json& envelopes = file["signals"]["continuous"]["envelopes"];
    const auto isShare = [](const json& value) { return value.is_number() && value >= 0.0 && value <= 1.0; };
    double last = 0.0;
    for (const json& p : envelopes["amplitude"]) {
        if (!isShare(p["amplitude"]) || p["time"] < last) return "amplitude " + p.dump();
        last = p["time"];
        if (p.contains("emphasis") &&
            (!isShare(p["emphasis"]["amplitude"]) || !isShare(p["emphasis"]["frequency"]) ||
             p["emphasis"]["amplitude"] < p["amplitude"]))
            return "emphasis " + p.dump();
    }
    if (envelopes["amplitude"].size() < 2 || !(last > envelopes["amplitude"][0]["time"])) return "too short";
    const double first = envelopes["amplitude"][0]["time"];
    double lastFrequency = first;
    for (const json& p : envelopes.value("frequency", json::array())) {
        if (!isShare(p["frequency"]) || p["time"] < lastFrequency || p["time"] > last)
            return "frequency " + p.dump();
        lastFrequency = p["time"];
    }
    return {};
}

/// Those of Apple's.
std::string appleFault(const std::string& text) {
    const json file = json::parse(text);
    if (file["Version"] != 1 || !file["Pattern"].is_array()) return "head";
    double eventEnd = 0.0;
    for (const json& entry : file["Pattern"]) {
        if (entry.contains("Event")) {
            const json& event = entry["Event"];
            for (const json& p : event["EventParameters"])
                if (p["ParameterValue"] < 0.0 || p["ParameterValue"] > 1.0) return "parameter " + p.dump();
            if (event["EventType"] == "HapticTransient") continue;
            if (event["EventType"] != "HapticContinuous" || event["EventDuration"] <= 0.0 ||
                event["EventDuration"] > 30.0)
                return "event " + event.dump();
            if (event["Time"] < eventEnd - 2e-6) return "events at once";
            eventEnd = event["Time"].get<double>() + event["EventDuration"].get<double>();
        } else {
            const json& curve = entry["ParameterCurve"];
            const bool isSharpness = curve["ParameterID"] == "HapticSharpnessControl";
            if (!isSharpness && curve["ParameterID"] != "HapticIntensityControl") return "curve";
            double last = 0.0;
            for (const json& p : curve["ParameterCurveControlPoints"]) {
                if (p["Time"] < last || p["ParameterValue"] > 1.0 ||
                    p["ParameterValue"] < (isSharpness ? -1.0 : 0.0))
                    return "point " + p.dump();
                last = p["Time"];
            }
            if (curve["Time"].get<double>() + last > eventEnd + 2e-6) return "beyond its event";
        }
    }
    return {};
}

/// On one actuator.
ClipChannel channelOf(std::span<const CollisionEvent> events) {
    ActuatorLayout one;
    layoutPreset("phone1", one);
    return clipOf(events, 0.004, {one, PanningLaw::linear, 1.0, 1.0, 1.0}).channels[0];
}

ClipChannel struck(double level = 1.0) {
    auto events = hits(40);
    for (CollisionEvent& e : events) e.amplitude *= level;
    return channelOf(events);
}

constexpr FrequencyScale wide{20.0, 500.0};

std::vector<ClipPoint> amplitudes(const ClipChannel& channel) {
    std::vector<ClipPoint> curve;
    for (const auto& p : makeEnvelope(channel)) curve.push_back({p.seconds, p.amplitude});
    return curve;
}

/// Of the envelopes, where that of `a` does not step within a millisecond.
double farthestApart(const ClipChannel& a, const ClipChannel& b) {
    const auto curveA = amplitudes(a), curveB = amplitudes(b);
    double most = 0.0;
    for (double t = 0.001; t < 2.2; t += 0.0003) {
        const bool isStep = std::abs(valueAt(curveA, t - 0.0006) - valueAt(curveA, t + 0.0006)) > 0.01;
        if (!isStep) most = std::max(most, std::abs(valueAt(curveA, t) - valueAt(curveB, t)));
    }
    return most;
}

TEST(PhoneFiles, KeepTheirRules) {
    for (const double level : {1.0, 30.0}) { // also of what is above full scale
        EXPECT_EQ(metaFault(metaHapticText(struck(level), "hits", wide)), "");
        EXPECT_EQ(appleFault(ahapText(struck(level), "hits", wide)), "");
    }
    ClipChannel transients{"A", {}, {}, {}, {{0.0, 1.0, 100.0}, {0.5, 0.3, 5000.0}}};
    EXPECT_EQ(metaFault(metaHapticText(transients, "")), "");
    EXPECT_EQ(appleFault(ahapText(transients, "")), "");
    ClipChannel hour{
        "A", {}, {}, {{{ClipWave{0.0, 0.0, {}, {{0.0, 0.5}, {100.0, 0.5}}, {{0.0, 150.0}}}}}}, {}};
    EXPECT_EQ(appleFault(ahapText(hour, "")), "");
    EXPECT_EQ(metaFault(metaHapticText({}, "")), "");
}

TEST(PhoneFiles, EnvelopesComeBack) {
    const ClipChannel channel = struck();
    const auto meta = readMetaHaptic(metaHapticText(channel, "hits", wide), "f", wide);
    ASSERT_EQ(meta.error, "");
    EXPECT_EQ(meta.value.title, "hits");
    const auto apple = readAhap(ahapText(channel, "hits", wide), "f", wide);
    ASSERT_EQ(apple.error, "");
    EXPECT_LE(farthestApart(channel, meta.value.channels[0]), 0.001);
    EXPECT_LE(farthestApart(channel, apple.value.channels[0]), 0.01);
}

TEST(PhoneFiles, FrequenciesComeBackByTheScale) {
    const CollisionEvent hit{0, 349.0, 30.0, 0.5, 0.5, 0.5};
    const ClipChannel channel = channelOf({&hit, 1});
    for (const ClipFormat format : {ClipFormat::haptic, ClipFormat::ahap}) {
        const auto again = readClip(clipBytes({"", 0, 0, {channel}}, format, wide), "f", format, wide);
        ASSERT_EQ(again.error, "");
        for (const EnvelopePoint& p : makeEnvelope(again.value.channels[0]))
            if (p.amplitude > 0.01) EXPECT_NEAR(p.frequencyHz, 349.0, 1.0);
    }
}

TEST(PhoneFiles, TransientsComeBack) {
    const ClipChannel channel{"", {}, {}, {}, {{0.25, 0.5, 100.0}, {0.5, 1.0, 300.0}}};
    for (const ClipFormat format : {ClipFormat::haptic, ClipFormat::ahap}) {
        const auto again = readClip(clipBytes({"", 0, 0, {channel}}, format), "f", format);
        ASSERT_EQ(again.error, "");
        ASSERT_EQ(again.value.channels[0].transients.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) {
            const ClipTransient &a = again.value.channels[0].transients[i], &b = channel.transients[i];
            EXPECT_NEAR(a.seconds, b.seconds, 1e-6);
            EXPECT_NEAR(a.amplitude, b.amplitude, 1e-5);
            EXPECT_NEAR(a.frequencyHz, b.frequencyHz, 1e-3);
        }
    }
}

TEST(PhoneFiles, ReadAppleAsAppleSays) {
    const auto clip = readAhap(R"({"Version": 1.0, "Pattern": [
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 0.5, "ParameterCurveControlPoints": [{"Time": 0, "ParameterValue": 2}, {"Time": 0.5, "ParameterValue": 0}]}},
        {"Parameter": {"ParameterID": "HapticSharpnessControl", "Time": 1, "ParameterValue": 0.5}},
        {"Event": {"Time": 0.5, "EventType": "HapticContinuous", "EventDuration": 1, "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 0.5}, {"ParameterID": "HapticSharpness", "ParameterValue": 0}]}},
        {"Event": {"Time": 0, "EventType": "HapticTransient"}}, {"Event": {"EventType": "AudioCustom", "Time": 3}}, {"Other": 1}]})",
                               "f", {100.0, 200.0});
    ASSERT_EQ(clip.error, "");
    const ClipChannel& channel = clip.value.channels[0];
    // assumed intensity and sharpness
    EXPECT_EQ(channel.transients, (std::vector<ClipTransient>{{0.0, 1.0, 150.0}}));
    const ClipWave& wave = channel.bands[0].waves[0];
    EXPECT_EQ(wave.startSeconds, 0.5);
    EXPECT_NEAR(valueAt(wave.amplitude, 0.0), 0.25, 1e-12); // (0.5 x 1)^2: beyond 1 is 1
    EXPECT_NEAR(valueAt(wave.amplitude, 0.25), 0.0625, 0.0026);
    EXPECT_NEAR(valueAt(wave.amplitude, 0.75), 0.0, 1e-12);
    EXPECT_NEAR(valueAt(wave.frequencyHz, 0.4999), 100.0, 1e-9);
    EXPECT_NEAR(valueAt(wave.frequencyHz, 0.5), 150.0, 1e-9);
}

TEST(PhoneFiles, ReadApplesDefaultsAndLastCommas) {
    const auto clip = readAhap(R"({"Pattern": [
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 40, "ParameterCurveControlPoints": [{"ParameterValue": 0.5,}, {"Time": 1}]}},
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl"}}, {"Parameter": {"ParameterID": "HapticSharpnessControl", "Time": 40}},
        {"Event": {"EventType": "HapticContinuous", "EventParameters": [{"ParameterID": "HapticIntensity"}, {"ParameterID": "HapticSharpness"}],},},
        {"Event": {"Time": 40, "EventType": "HapticTransient",}},
    ],})",
                               "f", {100.0, 200.0});
    ASSERT_EQ(clip.error, "");
    EXPECT_EQ(clip.value.omissions, "");
    const ClipChannel& channel = clip.value.channels[0];
    EXPECT_EQ(channel.transients, (std::vector<ClipTransient>{{40.0, 0.25, 150.0}}));
    EXPECT_EQ(channel.bands[0].waves[0].amplitude,
              (std::vector<ClipPoint>{{0.0, 1.0}, {30.0, 1.0}})); // no end of its own: as a phone does
    EXPECT_EQ(
        readAhap(
            R"({"Version": "a,]", "Pattern": [{"Event": {"EventType": "HapticTransient"}, "a\",}": 1,}]})",
            "f")
            .value.omissions,
        R"(left out: a",} (1))");
}

TEST(PhoneFiles, TellWhatIsLeftOutInOneLine) {
    const auto clip = readAhap(R"({"Version": 1, "Authored": "by\u001b hand", "Pattern": [
        {"Event": {"EventType": "HapticContinuous", "EventDuration": 1, "Speed": 3, "EventParameters": [{"ParameterID": "AttackTime", "ParameterValue": 0.1}, {"ParameterID": "DecayTime", "ParameterValue": 0.1},
            {"ParameterID": "ReleaseTime", "ParameterValue": 0.1}, {"ParameterID": "Sustained", "ParameterValue": 1}]}},
        {"Event": {"EventType": "HapticTransient", "EventParameters": [{"ParameterID": "AttackTime", "ParameterValue": 0.1}, {"ParameterValue": 0.1}]}},
        {"ParameterCurve": {"ParameterID": "HapticDecayTimeControl", "ParameterCurveControlPoints": []}}, {"Event": {"EventType": "AudioCustom"}}]})",
                               "f");
    ASSERT_EQ(clip.error, "");
    EXPECT_EQ(
        clip.value.omissions,
        "left out: AttackTime (2), AudioCustom (1), Authored (1), DecayTime (1), HapticDecayTimeControl (1), "
        "ReleaseTime (1), Speed (1), Sustained (1), a parameter without ParameterID (1)");
    std::string many = R"({"Pattern": [{"Event": {"EventType": "HapticTransient"}})";
    for (int k = 0; k < 1000; ++k) many += R"(, {"unknown)" + std::to_string(k) + R"(": 1})";
    const std::string line = readAhap(many + "]}", "f").value.omissions;
    EXPECT_NE(line.find("others (988)"), std::string::npos);
    EXPECT_LT(line.size(), 300u);
}

std::vector<ClipPoint> frequenciesOf(const std::string& frequency) {
    const auto clip = readMetaHaptic(
        R"({"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": [{"time": 0.5, "amplitude": 0.1}, {"time": 2.5, "amplitude": 1}])" +
            frequency + "}}}}",
        "f", {100.0, 200.0});
    EXPECT_EQ(clip.error, "");
    return clip.value.channels[0].bands[0].waves[0].frequencyHz;
}

TEST(PhoneFiles, PlayTheMiddleOfTheBandWhereMetaSaysNoFrequency) {
    for (const char* none : {"", R"(, "frequency": null)", R"(, "frequency": [])"})
        EXPECT_EQ(frequenciesOf(none), (std::vector<ClipPoint>{{0.0, 150.0}})) << none;
    const auto late =
        frequenciesOf(R"(, "frequency": [{"time": 1.5, "frequency": 0}, {"time": 2, "frequency": 1}])");
    EXPECT_EQ(valueAt(late, 0.999), 150.0);
    EXPECT_EQ(valueAt(late, 1.0), 100.0);
    EXPECT_NEAR(valueAt(late, 1.25), 150.0, 1e-9);
    EXPECT_EQ(valueAt(late, 2.0), 200.0);
    EXPECT_EQ(frequenciesOf(R"(, "frequency": [{"time": 0, "frequency": 0}, {"time": 1, "frequency": 1}])"),
              (std::vector<ClipPoint>{{0.0, 150.0}, {0.5, 200.0}})); // begun before the envelope
}

TEST(PhoneFiles, PutATransientWhereTheEnvelopeIsNotStronger) {
    const ClipChannel channel{"",
                              {},
                              {},
                              {{{ClipWave{1.0, 0.0, {}, {{0.0, 0.9}, {1.0, 0.9}}, {{0.0, 100.0}}}}}},
                              {{1.0, 0.2, 200.0}, {1.5, 0.4, 200.0}}};
    const auto again = readMetaHaptic(metaHapticText(channel, ""), "f").value.channels[0].transients;
    ASSERT_EQ(again.size(), 2u);
    EXPECT_NEAR(again[0].amplitude, 0.2, 1e-6);
    EXPECT_NEAR(again[0].seconds, 0.9995, 1e-6);
    EXPECT_NEAR(again[1].amplitude, 0.9, 1e-6); // the format has none weaker
    EXPECT_EQ(clipLosses({"", 0, 0, {channel}}, ClipFormat::haptic).back(),
              "1 transients are weaker than what sounds beside them and become as strong as it");
    EXPECT_EQ(clipLosses({"", 0, 0, {channel}}, ClipFormat::ahap).size(), 1u);
}

TEST(PhoneFiles, LastEvenIfTheWaveDoesNot) {
    ClipChannel channel; // silent, and shorter than the microsecond that a file tells apart
    channel.bands.push_back({{{2e-7, 0.0, ClipWaveform::sine, {{0.0, 0.0}, {2e-7, 0.0}}, {{0.0, 100.0}}}}});
    const std::string text = metaHapticText(channel, "short");
    EXPECT_EQ(metaFault(text), "");
    const auto read = readMetaHaptic(text, "short");
    EXPECT_TRUE(read) << read.error;
}

TEST(PhoneFiles, RefuseInOneLine) {
    const auto meta = [](const std::string& amplitude) {
        return readMetaHaptic(
                   R"({"version": {"major": 1, "minor": 0, "patch": 0}, "signals": {"continuous": {"envelopes": {"amplitude": [)" +
                       amplitude + "]}}}}",
                   "f")
            .error;
    };
    const std::string at = "f: signals.continuous.envelopes.amplitude";
    EXPECT_EQ(meta(""), at + ": expected at least two points, found 0");
    EXPECT_EQ(meta(R"({"time": 0, "amplitude": 0}, {"time": 0, "amplitude": 1})"),
              at + ": expected an envelope that lasts");
    EXPECT_EQ(meta(R"({"time": 1, "amplitude": 0}, {"time": 0.5, "amplitude": 1})"),
              at + "[1].time: expected times in order");
    EXPECT_EQ(meta(R"({"time": 1, "amplitude": 2}, {"time": 1, "amplitude": 1})"),
              at + "[0].amplitude: expected a number from 0 to 1, found 2");
    EXPECT_EQ(
        meta(
            R"({"time": 0, "amplitude": 1, "emphasis": {"amplitude": 0.5, "frequency": 0}}, {"time": 1, "amplitude": 1})"),
        at + "[0].emphasis.amplitude: expected at least the envelope's amplitude");
    EXPECT_EQ(readMetaHaptic(R"({"version": {"major": 2}})", "f").error,
              "f: version.major: expected version 1");
    EXPECT_EQ(readAhap("{}", "f").error, "f: field \"Pattern\" is missing");
    EXPECT_EQ(readAhap(R"({"Pattern": []})", "f").error,
              "f: Pattern: expected something to feel, found silence");
    EXPECT_EQ(readAhap(R"({"Pattern": [{"Event": {"EventType": "Smell"}}]})", "f").error,
              "f: Pattern[0].Event.EventType: expected one of HapticTransient, HapticContinuous, "
              "AudioContinuous, AudioCustom, found \"Smell\"");
    EXPECT_EQ(readAhap(R"({"Pattern": [{"Event": {"Time": 0}}]})", "f").error,
              "f: Pattern[0].Event: field \"EventType\" is missing");
    EXPECT_EQ(readAhap(R"({"Pattern": [,]})", "f").error.substr(0, 20), "f: line 1, column 14");
}

TEST(PhoneFiles, AreBoundedWhereManyEventsShareLongCurves) {
    std::string text =
        R"({"Pattern": [{"ParameterCurve": {"ParameterID": "HapticIntensityControl", "ParameterCurveControlPoints": [)";
    for (int i = 0; i < 20000; ++i)
        text += (i ? "," : "") + std::string(R"({"Time": )") + std::to_string(i * 1e-3) +
                R"(, "ParameterValue": )" + (i % 2 ? "1" : "0") + "}";
    text += "]}}";
    for (int i = 0; i < 200; ++i)
        text += R"(, {"Event": {"EventType": "HapticContinuous", "Time": 0, "EventDuration": 20}})";
    EXPECT_EQ(readAhap(text + "]}", "f").error,
              "f: Pattern: expected fewer events at once on such long curves");
}

TEST(PhoneFiles, KeepTheirOrderWithinTheFirstRise) {
    const ClipChannel channel{"A",
                              {},
                              {},
                              {{{ClipWave{0.0,
                                          0.0,
                                          {},
                                          {{0.0, 1.0}, {1e-4, 0.5}, {0.1, 0.0}},
                                          {{0.0, 100.0}, {1e-4, 250.0}, {0.1, 90.0}}}}}},
                              {}};
    for (const ClipFormat format : {ClipFormat::haptic, ClipFormat::ahap})
        EXPECT_EQ(readClip(clipBytes({"", 0, 0, {channel}}, format), "f", format).error, "");
}

TEST(PhoneFiles, RefuseAMillionPoints) {
    const auto many = [](const std::string& head, const std::string& point, const std::string& tail) {
        std::string text = head;
        for (std::size_t i = 0; i <= limits::maxClipPoints; ++i) text.append(i ? "," : "").append(point);
        return text + tail;
    };
    EXPECT_EQ(
        readMetaHaptic(
            many(
                R"({"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": [{"time": 0, "amplitude": 0},)",
                R"({"time":1,"amplitude":1})", "]}}}}"),
            "f")
            .error,
        "f: signals.continuous.envelopes: expected at most 500000 points of curves, found more");
    EXPECT_EQ(
        readAhap(
            many(
                R"({"Pattern": [{"ParameterCurve": {"ParameterID": "HapticIntensityControl", "ParameterCurveControlPoints": [)",
                R"({"Time":0,"ParameterValue":0})", "]}}]}"),
            "f")
            .error,
        "f: Pattern[0].ParameterCurve.ParameterCurveControlPoints: expected at most 500000 control points in "
        "the file, found more");
}

TEST(ClipFile, RefusesAGigabyteUnread) {
    const std::filesystem::path folder = testing::TempDir();
    for (std::size_t i = 0; i < clipEndings.size(); ++i) {
        const std::filesystem::path path = folder / ("gigabyte" + std::string(clipEndings[i]));
        std::ofstream{path};
        std::filesystem::resize_file(path, 1'000'000'000); // a hole: no disk is written
        const auto clip = loadClip(path, static_cast<ClipFormat>(i));
        std::filesystem::remove(path);
        EXPECT_FALSE(clip);
        EXPECT_NE(clip.error.find("expected at most 24000000 bytes"), std::string::npos) << clip.error;
    }
}

TEST(ClipFile, IsKnownByItsEnding) {
    EXPECT_EQ(findClipFormat("a.hjif"), ClipFormat::hjif);
    EXPECT_EQ(findClipFormat("dir/A.HAPTIC"), ClipFormat::haptic);
    EXPECT_EQ(findClipFormat("b.ahap"), ClipFormat::ahap);
    EXPECT_EQ(findClipFormat("b.Hjif"), ClipFormat::hjif);
    EXPECT_EQ(findClipFormat("a.ENVELOPE"), ClipFormat::envelope);
    for (const char* const none : {"hjif", ".hjif", "a.json"}) EXPECT_FALSE(findClipFormat(none)) << none;
}

TEST(ClipFile, TellsWhatIsLost) {
    Clip clip{"",
              0.2,
              0.1,
              {ClipChannel{"A",
                           ActuatorPlace{0.0333, 0.05},
                           {},
                           {{{ClipWave{0, 0, {}, {{0, 2.0}, {1, 2.0}}, {{0, 80.5}}}}},
                            {{ClipWave{0, 0, {}, {{0, 1}, {1, 1}}, {{0, 349}}}}}},
                           {}}}};
    EXPECT_EQ(clipLosses(clip, ClipFormat::hjif),
              (std::vector<std::string>{
                  "places are moved by up to 0.70 mm, onto a grid of at most 127 points",
                  "MPEG's own decoder cuts frequencies to whole Hz, as of 80.50 Hz; ours does not"}));
    EXPECT_EQ(clipLosses(clip, ClipFormat::ahap),
              (std::vector<std::string>{
                  "where a hit was is not carried",
                  "modes that sound at once become one envelope, at the mean of their frequencies",
                  "1 of 2 frequencies lie outside 65 to 300 Hz and become its ends",
                  "what is above full scale is cut to it: the strongest is 2.00"}));
}

} // namespace physvib::phone_files_test
