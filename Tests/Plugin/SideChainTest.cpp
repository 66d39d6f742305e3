// SPDX-License-Identifier: GPL-3.0-or-later
// Music at the side chain strikes, at its times, and a bounce of it is the same in blocks of any size.
#include "PluginTesting.h"
#include "Support/BeatSong.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;
using Set = juce::AudioChannelSet;

/// A quiet world, and a song at its side chain.
class SideChain : public ::testing::Test {
protected:
    void SetUp() override {
        auto quiet = strikeAt(0, 4);
        quiet.stepsPerSecond = 1000;
        ASSERT_TRUE(host.plugin->apply(quiet));
    }
    void turnOn(int channels = 2) {
        auto layout = host.plugin->getBusesLayout();
        layout.inputBuses.getReference(0) = channels == 2 ? Set::stereo() : Set::mono();
        ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    }
    void listen() { host.plugin->parameter(Parameter::beats).setValue(0.5f); }

    /// What is played of it from the first frame on, in blocks of up to so many frames.
    Samples play(const BeatSong& of, int block, bool variesBlocks = false) {
        host.prepare(rateHz, block);
        Samples signal(4);
        Random random{3};
        for (std::size_t at = 0; at < of.samples.size();) {
            const int wanted = variesBlocks ? 1 + random.below(2 * block) : block; // also more than announced
            const int frames = static_cast<int>(std::min(static_cast<std::size_t>(wanted), of.samples.size() - at));
            host.buffer.setSize(4, frames, false, false, true);
            for (int c = 0; c < 2; ++c) host.buffer.copyFrom(c, 0, of.samples.data() + at, frames);
            juce::MidiBuffer none;
            host.plugin->processBlock(host.buffer, none);
            for (std::size_t c = 0; c < 4; ++c) signal[c].insert(signal[c].end(), host.buffer.getReadPointer(static_cast<int>(c)), host.buffer.getReadPointer(static_cast<int>(c)) + frames);
            at += static_cast<std::size_t>(frames);
        }
        return signal;
    }
    static float peakOf(const Samples& signal) {
        float peak = 0.0f;
        for (const auto& channel : signal)
            for (const float sample : channel) peak = std::max(peak, std::abs(sample));
        return peak;
    }

    static constexpr int rateHz = 48000;
    TestHost host;
    const BeatSong song{4.0, rateHz, 7};
};

TEST_F(SideChain, IsOffInANewInstanceAndInOldProjects) {
    ASSERT_EQ(host.plugin->getBusCount(true), 1);
    EXPECT_FALSE(host.plugin->getBus(true, 0)->isEnabled());
    EXPECT_EQ(host.plugin->getTotalNumInputChannels(), 0);
    listen();
    EXPECT_EQ(peakOf(play(song, 512)), 0.0f); // whatever stands in a host's buffer
    turnOn();
    host.plugin->parameter(Parameter::beats).setValue(0.0f);
    EXPECT_EQ(peakOf(play(song, 512)), 0.0f); // nor does what comes in go out
    EXPECT_FALSE(hasSideChain(juce::AudioProcessor::wrapperType_LV2));
}

TEST_F(SideChain, EachBeatIsFeltLAfterIt) {
    turnOn();
    listen();
    const Samples felt = play(song, 64);
    const std::int64_t playOut = host.plugin->getLatencySamples();
    const auto status = host.plugin->takes().status();
    EXPECT_EQ(status.late, 0u);
    EXPECT_GT(status.session.render.played, song.hits.size() / 2);
    std::size_t hats = 0, found = 0;
    for (const auto& hit : song.hits) {
        if (hit.drum == Drum::kick || hit.seconds > 3.5) continue;
        ++hats;
        const auto from = static_cast<std::int64_t>((hit.seconds - 0.02) * rateHz) + playOut, to = from + rateHz * 40 / 1000;
        std::int64_t first = -1; // the last enchanter is silent between high beats
        for (std::int64_t i = from; i < to && first < 0; ++i)
            if (std::abs(felt[3][static_cast<std::size_t>(i)]) > 2e-3f) first = i;
        found += first >= 0 && std::abs(static_cast<double>(first - playOut) / rateHz - hit.seconds) <= 0.01 ? 1 : 0;
    }
    EXPECT_GE(found * 100, hats * 95);
}

TEST_F(SideChain, ABounceIsTheSameInBlocksOfAnySize) {
    turnOn();
    listen();
    const Samples once = later(play(song, 64), host.plugin->getLatencySamples());
    ASSERT_GT(peakOf(once), 0.05f);
    for (const int block : {64, 480}) {
        const Samples again = later(play(song, block, true), host.plugin->getLatencySamples());
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_TRUE(std::equal(once[c].begin(), once[c].begin() + 150'000, again[c].begin())) << block << ", channel " << c;
    }
}

TEST_F(SideChain, LHasRoomForTheDetectorOnlyWhereItListens) {
    host.prepare(rateHz, 64);
    const int without = host.plugin->getLatencySamples();
    turnOn(1);
    host.prepare(rateHz, 64);
    EXPECT_EQ(host.plugin->getLatencySamples(), without + 512); // 18.7 ms less two steps of 1 ms, instead of a gap of 6 ms
    auto slow = strikeAt(0, 4);
    slow.stepsPerSecond = 100; // whose steps leave room for it
    ASSERT_TRUE(host.plugin->apply(slow));
    const int listening = host.plugin->getLatencySamples();
    auto layout = host.plugin->getBusesLayout();
    layout.inputBuses.getReference(0) = Set::disabled();
    ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    host.prepare(rateHz, 64);
    EXPECT_EQ(host.plugin->getLatencySamples(), listening);
}

TEST_F(SideChain, AStateWithoutItsParameterLeavesItAtRest) {
    auto old = host.plugin->state();
    std::erase_if(old.parameters, [](const auto& parameter) { return parameter.first == "beats"; });
    listen();
    std::string text = pluginStateJson(old);
    const std::string now = "\"physvib_plugin_state\": " + std::to_string(pluginStateVersion);
    text.replace(text.find(now), now.size(), "\"physvib_plugin_state\": 2");
    host.plugin->setStateInformation(text.data(), static_cast<int>(text.size()));
    EXPECT_EQ(host.plugin->trouble(), "");
    EXPECT_EQ(host.plugin->parameter(Parameter::beats).value(), 0.0);
}

} // namespace
} // namespace physvib
