// SPDX-License-Identifier: MIT
// Control points for Android: what a phone makes of the file, by the builder's documented formula, against
// the channel's envelope.
#include "Formats/EnvelopeFile.h"
#include "Formats/ClipFile.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace physvib {
namespace {

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
    const auto envelope = envelopeOf(channel);
    double worst = 0.0, pitch = 0.0;
    int compared = 0;
    for (int ms = 0; ms < 12500; ++ms) {
        const EnvelopePoint is = pointAt(envelope, 1e-3 * ms);
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
        EXPECT_GE(effect.startMilliseconds, last) << "one effect ends another";
        last = effect.startMilliseconds;
        EXPECT_GE(effect.points.size(), 1u);
        EXPECT_LE(effect.points.size(), 16u);
        for (const AndroidPoint& p : effect.points) {
            EXPECT_GE(p.milliseconds, 1);
            EXPECT_LE(p.milliseconds, 1000);
            EXPECT_GE(p.hertz, 65.0);
            EXPECT_LE(p.hertz, 300.0);
            EXPECT_LE(p.amplitude, 1.0);
            last += p.milliseconds;
        }
        points += effect.points.size();
    }
    EXPECT_LT(points, 900u) << "far fewer than 12,000 ms";
    EXPECT_TRUE(androidEffects({}).empty());
    ClipChannel apart;
    apart.bands.push_back({{hit(0.5, 100.0, 0.5, 50.0), hit(3.0, 100.0, 0.5, 50.0)}});
    const auto two = androidEffects(apart);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(two[1].startMilliseconds, 3000, 1);
    EXPECT_EQ(two[0].points.back().amplitude, 0.0);
    ClipChannel held;
    held.bands.push_back({{{0.0, 0.0, ClipWaveform::sine, {{0.0, 0.5}, {5.0, 0.5}}, {{0.0, 20.0}}}}});
    EXPECT_EQ(androidEffects(held).front().points.size(), 7u) << "a second each, after the rise";
    EXPECT_EQ(androidEffects(held).front().initialHertz, 65.0);
}

TEST(AndroidEnvelope, ItIsWrittenAndNotRead) {
    EXPECT_EQ(clipFormatOf("a.ENVELOPE"), ClipFormat::envelope);
    EXPECT_EQ(readClip("{}", "a.envelope", ClipFormat::envelope).error,
              "a.envelope: Android's envelopes are written, not read");
}

} // namespace
} // namespace physvib
