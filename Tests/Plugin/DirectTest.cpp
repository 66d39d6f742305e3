// SPDX-License-Identifier: GPL-3.0-or-later
// Direct strikes: what a note strikes is felt as soon as it can be, the host is told so, and a bounce is what
// was played.
#include "PluginTesting.h"
#include <atomic>

namespace physvib {
namespace {

using namespace test;

int lookAheadFrames() { return HapticRenderer::latencyFramesAt(48000); }

juce::MidiBuffer onlyNote(int frame) {
    juce::MidiBuffer midi;
    midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{127}), frame);
    return midi;
}

PluginState directState(bool hasWorld) {
    PluginState s = hasWorld ? shakenBox() : strikeAt(0, 2);
    s.isDirect = true;
    return s;
}

/// Blocks as a host plays them: live, on a clock of the test's own, or bounced.
struct DirectHost : TestHost {
    DirectHost(const PluginState& state, int block, bool offline) {
        EXPECT_TRUE(plugin->apply(state));
        if (!offline) plugin->takes().driveByHand();
        prepare(48000, block, offline);
        isLive = !offline;
    }
    void play(int blocks, Samples& signal, const std::function<juce::MidiBuffer(int)>& midiOf) {
        signal.resize(static_cast<std::size_t>(buffer.getNumChannels()));
        for (int b = 0; b < blocks; ++b) {
            const auto& out = block(largest, midiOf(b));
            for (int c = 0; c < out.getNumChannels(); ++c)
                signal[static_cast<std::size_t>(c)].insert(signal[static_cast<std::size_t>(c)].end(),
                                                           out.getReadPointer(c),
                                                           out.getReadPointer(c) + largest);
            if (!isLive) continue;
            plugin->takes().tick();
        }
    }
    bool isLive = false;
};

std::int64_t directOnset(const std::vector<float>& channel, float threshold = 1e-5f) {
    const auto at = std::ranges::find_if(channel, [=](float x) { return std::abs(x) > threshold; });
    return at == channel.end() ? -1 : at - channel.begin() - 1; // a sine begins with 0
}

TEST(DirectStrikes, ANoteIsFeltTheLimiterLaterInItsOwnBlockOrTheNextAndTheHostIsToldSo) {
    for (const bool offline : {true, false})
        for (const int size : {32, 64, 480, 2048})
            for (const int first : {0, 3}) { // the take's first block, and a later one
                DirectHost host{directState(false), size, offline};
                EXPECT_EQ(host.plugin->getLatencySamples(), lookAheadFrames());
                Samples signal;
                host.play(first + 4 + 4800 / size, signal,
                          [&](int b) { return b == first ? onlyNote(17) : juce::MidiBuffer{}; });
                EXPECT_EQ(directOnset(signal[0]), first * size + 17 + lookAheadFrames()) << size;
                EXPECT_EQ(host.plugin->takes().status().late, 0u);
            }
}

TEST(DirectStrikes, ABounceIsWhatWasPlayedWithItsWorld) {
    for (const int size : {64, 480}) {
        const auto notes = [](int b) { return b % 7 == 0 ? onlyNote(b % 32) : juce::MidiBuffer{}; };
        Samples live, bounce;
        DirectHost playing{directState(true), size, false}, bouncing{directState(true), size, true};
        const int blocks = 3 * 48000 / size;
        playing.play(blocks, live, notes);
        bouncing.play(blocks, bounce, notes);
        EXPECT_TRUE(live == bounce) << size;
        EXPECT_GT(peakOf(bounce), 0.1f);
        EXPECT_EQ(playing.plugin->takes().status().late, 0u);
    }
}

TEST(DirectStrikes, StrikesAloneAreTheSameAtAnyBlockSize) {
    Samples expected;
    for (const int size : {480, 64, 1000, 4096}) {
        DirectHost host{directState(false), size, true};
        Samples signal;
        host.play(48000 / size, signal, [&](int b) {
            juce::MidiBuffer midi;
            for (int n = 0; n < size; ++n)
                if ((b * size + n) % 999 == 0)
                    midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{100}), n);
            return midi;
        });
        for (auto& c : signal) c.resize(40000);
        if (expected.empty()) expected = signal;
        EXPECT_TRUE(signal == expected) << size;
    }
}

TEST(DirectStrikes, CollisionsKeepThePlayOutDelay) {
    auto state = directState(true);
    state.isDirect = false;
    DirectHost ordinary{state, 480, true}, direct{directState(true), 480, true};
    const int playOut = ordinary.plugin->getLatencySamples();
    EXPECT_GT(playOut, 480 + lookAheadFrames());
    Samples a, b;
    const auto none = [](int) { return juce::MidiBuffer{}; };
    ordinary.play(400, a, none);
    direct.play(400, b, none);
    ASSERT_GT(directOnset(a[0]), playOut);
    EXPECT_NEAR(static_cast<double>(directOnset(a[0])), static_cast<double>(directOnset(b[0])), 1.0);
    EXPECT_EQ(direct.plugin->takes().outputLatencyFrames(), playOut);
}

TEST(DirectStrikes, TheSwitchIsSavedAndTheLatencyFollowsIt) {
    TestHost host;
    host.prepare(48000, 480);
    const int playOut = host.plugin->getLatencySamples();
    auto state = host.plugin->state();
    EXPECT_FALSE(state.isDirect) << "as it ever was";
    state.isDirect = true;
    ASSERT_TRUE(host.plugin->edit(state));
    EXPECT_EQ(host.plugin->getLatencySamples(), lookAheadFrames());
    juce::MemoryBlock chunk;
    host.plugin->getStateInformation(chunk);
    TestHost again;
    again.plugin->setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
    EXPECT_TRUE(again.plugin->state().isDirect);
    state.isDirect = false;
    ASSERT_TRUE(host.plugin->edit(state));
    EXPECT_EQ(host.plugin->getLatencySamples(), playOut);
}

TEST(DirectStrikes, AllSoundOffEndsWhatRingsAndWhatIsStruckBehindItIsFelt) {
    DirectHost host{directState(false), 480, true};
    Samples signal;
    host.play(100, signal, [](int b) {
        juce::MidiBuffer midi = b == 0 || b == 50 ? onlyNote(300) : juce::MidiBuffer{};
        if (b == 2 || b == 50) midi.addEvent(juce::MidiMessage::allSoundOff(1), 100);
        return midi;
    });
    const auto rest = later(signal, 2 * 480 + 100 + 480 + lookAheadFrames() + 480);
    const auto before = static_cast<std::int64_t>(signal[0].size() - rest[0].size());
    EXPECT_NEAR(static_cast<double>(directOnset(rest[0], 1e-3f) + before),
                50.0 * 480 + 300 + lookAheadFrames(), 2.0);
}

} // namespace
} // namespace physvib
