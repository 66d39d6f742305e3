// SPDX-License-Identifier: MIT
// Every number of a haptic file that has a limit, on both sides of it: inside it counts, and just outside it
// is refused where it stands, or taken as the limit where a phone does so.
#include "ClipTesting.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace physvib::just_outside_test {

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

/// Of so many bands; each has a wave of so many points.
ClipChannel channelOf(std::size_t bands, std::size_t points, double seconds) {
    ClipChannel channel;
    channel.bands.resize(bands);
    for (ClipBand& band : channel.bands) {
        ClipWave& wave = band.waves.emplace_back();
        wave.amplitude.assign(points, {seconds, 0.5});
        wave.frequencyHz = {{0.0, 100.0}};
    }
    return channel;
}

// Counted for each channel alone, a limit would let 64 times as much pass.
TEST(JustOutside, IsCountedOverAllChannelsOfAClip) {
    const ClipChannel least = channelOf(1, 1, 1e-3);
    const std::size_t longWaves = static_cast<std::size_t>(limits::maxClipSoundingSeconds / longest);
    const struct {
        std::size_t channels;
        ClipChannel each;
        const char* unit;
    } most[]{{limits::maxActuators, least, " channels"},
             {2, channelOf(1, limits::maxClipPoints / 2, 1e-3), " points of curves"},
             {2, channelOf(limits::maxClipBands / 2, 1, 1e-3), " bands"},
             {2, channelOf(longWaves / 2, 1, longest), " seconds of all waves together"}};
    for (const auto& full : most) {
        Clip clip;
        clip.channels.assign(full.channels, full.each);
        EXPECT_EQ(clipError(clip), "");
        clip.channels.push_back(least);
        EXPECT_NE(clipError(clip).find(full.unit), std::string::npos) << full.unit << ": " << clipError(clip);
    }
}

// Strikes as lines: how near, how few, and what is merged.

using namespace test;

constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();

double farthestFrom(const std::vector<ClipPoint>& curve, double amplitude, double decayPerSecond,
                    double seconds) {
    double most = 0.0;
    for (int n = 0; n < 20000; ++n) {
        const double t = seconds * n / 20000;
        most = std::max(most, std::abs(valueAt(curve, t) - amplitude * std::exp(-decayPerSecond * t)));
    }
    return most;
}

TEST(DecayCurve, ChordsKeepWithinTheirErrorAndEndAtNothing) {
    for (const double error : {0.05, 0.004, 0.001, 1e-4})
        for (const double decay : {0.5, 30.0, 800.0}) {
            const auto curve = decayCurve(0.7, decay, forever, error, rateHz);
            const double slack = 0.7 * decay / rateHz; // a point lies on a tick
            EXPECT_LE(farthestFrom(curve, 0.7, decay, 12.0 / decay),
                      0.7 * error + std::min(slack, 0.7 * 0.2 * error))
                << error << ' ' << decay;
            EXPECT_EQ(curve.back().value, 0.0);
        }
}

TEST(DecayCurve, TakesADozenPointsForTheUsualError) {
    EXPECT_LE(decayCurve(1.0, 30.0, forever, 0.004, rateHz).size(), 14u);
    EXPECT_LE(decayCurve(1.0, 30.0, forever, 0.001, rateHz).size(), 27u);
}

TEST(DecayCurve, LiesOnTheExponentialWhereItIsCutOff) {
    for (const std::int64_t end : {1, 100, 4800, 8000}) {
        const auto curve = decayCurve(1.0, 30.0, end, 0.004, rateHz);
        const double seconds = static_cast<double>(end) / rateHz;
        EXPECT_DOUBLE_EQ(curve.back().seconds, seconds);
        EXPECT_NEAR(curve.back().value, std::exp(-30.0 * seconds), 1e-12);
        EXPECT_LE(farthestFrom(curve, 1.0, 30.0, seconds), 0.0041);
    }
}

TEST(StrikeClip, SoundsAsTheClosedFormDoes) {
    const auto events = hits(60);
    double last = 1.0;
    for (const double error : {0.004, 0.001, 1e-5}) {
        const SampledSound sound = clipSound(clipOf(events, error), rateHz);
        const double found = farthest(sound.channels, closedForm(events, sound.channels.front().size()));
        EXPECT_LE(found, 0.44 * error + 1e-6) << error; // two modes of at most 0.22 ring at once
        EXPECT_LT(found, last);
        last = found;
    }
}

