// SPDX-License-Identifier: MIT
// Recorded contacts: from their exact frames on, scaled by the event, panned as modes, in any blocks.
#include "Core/HapticRenderer.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>

namespace physvib::sample_player_test {

const std::vector<float> wood = [] {
    std::vector<float> samples(3000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<float>((i % 7 == 0 ? 1.0 : -0.3) * (1.0 - static_cast<double>(i) / 3000));
    return samples;
}();
const RecordedContact contacts[] = {{349.0, wood}};

CollisionEvent hit(std::int64_t timeNs, double amplitude, double x, double y) {
    return {timeNs, 349.0, 107.0, amplitude, x, y, 0, {}};
}

RendererSettings square() {
    return {48000, 4,
            PhantomPanner{{1, 1, 4, {{{0, 1}, {1, 1}, {0, 0}, {1, 0}}}}, PanningLaw::linear, 1, 1, 1}, false};
}

test::Rendered play(const std::vector<CollisionEvent>& events, int frames, int block) {
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(square());
    renderer->setContacts({contacts});
    const int latency = renderer->latencyFrames();
    test::ListSource source{events};
    auto all = test::renderBlocks(*renderer, source, 4, frames + latency, {block});
    for (auto& channel : all) channel.erase(channel.begin(), channel.begin() + latency);
    return {all, renderer->status()};
}

TEST(SamplePlayer, PlaysTheRecordingFromItsFrameOnScaledAndPanned) {
    const std::vector<CollisionEvent> events{hit(10'000'000, 0.5, 0.25, 0.75), hit(30'000'000, -0.2, 1, 0)};
    const auto played = play(events, 6000, 256);
    PhantomPanner::Gains first{}, second{};
    square().panner.gainsAt(0.25, 0.75, first);
    square().panner.gainsAt(1, 0, second);
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t n = 0; n < 6000; ++n) {
            double expected = 0.0;
            if (n >= 480 && n < 3480) expected += 0.5 * first[j] * static_cast<double>(wood[n - 480]);
            if (n >= 1440 && n < 4440) expected -= 0.2 * second[j] * static_cast<double>(wood[n - 1440]);
            ASSERT_NEAR(static_cast<double>(played.channels[j][n]), expected, 1e-6) << j << ' ' << n;
        }
    EXPECT_EQ(played.status.played, 2u);
    EXPECT_EQ(played.status.liveModes, 0);
}

TEST(SamplePlayer, AnyBlockSizeGivesTheSameBits) {
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 40; ++i) events.push_back(hit(1'234'567 * i, 0.01 * i, 0.02 * i, 1.0 - 0.01 * i));
    events[10].durationNs = 5'000'000;
    const auto reference = play(events, 9000, 8192);
    for (const int block : {1, 17, 64, 441})
        EXPECT_TRUE(play(events, 9000, block).channels == reference.channels) << block;
}

TEST(SamplePlayer, ADurationCutsIt) {
    auto e = hit(0, 1.0, 0, 1);
    e.durationNs = 10'000'000;
    const auto played = play({e}, 3000, 100);
    EXPECT_NE(played.channels[0][476], 0.0f);
    for (std::size_t n = 480; n < 3000; ++n) ASSERT_EQ(played.channels[0][n], 0.0f);
}

TEST(SamplePlayer, WhatHasNoRecordingOrNoRoomIsRejectedAndCounted) {
    auto unknown = hit(0, 1.0, 0, 1);
    unknown.frequencyHz = 350.0;
    EXPECT_EQ(play({unknown}, 100, 100).status.rejected, 1u);
    const std::vector<CollisionEvent> many(limits::maxSampleVoices + 3, hit(0, 0.001, 0, 1));
    const auto status = play(many, 4000, 100).status;
    EXPECT_EQ(status.rejected, 3u);
    EXPECT_EQ(status.played, static_cast<std::uint64_t>(limits::maxSampleVoices));
}

TEST(SamplePlayer, AClipThatIsNotThereIsNotASlowToneInstead) { // as in a list of what a session played
    CollisionEvent clip = hit(0, 1.0, 0.0, 1.0);
    clip.frequencyHz = clipFrequencyHz;
    clip.sound = soundOfClip(maxClips - 1);
    clip.decayPerSecond = 0.0;
    clip.durationNs = 10'000'000'000;
    const auto [all, status] = test::renderEvents({clip}, square(), 8 * 48000);
    for (const auto& channel : all)
        for (const float x : channel) ASSERT_EQ(x, 0.0f);
    EXPECT_EQ(status.rejected, 1u);
}

TEST(SamplePlayer, ASoundHasItsOwnRecordingWhateverItsFrequency) {
    const std::vector<float> oak(10), pine(10), any(10);
    const RecordedContact all[] = {{80.0, any},
                                   {80.0, oak, soundOfMaterial("oak")},
                                   {80.0, pine, soundOfMaterial("pine")},
                                   {80.0, oak, soundOfClip(0)}};
    SamplePlayer player;
    player.prepare(48000, 1);
    player.setContacts(all);
    EXPECT_EQ(player.find(soundOfMaterial("oak"), 80.0), &all[1]);
    EXPECT_EQ(player.find(soundOfMaterial("pine"), 81.0), &all[2]);
    EXPECT_EQ(player.find(soundOfMaterial("elm"), 80.0), &all[0]) << "which has none of its own";
    EXPECT_EQ(player.find(0, 80.0), &all[0]);
    EXPECT_EQ(player.find(0, 81.0), nullptr);
    EXPECT_EQ(player.find(soundOfClip(0), 5.0), &all[3]);
    EXPECT_EQ(player.find(soundOfClip(1), 80.0), nullptr) << "a clip is never found by frequency";
}

TEST(SamplePlayer, StopFadesItWithoutAStep) {
    SamplePlayer player;
    const std::vector<float> ones(48000, 1.0f);
    const RecordedContact constant[] = {{1.0, ones}};
    player.prepare(48000, 1);
    player.setContacts(constant);
    const double gain = 1.0;
    ASSERT_TRUE(player.strike(*player.find(0, 1.0), 1.0, 0, INT64_MAX, &gain));
    player.fadeAll(100);
    std::vector<float> out(1000);
    float* at = out.data();
    EXPECT_TRUE(player.render(&at, 0, 1000));
    for (std::size_t n = 1; n < 1000; ++n) ASSERT_LE(std::abs(out[n] - out[n - 1]), 0.0022f) << n;
    EXPECT_EQ(out[99], 1.0f);
    EXPECT_EQ(out[580], 0.0f);
    EXPECT_EQ(player.voices(), 0);
}

TEST(SamplePlayer, RecordingsThatAreExchangedFadeWithoutAStep) {
    const std::vector<float> ones(48000, 1.0f);
    const RecordedContact constant[] = {{349.0, ones}};
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(square());
    renderer->setContacts({constant});
    test::Session session{
        {hit(0, 1.0, 0, 1)},
        {{.timeNs = 10'000'000, .kind = RenderControl::Kind::recordings, .recordings = {contacts}}}};
    const int latency = renderer->latencyFrames();
    const auto all = test::renderBlocks(*renderer, session, 4, 2000, {2000});
    const auto& out = all[0];
    EXPECT_EQ(out[static_cast<std::size_t>(latency + 479)], 1.0f);
    EXPECT_EQ(out[static_cast<std::size_t>(latency + 960)], 0.0f);
    for (std::size_t n = static_cast<std::size_t>(latency) + 1; n < 2000; ++n)
        ASSERT_LE(std::abs(out[n] - out[n - 1]), 0.0022f) << n;
}

} // namespace physvib::sample_player_test
