// SPDX-License-Identifier: GPL-3.0-or-later
// Direct strikes: what a note strikes is felt as soon as it can be, the host is told so, and a bounce is what
// was played.
#include "PluginTesting.h"
#include <functional>

namespace physvib {
namespace {

using namespace test;

int lookAheadFrames() { return HapticRenderer::latencyFramesAt(48000); }

PluginState directState(bool hasWorld) {
    PluginState s = hasWorld ? shakenBox() : strikeAt(0, 2);
    s.isDirect = true;
    return s;
}

/// Blocks as a host plays them: live, on a clock of the test's own, or bounced.
struct DirectHost : TestHost {
    DirectHost(const PluginState& state, int block, bool offline)
        : TestHost{state} {
        if (!offline) plugin->takes().driveByHand();
        prepare(48000, block, offline);
        isLive = !offline;
    }
    void play(int blocks, Samples& signal, const std::function<juce::MidiBuffer(int)>& midiOf) {
        for (int b = 0; b < blocks; ++b) {
            append(signal, block(largest, midiOf(b)));
            if (isLive) plugin->takes().tick();
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
                          [&](int b) { return b == first ? oneNote(60, 127, 17) : juce::MidiBuffer{}; });
                EXPECT_EQ(directOnset(signal[0]), first * size + 17 + lookAheadFrames()) << size;
                EXPECT_EQ(host.plugin->takes().status().late, 0u);
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
    TestHost again;
    restore(*again.plugin, chunkOf(*host.plugin));
    EXPECT_TRUE(again.plugin->state().isDirect);
    state.isDirect = false;
    ASSERT_TRUE(host.plugin->edit(state));
    EXPECT_EQ(host.plugin->getLatencySamples(), playOut);
}

TEST(DirectStrikes, AllSoundOffEndsWhatRingsAndWhatIsStruckBehindItIsFelt) {
    DirectHost host{directState(false), 480, true};
    Samples signal;
    host.play(100, signal, [](int b) {
        juce::MidiBuffer midi = b == 0 || b == 50 ? oneNote(60, 127, 300) : juce::MidiBuffer{};
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
