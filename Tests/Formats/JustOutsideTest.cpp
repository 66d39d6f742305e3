// SPDX-License-Identifier: MIT
// Every number of a haptic file that has a limit, on both sides of it: inside it counts, and just outside it
// is refused where it stands, or taken as the limit where a phone does so.
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace physvib {
namespace {

using nlohmann::json;

struct Number {
    std::string at; ///< pointer into the file
    std::vector<double> taken, refused;
};

constexpr double longest = limits::maxClipSeconds;

template <class Read>
void expectLimits(const json& file, const std::vector<Number>& numbers, Read read) {
    ASSERT_EQ(read(file).error, "");
    for (const Number& number : numbers) {
        const json::json_pointer at{number.at};
        json changed = file;
        for (const double value : number.taken) {
            changed[at] = value;
            EXPECT_EQ(read(changed).error, "") << number.at << ' ' << value;
        }
        for (const double value : number.refused) {
            changed[at] = value;
            const std::string error = read(changed).error;
            EXPECT_NE(error, "") << number.at << " taken: " << value;
            EXPECT_EQ(error.find('\n'), std::string::npos);
            const std::string name = number.at.substr(number.at.rfind('/') + 1);
            EXPECT_NE(error.find(name), std::string::npos) << error;
        }
    }
}

TEST(JustOutside, IsRefusedInMetasFiles) {
    const json file = json::parse(R"({"version": {"major": 1, "minor": 0, "patch": 0},
        "signals": {"continuous": {"envelopes": {
            "amplitude": [{"time": 0.0, "amplitude": 0.5, "emphasis": {"amplitude": 0.75, "frequency": 0.5}},
                          {"time": 0.5, "amplitude": 0.5}, {"time": 1.0, "amplitude": 0.25}],
            "frequency": [{"time": 0.0, "frequency": 0.5}, {"time": 0.5, "frequency": 0.25}]}}}})");
    const std::string at = "/signals/continuous/envelopes/";
    expectLimits(file,
                 {{at + "amplitude/1/amplitude", {0.0, 1.0}, {-1e-9, 1.0 + 1e-9, 1e300}},
                  {at + "amplitude/0/emphasis/amplitude", {0.5, 1.0}, {0.5 - 1e-9, 1.0 + 1e-9, -1.0}},
                  {at + "amplitude/0/emphasis/frequency", {0.0, 1.0}, {-1e-9, 1.0 + 1e-9}},
                  {at + "amplitude/1/time", {0.0, 1.0}, {-1e-9, 1.0 + 1e-9}},
                  {at + "amplitude/2/time", {0.5, longest}, {0.5 - 1e-9, longest + 1e-6}},
                  {at + "frequency/0/frequency", {0.0, 1.0}, {-1e-9, 1.0 + 1e-9}},
                  {at + "frequency/1/time", {0.0, 600.0}, {-1e-9, longest + 1e-6}},
                  {"/version/major", {1}, {0, 2}}},
                 [](const json& changed) { return readMetaHaptic(changed.dump(), "f"); });
}

TEST(JustOutside, IsRefusedInMpegsFiles) {
    const json file =
        json::parse(R"({"timescale": 1000, "perceptions": [{"perception_modality": "Vibrotactile",
        "channels": [{"id": 0, "gain": 0.5, "bands": [
            {"band_type": "VectorialWave", "effects": [{"effect_type": "Basis", "position": 0, "phase": 0.5,
                "base_signal": "Sine", "keyframes": [
                    {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100},
                    {"relative_position": 100, "amplitude_modulation": 0.5, "frequency_modulation": 100}]}]}]}]}]})");
    const std::string channel = "/perceptions/0/channels/0/", effect = channel + "bands/0/effects/0/",
                      frame = effect + "keyframes/1/";
    constexpr double twoPi = 2.0 * std::numbers::pi;
    expectLimits(
        file,
        {{"/timescale", {1, 1000}, {0, -1}},
         {channel + "gain", {1e-3, limits::maxClipAmplitude}, {-1e-9, limits::maxClipAmplitude + 1e-6}},
         {effect + "position", {0, 1000.0 * longest - 100.0}, {-1e-9, 1000.0 * longest + 0.1}},
         {effect + "phase", {0.0, twoPi}, {-1e-9, twoPi + 1e-9}},
         {frame + "amplitude_modulation", {-1.0, 0.0, 1.0}, {-1.0 - 1e-9, 1.0 + 1e-9}},
         {frame + "frequency_modulation",
          {0.0, limits::maxClipFrequencyHz},
          {-1e-9, limits::maxClipFrequencyHz + 1e-6}},
         {frame + "relative_position", {1, 1000.0 * longest}, {-1e-9, 1000.0 * longest + 0.1}}},
        [](const json& changed) { return readHjif(changed.dump(), "f"); });
}

