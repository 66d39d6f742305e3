// SPDX-License-Identifier: GPL-3.0-or-later
// Music at the side chain strikes, at its times; live and bounced, in blocks of any size, the same.
#include "SongHost.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;

const BeatSong& song() {
    static const BeatSong made{3.0, songRateHz, 7};
    return made;
}

Samples feltIn(const PluginState& state, SongBlocks blocks, bool hasNotes) {
    SongHost host{state};
    host.turnOn();
    host.listen();
    host.hasNotes = hasNotes;
    const Samples signal = host.felt(song(), blocks);
    EXPECT_EQ(host.plugin->takes().status().late, 0u) << blocks.frames;
    EXPECT_GT(peakOf(signal), 0.05f);
    return signal;
}

TEST(SideChain, IsOffInANewInstanceAndInOldProjects) {
    SongHost host{quietState()};
    ASSERT_EQ(host.plugin->getBusCount(true), 1);
    EXPECT_FALSE(host.plugin->getBus(true, 0)->isEnabled());
    EXPECT_EQ(host.plugin->getTotalNumInputChannels(), 0);
    host.listen();
    EXPECT_EQ(peakOf(host.play(song(), {512})), 0.0f);
    host.turnOn();
    host.listen(0.0f);
    EXPECT_EQ(peakOf(host.play(song(), {512})), 0.0f) << "nor does what comes in go out";
    EXPECT_FALSE(hasSideChain({}, juce::AudioProcessor::wrapperType_LV2));
}

TEST(SideChain, EachBeatIsFeltLAfterItOrDirectlyWhenItIsSureToBeKnown) {
    for (const bool isDirect : {false, true}) {
        SongHost host{quietState(isDirect)};
        host.turnOn(1);
        host.listen();
        const Samples signal = host.felt(song(), {64}, song().samples.size());
        // beyond what the host takes out
        const std::int64_t delay = isDirect ? BeatDetector{songRateHz}.delayFrames() : 0;
        const auto status = host.plugin->takes().status();
        EXPECT_EQ(status.late, 0u);
        EXPECT_GT(status.session.render.played, song().hits.size() / 2);
        std::size_t hats = 0, found = 0;
        for (const auto& hit : song().hits) {
            if (hit.drum == Drum::kick || hit.seconds > 2.5) continue;
            ++hats;
            const auto from = static_cast<std::int64_t>((hit.seconds - 0.02) * songRateHz) + delay,
                       to = from + songRateHz * 40 / 1000;
            std::int64_t first = -1; // the last enchanter is silent between high beats
            for (std::int64_t i = from; i < to && first < 0; ++i)
                if (std::abs(signal[3][static_cast<std::size_t>(i)]) > 2e-3f) first = i;
            found +=
                first >= 0 && std::abs(static_cast<double>(first - delay) / songRateHz - hit.seconds) <= 0.01
                    ? 1
                    : 0;
        }
        EXPECT_GE(found * 100, hats * 95) << isDirect;
    }
}

TEST(SideChain, StrikesAreTheSameLiveAndBouncedInBlocksOfAnySize) {
    for (const bool isDirect : {false, true}) {
        auto state = quietState(isDirect);
        state.controllers = {{1, "strike_level"}};
        const Samples once = feltIn(state, {64}, true);
        for (const SongBlocks blocks : {SongBlocks{64, true},
                                        {480},
                                        {480, true},
                                        {480, false, true},
                                        {1000},
                                        {1000, true},
                                        {4096},
                                        {4096, true}})
            EXPECT_TRUE(feltIn(state, blocks, true) == once)
                << blocks.frames << blocks.isLive << blocks.vary << isDirect;
    }
}

TEST(SideChain, SoIsAWorldBesideThem) {
    const Samples once = feltIn(shakenBox(), {480}, false);
    for (const int frames : {64, 1000, 4096})
        for (const bool isLive : {false, true})
            EXPECT_TRUE(feltIn(shakenBox(), {frames, isLive}, false) == once) << frames << isLive;
}

TEST(SideChain, AutomationOfBeatsMovesNoHop) {
    const auto playAfter = [](int quietFrames) {
        SongHost host{quietState()};
        host.turnOn();
        host.listen(0.0f);
        host.prepare(songRateHz, 1000);
        Samples signal;
        host.feed(song(), 0, quietFrames, signal);
        host.listen();
        for (int at = quietFrames; at + 1000 <= 60'000; at += 1000) host.feed(song(), at, 1000, signal);
        for (auto& channel : signal) channel.resize(55'000);
        return later(signal, 10'000);
    };
    EXPECT_TRUE(playAfter(77) == playAfter(130)); // either way before the first beat
}

TEST(SideChain, LHasRoomForTheDetectorOnlyWhereItListensAndStrikesAreNotDirect) {
    const auto latencyOf = [](SongHost& host) {
        host.prepare(songRateHz, 64);
        return static_cast<int>(host.plugin->takes().outputLatencyFrames());
    };
    auto still = quietState(), moving = shakenBox();
    moving.stepsPerSecond = still.stepsPerSecond;
    SongHost alone{still};
    const int limiter = HapticRenderer::latencyFramesAt(songRateHz);
    EXPECT_EQ(latencyOf(alone), limiter) << "without a world";
    alone.turnOn(1);
    EXPECT_EQ(latencyOf(alone), BeatDetector{songRateHz}.delayFrames() + limiter);
    SongHost host{moving}, direct{quietState(true)};
    const int without = latencyOf(host), ofDirect = latencyOf(direct);
    host.turnOn(1);
    direct.turnOn(1);
    EXPECT_EQ(latencyOf(host), without + 512); // 18.7 ms less two steps of 1 ms, instead of a gap of 6 ms
    EXPECT_EQ(latencyOf(direct), ofDirect);
    auto slow = shakenBox(); // whose steps leave room for it
    ASSERT_TRUE(host.plugin->apply(slow));
    const int listening = host.plugin->getLatencySamples();
    host.turnOn(0);
    EXPECT_EQ(latencyOf(host), listening);
}

TEST(SideChain, AStateWithoutItsParameterLeavesItAtRest) {
    for (const int version : {1, 2, 3}) {
        SongHost host{quietState()};
        auto old = host.plugin->state();
        std::erase_if(old.parameters, [](const auto& parameter) { return parameter.first == "beats"; });
        host.listen();
        std::string text = pluginStateJson(old);
        const std::string now = "\"physvib_plugin_state\": ";
        text.replace(text.find(now), now.size() + 1, now + std::to_string(version));
        restore(*host.plugin, text);
        EXPECT_EQ(host.plugin->trouble(), "");
        EXPECT_EQ(host.plugin->parameter(Parameter::beats).value(), 0.0);
    }
}

} // namespace
} // namespace physvib
