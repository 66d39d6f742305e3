// SPDX-License-Identifier: GPL-3.0-or-later
// Music at the side chain strikes, at its times; live and bounced, in blocks of any size, the same.
#include "PluginTesting.h"
#include "Support/BeatSong.h"
#include <atomic>
#include <cmath>

namespace physvib {
namespace {

using namespace test;
using Set = juce::AudioChannelSet;

constexpr int songRateHz = 48000;

struct SongBlocks {
    int frames = 64;
    bool isLive = false;
    bool vary = false; ///< up to twice what was announced
};

PluginState quietState(bool isDirect = false) {
    auto quiet = strikeAt(0, 4);
    quiet.stepsPerSecond = 1000; // two steps are shorter than the detector's delay
    quiet.isDirect = isDirect;
    return quiet;
}

/// A song at the side chain of an instance.
class SongHost : public TestHost {
public:
    explicit SongHost(const PluginState& state) { EXPECT_TRUE(plugin->apply(state)); }

    void turnOn(int channels = 2) {
        auto layout = plugin->getBusesLayout();
        layout.inputBuses.getReference(0) = channels == 0 ? Set::disabled() : channels == 1 ? Set::mono() : Set::stereo();
        ASSERT_TRUE(plugin->setBusesLayout(layout));
    }
    void listen(float readiness = 0.5f) { plugin->parameter(Parameter::beats).setValue(readiness); }

    /// One block of it, from frame `at` on; what is played is appended to `signal`.
    void feed(const BeatSong& song, int at, int frames, Samples& signal) {
        signal.resize(4);
        buffer.setSize(4, frames, false, false, true);
        for (int c = 0; c < 4; ++c) buffer.copyFrom(c, 0, song.samples.data() + at, frames); // whatever stands in a host's buffer
        auto midi = notes(at, frames);
        plugin->processBlock(buffer, midi);
        for (std::size_t c = 0; c < 4; ++c) signal[c].insert(signal[c].end(), buffer.getReadPointer(static_cast<int>(c)), buffer.getReadPointer(static_cast<int>(c)) + frames);
    }

    /// What is played of all of it.
    Samples play(const BeatSong& song, SongBlocks blocks) {
        if (blocks.isLive) plugin->takes().driveByHand(nowNs_);
        prepare(songRateHz, blocks.frames, !blocks.isLive);
        Samples signal;
        Random random{3};
        const int length = static_cast<int>(song.samples.size());
        for (int at = 0; at < length;) {
            const int frames = std::min(blocks.vary ? 1 + random.below(2 * blocks.frames) : blocks.frames, length - at);
            feed(song, at, frames, signal);
            at += frames;
            if (!blocks.isLive) continue;
            nowNs_ += std::int64_t{1'000'000'000} * frames / songRateHz;
            plugin->takes().tick();
        }
        return signal;
    }

    /// The same as it is felt beside the song, for so many frames.
    Samples felt(const BeatSong& song, SongBlocks blocks, std::size_t frames = 130'000) {
        const Samples signal = play(song, blocks); // before the latency is asked for
        Samples beside = later(signal, plugin->getLatencySamples());
        for (auto& channel : beside) channel.resize(std::min(frames, channel.size()));
        return beside;
    }

    bool hasNotes = false; ///< and a controller that moves what beats are struck with

private:
    juce::MidiBuffer notes(int at, int frames) const {
        juce::MidiBuffer midi;
        for (int i = 0; i < frames && hasNotes; ++i) {
            if ((at + i) % 4999 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{100}), i);
            if ((at + i) % 7001 == 0) midi.addEvent(juce::MidiMessage::controllerEvent(1, 1, (at + i) / 7001 % 30 + 90), i);
        }
        return midi;
    }
    std::atomic<std::int64_t> nowNs_{0};
};

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
    EXPECT_FALSE(hasSideChain(juce::AudioProcessor::wrapperType_LV2));
}

TEST(SideChain, EachBeatIsFeltLAfterItOrDirectlyWhenItIsSureToBeKnown) {
    for (const bool isDirect : {false, true}) {
        SongHost host{quietState(isDirect)};
        host.turnOn(1);
        host.listen();
        const Samples signal = host.felt(song(), {64}, song().samples.size());
        const std::int64_t delay = isDirect ? BeatDetector{songRateHz}.delayFrames() : 0; // beyond what the host takes out
        const auto status = host.plugin->takes().status();
        EXPECT_EQ(status.late, 0u);
        EXPECT_GT(status.session.render.played, song().hits.size() / 2);
        std::size_t hats = 0, found = 0;
        for (const auto& hit : song().hits) {
            if (hit.drum == Drum::kick || hit.seconds > 2.5) continue;
            ++hats;
            const auto from = static_cast<std::int64_t>((hit.seconds - 0.02) * songRateHz) + delay, to = from + songRateHz * 40 / 1000;
            std::int64_t first = -1; // the last enchanter is silent between high beats
            for (std::int64_t i = from; i < to && first < 0; ++i)
                if (std::abs(signal[3][static_cast<std::size_t>(i)]) > 2e-3f) first = i;
            found += first >= 0 && std::abs(static_cast<double>(first - delay) / songRateHz - hit.seconds) <= 0.01 ? 1 : 0;
        }
        EXPECT_GE(found * 100, hats * 95) << isDirect;
    }
}

TEST(SideChain, StrikesAreTheSameLiveAndBouncedInBlocksOfAnySize) {
    for (const bool isDirect : {false, true}) {
        auto state = quietState(isDirect);
        state.controllers = {{1, "strike_level"}};
        const Samples once = feltIn(state, {64}, true);
        for (const SongBlocks blocks : {SongBlocks{64, true}, {480}, {480, true}, {480, false, true}, {1000}, {1000, true}, {4096}, {4096, true}})
            EXPECT_TRUE(feltIn(state, blocks, true) == once) << blocks.frames << blocks.isLive << blocks.vary << isDirect;
    }
}

TEST(SideChain, SoIsAWorldBesideThem) {
    const Samples once = feltIn(shakenBox(), {480}, false);
    for (const int frames : {64, 1000, 4096})
        for (const bool isLive : {false, true}) EXPECT_TRUE(feltIn(shakenBox(), {frames, isLive}, false) == once) << frames << isLive;
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
        return static_cast<int>(host.plugin->takes().playOutFrames());
    };
    SongHost host{quietState()}, direct{quietState(true)};
    const int without = latencyOf(host), ofDirect = latencyOf(direct);
    host.turnOn(1);
    direct.turnOn(1);
    EXPECT_EQ(latencyOf(host), without + 512); // 18.7 ms less two steps of 1 ms, instead of a gap of 6 ms
    EXPECT_EQ(latencyOf(direct), ofDirect);
    auto slow = strikeAt(0, 4); // whose steps leave room for it
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
        host.plugin->setStateInformation(text.data(), static_cast<int>(text.size()));
        EXPECT_EQ(host.plugin->trouble(), "");
        EXPECT_EQ(host.plugin->parameter(Parameter::beats).value(), 0.0);
    }
}

} // namespace
} // namespace physvib
