// SPDX-License-Identifier: MIT
// What a HapticRenderer cannot take: it says so, and renders silence.
#include "Core/HapticRenderer.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>
#include <limits>

namespace physvib {
namespace {

CollisionEvent hit() {
    CollisionEvent event;
    event.frequencyHz = 205.0;
    event.decayPerSecond = 30.0;
    event.amplitude = 0.5;
    return event;
}

/// One block of a hit, on as many outputs as there are at most, which held something before.
test::Channels blockOf(HapticRenderer& renderer) {
    test::Channels channels(static_cast<std::size_t>(limits::maxEnchanters), std::vector<float>(256, 7.0f));
    std::vector<float*> at;
    for (auto& channel : channels) at.push_back(channel.data());
    const std::vector<CollisionEvent> events{hit()};
    test::ListSource source{events};
    renderer.render(source, at.data(), 256);
    return channels;
}

bool isSilent(const test::Channels& channels, int outputs) {
    return std::all_of(channels.begin(), channels.begin() + outputs, [](const auto& channel) {
        return std::all_of(channel.begin(), channel.end(), [](float sample) { return sample == 0.0f; });
    });
}

RendererSettings settingsOf(int channels, int sampleRateHz = 8000) {
    return {.sampleRateHz = sampleRateHz,
            .channels = channels,
            .panner = {test::gridLayout(2, 1), PanningLaw::linear, 1.0, 1.0, 1.0}};
}

void expectRefused(const RendererSettings& settings, const char* why) {
    const auto renderer = std::make_unique<HapticRenderer>();
    ASSERT_TRUE(renderer->prepare(settingsOf(2)));
    EXPECT_FALSE(isSilent(blockOf(*renderer), 2));
    EXPECT_FALSE(renderer->prepare(settings)) << why;
    EXPECT_TRUE(isSilent(blockOf(*renderer), std::clamp(settings.outputs(), 0, limits::maxEnchanters)))
        << why;
    EXPECT_EQ(renderer->status().framesRendered, 0) << why;
    EXPECT_FALSE(renderer->moveTo(8000, 100)) << why;
    EXPECT_TRUE(renderer->prepare(settingsOf(2))) << why;
    EXPECT_FALSE(isSilent(blockOf(*renderer), 2)) << why;
}

TEST(RendererRefusal, MoreOutputsThanEnchantersAtMost) { expectRefused(settingsOf(65), "65 outputs"); }

TEST(RendererRefusal, NoOutputsOrFewerThanEnchanters) {
    expectRefused(RendererSettings{}, "no outputs");
    expectRefused(settingsOf(-1), "minus one output");
    expectRefused(settingsOf(1), "two enchanters on one output");
}

TEST(RendererRefusal, RatesOutsideTheLimits) {
    for (const int rate : {0, -48000, limits::minSampleRateHz - 1, limits::maxSampleRateHz + 1})
        expectRefused(settingsOf(2, rate), std::to_string(rate).c_str());
}

TEST(RendererRefusal, CeilingsThatAreNone) {
    for (const float ceiling :
         {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        auto settings = settingsOf(2);
        settings.ceilings[1] = ceiling;
        expectRefused(settings, std::to_string(ceiling).c_str());
    }
}

TEST(RendererRefusal, NothingIsHeardBeforeTheFirstPrepare) {
    const auto renderer = std::make_unique<HapticRenderer>();
    EXPECT_TRUE(isSilent(blockOf(*renderer), 1));
}

TEST(RendererRefusal, AMoveToNoRateChangesNothing) {
    const auto renderer = std::make_unique<HapticRenderer>();
    ASSERT_TRUE(renderer->prepare(settingsOf(2)));
    EXPECT_FALSE(renderer->moveTo(0, 500));
    EXPECT_EQ(renderer->status().framesRendered, 0);
    EXPECT_FALSE(isSilent(blockOf(*renderer), 2));
}

} // namespace
} // namespace physvib