TEST(StrikeClip, HasOneWaveOfAModeAtATime) {
    const Clip clip = clipOf(hits(60), 0.004);
    ASSERT_EQ(clip.channels.size(), 4u);
    EXPECT_EQ(clipError(clip), "");
    for (const ClipChannel& channel : clip.channels) {
        EXPECT_LE(channel.bands.size(), 2u); // two modes
        for (const ClipBand& band : channel.bands)
            for (std::size_t i = 0; i + 1 < band.waves.size(); ++i)
                EXPECT_LE(band.waves[i].endSeconds(), band.waves[i + 1].startSeconds + 1e-9);
    }
}

TEST(StrikeClip, LeavesNothingBehindACut) {
    CollisionEvent cut{1'000'000, 200.0, 0.0, 0.5, 0.5, 0.5, 20'000'000};
    const Clip clip = clipOf({&cut, 1}, 0.004);
    const auto& bands = clip.channels[0].bands;
    ASSERT_TRUE(bands.size() == 1 && bands[0].waves.size() == 1);
    EXPECT_EQ(bands[0].waves[0].amplitude.size(), 2u);
    EXPECT_NEAR(clip.seconds(), 0.021, 1.0 / rateHz);
}

TEST(StrikeClip, LeavesOutWhatAnEnchanterDoesNotGet) {
    CollisionEvent corner{0, 200.0, 40.0, 0.5, 0.0, 1.0};
    const Clip clip = clipOf({&corner, 1}, 0.004);
    EXPECT_EQ(clip.channels[0].bands.size(), 1u);
    for (std::size_t j = 1; j < 4; ++j) EXPECT_TRUE(clip.channels[j].bands.empty());
}

/// What one wave plays.
std::vector<float> soundOf(const ClipWave& wave, int sampleRateHz) {
    Clip clip;
    clip.channels.emplace_back().bands.push_back({{wave}});
    return clipSound(clip, sampleRateHz).channels[0];
}

TEST(ClipSound, PlaysEveryWaveform) {
    constexpr double expected[5][4] = {{0.0, 1.0, 0.0, -1.0},
                                       {1.0, 1.0, -1.0, -1.0},
                                       {0.0, 1.0, 0.0, -1.0},
                                       {0.0, 0.5, -1.0, -0.5},
                                       {0.0, -0.5, 1.0, 0.5}};
    for (int w = 0; w < 5; ++w) {
        const auto sound = soundOf(
            {0.0, 0.0, static_cast<ClipWaveform>(w), {{0.0, 1.0}, {1.0, 1.0}}, {{0.0, 1000.0}}}, 4000);
        for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(sound[n], expected[w][n], 1e-6) << w << ' ' << n;
    }
}

TEST(ClipSound, LeavesOutWhatTheSampleRateCannotHold) {
    for (const double hertz : {1999.0, 2000.0, 2001.0, 3000.0, 1.0e5}) {
        const auto sound = soundOf({0.0, 0.7, {}, {{0.0, 1.0}, {1.0, 1.0}}, {{0.0, hertz}}}, 4000);
        EXPECT_EQ(std::ranges::any_of(sound, [](float x) { return x != 0.0f; }), hertz < 2000.0) << hertz;
    }
}

TEST(ClipSound, FollowsAFrequencyThatGlides) {
    const auto sound = soundOf({0.25, 0.5, {}, {{0.0, 1.0}, {1.0, 0.5}}, {{0.1, 100.0}, {0.6, 300.0}}}, 8000);
    const auto phase = [](double t) { // 100 Hz, a glide of 400 Hz per second, 300 Hz
        const double glide = std::clamp(t - 0.1, 0.0, 0.5);
        return 0.5 +
               2.0 * std::numbers::pi * (100.0 * t + 200.0 * glide * glide + 200.0 * std::max(0.0, t - 0.6));
    };
    for (std::size_t n = 2000; n < 10000; n += 37) {
        const double t = static_cast<double>(n) / 8000 - 0.25;
        EXPECT_NEAR(sound[n], (1.0 - 0.5 * t) * std::sin(phase(t)), 1e-6) << n;
    }
}

} // namespace physvib::just_outside_test