json apple() {
    return json::parse(R"({"Version": 1, "Pattern": [
        {"Event": {"Time": 0.5, "EventType": "HapticTransient", "EventParameters": [
            {"ParameterID": "HapticIntensity", "ParameterValue": 0.5},
            {"ParameterID": "HapticSharpness", "ParameterValue": 0.5}]}},
        {"Event": {"Time": 1.0, "EventType": "HapticContinuous", "EventDuration": 1.0, "EventParameters": [
            {"ParameterID": "HapticIntensity", "ParameterValue": 0.5},
            {"ParameterID": "HapticSharpness", "ParameterValue": 0.5}]}},
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 0.0,
            "ParameterCurveControlPoints": [{"Time": 0.0, "ParameterValue": 0.5}, {"Time": 1.5, "ParameterValue": 0.5}]}},
        {"Parameter": {"ParameterID": "HapticSharpnessControl", "Time": 0.25, "ParameterValue": 0.0}}]})");
}

Clip readApple(const json& file) {
    auto clip = readAhap(file.dump(), "f");
    EXPECT_EQ(clip.error, "");
    return std::move(clip.value);
}

/// As Apple says: what is beyond a parameter's range is its limit.
TEST(JustOutside, IsTheLimitInApplesFiles) {
    struct Share {
        std::string at;
        double least, most;
    };
    const std::vector<Share> shares{
        {"/Pattern/0/Event/EventParameters/0/ParameterValue", 0.0, 1.0},
        {"/Pattern/0/Event/EventParameters/1/ParameterValue", 0.0, 1.0},
        {"/Pattern/1/Event/EventParameters/0/ParameterValue", 0.0, 1.0},
        {"/Pattern/1/Event/EventParameters/1/ParameterValue", 0.0, 1.0},
        {"/Pattern/2/ParameterCurve/ParameterCurveControlPoints/1/ParameterValue", 0.0, 1.0},
        {"/Pattern/3/Parameter/ParameterValue", -1.0, 1.0}};
    for (const Share& share : shares) {
        const auto with = [&](double value) {
            json file = apple();
            file[json::json_pointer{share.at}] = value;
            return readApple(file);
        };
        const Clip least = with(share.least), most = with(share.most);
        if (share.least == 0.0) { // the other is added to a sharpness, and the sum has the same limits
            EXPECT_FALSE(least == with(share.least + 0.01)) << share.at;
            EXPECT_FALSE(most == with(share.most - 0.01)) << share.at;
        }
        for (const double by : {1e-6, 0.5, 100.0, 1e300}) {
            EXPECT_TRUE(least == with(share.least - by)) << share.at << " below by " << by;
            EXPECT_TRUE(most == with(share.most + by)) << share.at << " above by " << by;
        }
    }
}

TEST(JustOutside, IsRefusedInApplesTimes) {
    expectLimits(apple(),
                 {{"/Pattern/0/Event/Time", {0.0, longest - 1.0}, {-1e-6, longest + 1e-6}},
                  {"/Pattern/1/Event/Time", {0.0, longest - 1.0}, {-1e-6, longest + 1e-6}},
                  {"/Pattern/1/Event/EventDuration", {0.0, 30.0}, {-1e-6, longest + 1e-6}},
                  {"/Pattern/2/ParameterCurve/Time", {0.0}, {-1e-6, longest + 1e-6}},
                  {"/Pattern/2/ParameterCurve/ParameterCurveControlPoints/1/Time", {0.0, 2.0}, {-1e-6}},
                  {"/Pattern/3/Parameter/Time", {0.0, longest}, {-1e-6, longest + 1e-6}}},
                 [](const json& changed) { return readAhap(changed.dump(), "f"); });
}

/// What lasts no time is not felt at all: it is no transient.
TEST(JustOutside, AnEventWithoutLengthIsNone) {
    for (const double seconds : {0.0, 1e-12, 1e-3}) {
        json with = apple(), without = apple();
        with["Pattern"][1]["Event"]["EventDuration"] = seconds;
        without["Pattern"].erase(1);
        EXPECT_EQ(readApple(with) == readApple(without), seconds < 1e-9) << seconds;
        EXPECT_EQ(readApple(with).channels[0].transients.size(), 1U);
    }
}

} // namespace
} // namespace physvib
