// SPDX-License-Identifier: GPL-3.0-or-later
// The latency that the host is told is the one that is measured: of notes and worlds, in both timings, in
// blocks of 32 to 4,096 frames, also while the timing changes.
#include "PluginTesting.h"
#include <functional>

namespace physvib::latency_test {

using namespace test;

constexpr std::array blockSizes{32, 64, 128, 256, 512, 1024, 2048, 4096};

struct LatencyHost : TestHost {
    explicit LatencyHost(const PluginState& state, bool isTight = false)
        : TestHost{state} {
        time(isTight);
        plugin->runs().useManualStepping();
    }
    void time(bool isTight) { setNormal(Parameter::timing, isTight ? 1.0f : 0.0f); }

    /// In real time; appended to `signal`.
    void playPaced(std::int64_t frames, Samples& signal) {
        for (std::int64_t done = 0; done < frames; done += largest) {
            append(signal, block(largest));
            plugin->runs().tick();
        }
    }
};

/// A disc that a note drops on the floor from some height, and nothing else.
PluginState drop() {
    auto state = shakenBox();
    state.limiterEnabled = false;
    return state;
}

/// By how many frames `signal` is `reference` later; -1: by none.
std::int64_t lagOf(const Samples& signal, const Samples& reference) {
    const auto first = [](const Samples& s) {
        std::int64_t at = static_cast<std::int64_t>(s[0].size());
        for (const auto& c : s)
            at = std::min(at, std::ranges::find_if(c, [](float x) { return x != 0.0f; }) - c.begin());
        return at;
    };
    const auto lag = first(signal) - first(reference);
    for (std::size_t c = 0; c < reference.size(); ++c)
        for (std::size_t n = 0; n < reference[c].size() && lag >= 0; ++n)
            if (signal[c][n + static_cast<std::size_t>(lag)] != reference[c][n]) return -1;
    return lag;
}

TEST(Latency, OfAWorldIsAsToldAtAnyBlockSizeInBothTimings) {
    TestHost offline{drop(), 64};
    const Samples reference = offline.felt(2 * 48000);
    std::printf("block     safe told, measured     tight told, measured (frames at 48 kHz)\n");
    for (const int size : blockSizes) {
        std::printf("%5d", size);
        for (const bool isTight : {false, true}) {
            LatencyHost host{drop(), isTight};
            host.prepare(48000, size, false);
            const int told = host.plugin->getLatencySamples();
            Samples signal;
            host.playPaced(3 * 48000, signal);
            const auto measured = lagOf(signal, reference);
            EXPECT_EQ(measured, told) << size << isTight;
            EXPECT_EQ(told, isTight ? 960 + 47 : size + 480 + 960 + 47);
            std::printf("     %6d %9d", told, static_cast<int>(measured));
        }
        std::printf("\n");
    }
}

TEST(Latency, TheTimingChangesWhileItPlaysWithoutANewRun) {
    LatencyHost host{shakenBox()};
    host.prepare(48000, 512, false);
    const auto safe = host.plugin->runs().latencyFrames();
    TestHost offline{shakenBox(), 512};
    Samples signal;
    const Samples reference = later(offline.played(10 * 48000), offline.plugin->getLatencySamples());
    for (int change = 1; change <= 4; ++change) {
        host.time(change % 2 == 1);
        host.playPaced(2 * 48000, signal);
        const auto told = host.plugin->runs().latencyFrames();
        EXPECT_EQ(told, change % 2 == 1 ? 960 + 47 : safe);
        const auto end = signal[0].size();
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t n = end - 48000; n < end; ++n)
                ASSERT_EQ(signal[c][n], reference[c][n - static_cast<std::size_t>(told)])
                    << change << ' ' << n;
    }
    EXPECT_EQ(host.plugin->runs().status().runNumber, 1) << "one run";
    EXPECT_EQ(host.plugin->runs().status().late, 0u);
    EXPECT_EQ(host.plugin->runs().status().stalledNs, 0);
    float step = 0.0f, usual = 0.0f;
    for (const auto& c : signal) step = std::max(step, largestStep(c));
    for (const auto& c : reference) usual = std::max(usual, largestStep(c));
    EXPECT_LT(step, usual + 0.01f) << "nothing clicks";
}

// Direct strikes: felt as soon as they can be, the host knows, and a bounce is what was played.

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
        if (!offline) plugin->runs().useManualStepping();
        prepare(48000, block, offline);
        isLive = !offline;
    }
    void play(int blocks, Samples& signal, const std::function<juce::MidiBuffer(int)>& midiOf) {
        for (int b = 0; b < blocks; ++b) {
            append(signal, block(largest, midiOf(b)));
            if (isLive) plugin->runs().tick();
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
                EXPECT_EQ(host.plugin->runs().status().late, 0u);
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
    EXPECT_EQ(direct.plugin->runs().outputLatencyFrames(), playOut);
}

TEST(DirectStrikes, TheSwitchIsSavedAndTheLatencyFollowsIt) {
    TestHost host{shakenBox(), 480};
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

} // namespace physvib::latency_test
