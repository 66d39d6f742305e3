// SPDX-License-Identifier: MIT
// OfflineRender: frame n is time n/rate, pieces do not matter, and the shipped scene has its level.
#include "Live/Session/OfflineRender.h"
#include "Core/Units.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/SessionRender.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::offline_render_test {

OfflineSettings settings(std::int64_t frames, int block, bool limiter, double fieldWidth = 1,
                         double fieldHeight = 1) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {{48000, 4, PhantomPanner{layout, PanningLaw::linear, 1, fieldWidth, fieldHeight}, limiter},
            frames,
            block};
}

std::vector<float> channelB(const std::vector<CollisionEvent>& events, const OfflineSettings& with) {
    std::vector<float> samples;
    renderOffline(events, with, [&](const float* const* channels, int frames) {
        samples.insert(samples.end(), channels[1], channels[1] + frames);
        return true;
    });
    return samples;
}

CollisionEvent hitUpperRight(std::int64_t timeNs) {
    CollisionEvent e;
    e.timeNs = timeNs;
    e.frequencyHz = 200;
    e.decayPerSecond = 10;
    e.amplitude = 0.5;
    e.x = e.y = 1;
    return e;
}

TEST(OfflineRender, FrameNIsTimeNOverRateWhateverTheLimiterLooksAhead) {
    for (const bool limiter : {false, true})
        for (const int block : {1, 40, 8192}) {
            const auto samples = channelB({hitUpperRight(10'000'000)}, settings(4800, block, limiter));
            ASSERT_EQ(samples.size(), 4800u);
            EXPECT_EQ(samples[479], 0.0f);
            EXPECT_NEAR(samples[480], 0.0f, 1e-12); // sin(0), as rounding leaves it
            EXPECT_NEAR(samples[481],
                        0.5 * std::sin(2 * std::numbers::pi * 200 / 48000) * std::exp(-10.0 / 48000), 1e-7);
        }
}

TEST(OfflineRender, StopsWhenTheConsumerHasEnough) {
    int blocks = 0;
    renderOffline({}, settings(48000, 256, true), [&](const float* const*, int) { return ++blocks < 3; });
    EXPECT_EQ(blocks, 3);
}

