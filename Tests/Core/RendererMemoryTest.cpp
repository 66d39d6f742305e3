// SPDX-License-Identifier: MIT
// What a renderer takes from the heap, and when: in prepare, by channels and modes; what happens beyond.
#include "Support/RendererMemory.h"
#include "Core/HapticRenderer.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>
#include <limits>

namespace physvib::renderer_memory_test {

std::size_t bytesTaken = 0;

bool count(std::size_t bytes) {
    bytesTaken += bytes;
    return true;
}

RendererSettings settingsFor(int channels, int modes) {
    const auto layout = test::gridLayout(channels / 2, 2);
    return {.channels = channels, .panner = {layout, PanningLaw::linear, 1.0, 1.0, 1.0}, .modes = modes};
}

/// `count` frequencies, struck one after the other, the last ones softest.
std::vector<CollisionEvent> tones(int count) {
    std::vector<CollisionEvent> events;
    for (int i = 0; i < count; ++i)
        events.push_back({1'000'000 * i, 100.0 + i, 1.0, 0.01 / (1 + i), 0.5, 0.5, 0, {}});
    return events;
}

TEST(RendererMemory, FollowsChannelsAndModes) {
    if (!test::ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    test::beforeMemory = count;
    const auto bytesFor = [](int channels, int modes) {
        const std::size_t before = bytesTaken;
        const auto renderer = std::make_unique<HapticRenderer>();
        EXPECT_TRUE(renderer->prepare(settingsFor(channels, modes)));
        const std::size_t first = bytesTaken - before;
        EXPECT_TRUE(renderer->prepare(settingsFor(channels, modes)));
        EXPECT_EQ(bytesTaken - before, first) << "what it has is used again";
        return first;
    };
    const std::size_t few = bytesFor(4, 64), all = bytesFor(4, 0);
    std::printf("a renderer of four channels: %zu bytes, for 64 modes %zu\n", all, few);
    EXPECT_LT(few, 1'000'000U);
    EXPECT_LT(all, 14'000'000U);
    EXPECT_LT(bytesFor(4, 512), bytesFor(8, 512));
    EXPECT_LT(bytesFor(8, 512), bytesFor(8, 513));
    test::beforeMemory = nullptr;
}

TEST(RendererMemory, ABudgetThatSufficesChangesNoBit) {
    auto events = test::randomEvents(300, 0.5, 8);
    for (std::size_t i = 0; i < events.size(); ++i)
        events[i].frequencyHz = 50.0 + static_cast<double>(i % 40), events[i].decayPerSecond = 20.0;
    const auto all = test::renderEvents(events, settingsFor(4, 0), 30000),
               few = test::renderEvents(events, settingsFor(4, 80), 30000);
    EXPECT_EQ(few.status.stolen, 0U);
    EXPECT_EQ(all.channels, few.channels);
}

TEST(RendererMemory, BeyondItTheQuietestModesFadeAndAreCounted) {
    const auto rendered = test::renderEvents(tones(100), settingsFor(4, 64), 12000);
    EXPECT_EQ(rendered.status.played, 100U);
    EXPECT_EQ(rendered.status.rejected, 0U);
    EXPECT_EQ(rendered.status.stolen, 36U);
    EXPECT_LE(rendered.status.liveModes, 64 + limits::maxFadingModes);
}

TEST(RendererMemory, MoreModesThanAtMostAreRefused) {
    const auto renderer = std::make_unique<HapticRenderer>();
    EXPECT_FALSE(renderer->prepare(settingsFor(4, limits::maxModes + 1)));
    EXPECT_FALSE(renderer->prepare(settingsFor(4, -1)));
}

TEST(RendererMemory, WithoutItAllIsSilentUntilThereIsSome) {
    if (!test::ownsMemory) GTEST_SKIP() << "under the thread sanitizer memory is its own";
    const auto renderer = std::make_unique<HapticRenderer>();
    test::beforeMemory = [](std::size_t) { return false; };
    EXPECT_FALSE(renderer->prepare(settingsFor(2, 0)));
    test::beforeMemory = nullptr;
    const auto events = tones(1);
    test::ListSource source{events};
    std::vector<float> left(64, 1.0f), right(64, 1.0f);
    float* const out[] = {left.data(), right.data()};
    renderer->render(source, out, 64);
    EXPECT_EQ(left, std::vector<float>(64, 0.0f));
    EXPECT_EQ(source.next, 0U) << "takes no events";
    EXPECT_TRUE(renderer->prepare(settingsFor(2, 0)));
    renderer->render(source, out, 64);
    EXPECT_EQ(renderer->status().played, 1U);
}

// What a HapticRenderer cannot take: it says so, and renders silence.

/// One block of a hit, on as many outputs as there are at most, which held something before.
test::Channels blockOf(HapticRenderer& renderer) {
    test::Channels channels(static_cast<std::size_t>(limits::maxActuators), std::vector<float>(256, 7.0f));
    std::vector<float*> at;
    for (auto& channel : channels) at.push_back(channel.data());
    const std::vector<CollisionEvent> events{{0, 205.0, 30.0, 0.5, 0.0, 0.0, 0, {}}};
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
    EXPECT_TRUE(isSilent(blockOf(*renderer), std::clamp(settings.outputs(), 0, limits::maxActuators))) << why;
    EXPECT_EQ(renderer->status().framesRendered, 0) << why;
    EXPECT_FALSE(renderer->moveTo(8000, 100)) << why;
    EXPECT_TRUE(renderer->prepare(settingsOf(2))) << why;
    EXPECT_FALSE(isSilent(blockOf(*renderer), 2)) << why;
}

TEST(RendererRefusal, OutputsRatesAndCeilingsOutsideTheLimits) {
    expectRefused(settingsOf(65), "65 outputs");
    expectRefused(RendererSettings{}, "no outputs");
    expectRefused(settingsOf(-1), "minus one output");
    expectRefused(settingsOf(1), "two enchanters on one output");
    for (const int rate : {0, -48000, limits::minSampleRateHz - 1, limits::maxSampleRateHz + 1})
        expectRefused(settingsOf(2, rate), std::to_string(rate).c_str());
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

} // namespace physvib::renderer_memory_test
