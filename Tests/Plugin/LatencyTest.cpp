// SPDX-License-Identifier: GPL-3.0-or-later
// The latency that the host is told is the one that is measured: of notes and worlds, in both timings, in
// blocks of 32 to 4,096 frames, also while the timing changes.
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;

constexpr std::array blockSizes{32, 64, 128, 256, 512, 1024, 2048, 4096};

struct LatencyHost : TestHost {
    explicit LatencyHost(const PluginState& state, bool isTight = false)
        : TestHost{state} {
        time(isTight);
        plugin->takes().driveByHand();
    }
    void time(bool isTight) { plugin->parameter(Parameter::timing).setValue(isTight ? 1.0f : 0.0f); }

    /// In real time; appended to `signal`.
    void playPaced(std::int64_t frames, Samples& signal) {
        for (std::int64_t done = 0; done < frames; done += largest) {
            append(signal, block(largest));
            plugin->takes().tick();
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
    TestHost offline{drop()};
    offline.prepare(48000, 64);
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
    const auto safe = host.plugin->takes().latencyFrames();
    TestHost offline;
    offline.prepare(48000, 512);
    Samples reference, signal;
    offline.play(10 * 48000, reference);
    reference = later(reference, offline.plugin->getLatencySamples());
    for (int change = 1; change <= 4; ++change) {
        host.time(change % 2 == 1);
        host.playPaced(2 * 48000, signal);
        const auto told = host.plugin->takes().latencyFrames();
        EXPECT_EQ(told, change % 2 == 1 ? 960 + 47 : safe);
        const auto end = signal[0].size();
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t n = end - 48000; n < end; ++n)
                ASSERT_EQ(signal[c][n], reference[c][n - static_cast<std::size_t>(told)])
                    << change << ' ' << n;
    }
    EXPECT_EQ(host.plugin->takes().status().take, 1) << "one run";
    EXPECT_EQ(host.plugin->takes().status().late, 0u);
    EXPECT_EQ(host.plugin->takes().status().slippedNs, 0);
    float step = 0.0f, usual = 0.0f;
    for (const auto& c : signal)
        for (std::size_t n = 1; n < c.size(); ++n) step = std::max(step, std::abs(c[n] - c[n - 1]));
    for (const auto& c : reference)
        for (std::size_t n = 1; n < c.size(); ++n) usual = std::max(usual, std::abs(c[n] - c[n - 1]));
    EXPECT_LT(step, usual + 0.01f) << "nothing clicks";
}

TEST(Latency, AStateOfAnOlderVersionIsSafe) {
    TestHost host;
    auto old = host.plugin->state();
    std::erase_if(old.parameters, [](const auto& p) { return p.first == "timing"; });
    host.plugin->parameter(Parameter::timing).setValue(1.0f);
    const auto text = pluginStateJson(old);
    restore(*host.plugin, text);
    host.prepare(48000, 512, false);
    EXPECT_EQ(host.plugin->getLatencySamples(), 512 + 480 + 960 + 47);
}

} // namespace
} // namespace physvib