TEST(OfflineRender, AMinuteOfShakeTheBoxPeaksNearMinus6dBFSAndUsesAllEnchanters) {
    const Scene& scene = *findBuiltInScene("shake-the-box");
    const auto made = simulateScene(scene, {}, 60'000'000'000);
    std::array<float, 4> peaks{};
    const auto with = settings(60 * 48000, 1024, false, scene.fieldWidthMetres, scene.fieldHeightMetres);
    const auto status = renderOffline(made.events, with, [&](const float* const* channels, int frames) {
        for (std::size_t j = 0; j < 4; ++j)
            for (int n = 0; n < frames; ++n) peaks[j] = std::max(peaks[j], std::abs(channels[j][n]));
        return true;
    });
    const double loudest = 20 * std::log10(*std::max_element(peaks.begin(), peaks.end()));
    EXPECT_NEAR(loudest, -6, 2);
    EXPECT_GT(20 * std::log10(*std::min_element(peaks.begin(), peaks.end())), loudest - 20);
    EXPECT_EQ(status.played, made.events.size());
    EXPECT_EQ(status.late + status.rejected + status.stolen + status.nonFinite + made.drops, 0u);
}

// Places are shares of the field's width and height from its upper left corner, whatever its shape.
TEST(PlacedRecordings, AreFeltWhereTheyWereAskedFor) {
    struct Case {
        FieldPlace place;
        std::vector<double> shares; // of A and B above, C and D below
    };
    const std::vector<Case> cases{{{0, 0}, {1, 0, 0, 0}},          {{1, 0}, {0, 1, 0, 0}},
                                  {{0, 1}, {0, 0, 1, 0}},          {{1, 1}, {0, 0, 0, 1}},
                                  {{0, 0.25}, {0.75, 0, 0.25, 0}}, {{0.75, 1}, {0, 0, 0.25, 0.75}}};
    const StimulusSound recording{48000, {{0.0f, 0.25f, -0.5f}}}; // its peak becomes the level
    for (const auto& [width, height] : {std::pair{0.3, 0.1}, {0.1, 0.3}, {0.2, 0.2}}) {
        const ActuatorLayout geometry{width, height, 4, {{{0, height}, {width, height}, {0, 0}, {width, 0}}}};
        LayoutDescription layout = describeLayout("four", geometry);
        layout.actuators[3].fullScaleG = 2.0;
        const PhantomPanner panner{geometry, PanningLaw::linear, 1.0, width, height};
        for (const auto& [place, shares] : cases) {
            const auto placed = placeRecording(recording, place, 0.8, panner, layout);
            ASSERT_TRUE(placed) << placed.error;
            for (std::size_t j = 0; j < 4; ++j)
                EXPECT_NEAR(placed.value.channels[j][2], -0.8 * shares[j] / layout.actuators[j].fullScaleG,
                            1e-6)
                    << width << " m by " << height << " m, at " << place.x << ", " << place.y << ": "
                    << layout.actuators[j].label;
        }
    }
}

// The audio of contacts: a render of it is what is played live, to the bit.

CollisionEvent hitAt(std::int64_t timeNs, double x) {
    CollisionEvent hit;
    hit.timeNs = timeNs;
    hit.x = x;
    hit.frequencyHz = 250.0;
    hit.decayPerSecond = 40.0;
    hit.amplitude = 0.4;
    return hit;
}

TEST(ContactAudio, ARenderIsWhatIsPlayedAtItsLevelWithFieldsAndStops) {
    constexpr int frames = 24'000;
    const PhantomPanner field{ActuatorLayout{1.0, 1.0, 1, {}}, PanningLaw::linear, 1.0, 2.0, 1.0};
    const std::vector events{hitAt(0, 0.2), hitAt(100'000'000, 1.8), hitAt(300'000'000, 1.0)};
    RenderControl wider{200'000'000, RenderControl::Kind::panner, 0, 0.0f, {}}, gain = wider, stop = wider;
    const PhantomPanner wide{ActuatorLayout{1.0, 1.0, 1, {}}, PanningLaw::linear, 1.0, 8.0, 1.0};
    wider.panner = &wide;
    gain.kind = RenderControl::Kind::gain; // of an actuator
    stop.kind = RenderControl::Kind::stopAll;
    stop.timeNs = 400'000'000;
    const std::vector<RenderControl> controls{gain, wider, stop};

    ContactAudio live{{}, 2, field};
    live.prepare(48'000);
    for (const auto& event : events) live.mirror(event);
    for (const auto& control : controls) live.mirror(control);
    const int latency = HapticRenderer::latencyFramesAt(48'000);
    std::vector<float> played[2];
    for (int done = 0; done < frames + latency; done += 480) {
        float block[2][480];
        float* const at[] = {block[0], block[1]};
        live.render(at, 480);
        for (int c = 0; c < 2; ++c) played[c].insert(played[c].end(), block[c], block[c] + 480);
    }

    ContactAudioRender heard{48'000, frames};
    heard.channels = 2;
    heard.field = field;
    heard.levelDb = -20.0;
    const auto scale = static_cast<float>(fromDecibels(-20.0));
    int done = 0, wrong = 0;
    float most = 0.0f, apart = 0.0f, last = 0.0f;
    renderContactAudio(events, controls, heard, [&](const float* const* channels, int n) {
        for (int k = 0; k < n; ++k, ++done) {
            for (int c = 0; c < 2; ++c)
                wrong += channels[c][k] != played[c][static_cast<std::size_t>(done + latency)] * scale;
            most = std::max(most, std::abs(channels[0][k]));
            apart = std::max(apart, std::abs(channels[0][k] - channels[1][k]));
            last = std::abs(channels[0][k]);
        }
        return true;
    });
    EXPECT_EQ(done, frames);
    EXPECT_EQ(wrong, 0) << "samples";
    EXPECT_GT(most, 0.01f);
    EXPECT_LE(most, 0.1f);
    EXPECT_GT(apart, 0.01f);
    EXPECT_LT(last, 1e-6f) << "stopped";
}

} // namespace physvib::offline_render_test
