// SPDX-License-Identifier: MIT
// OfflineRender: frame n is time n/rate, pieces do not matter, and the shipped scene has its level.
#include "Live/Session/OfflineRender.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

OfflineSettings settings(std::int64_t frames, int block, bool limiter, double fieldWidth = 1,
                         double fieldHeight = 1) {
    EnchanterLayout layout;
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
    const auto made = runScene(scene, {}, 60'000'000'000);
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

} // namespace
} // namespace physvib
