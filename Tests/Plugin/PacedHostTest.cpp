// SPDX-License-Identifier: GPL-3.0-or-later
// Hosts that call in bursts, ahead of time or for more than they announced, on a clock of the test's own:
// what is played is the bounce to the bit; where L had to grow first, that is said, and once the host has
// taken the new L out, every block is.
#include "PluginEditor.h"
#include "PluginTesting.h"
#include <functional>

namespace physvib {
namespace {

using namespace test;

/// A host on a clock that the test moves: the worlds are stepped every 5 ms of it, whatever the host asks
/// for.
class PacedHost : public TestHost {
public:
    explicit PacedHost(const PluginState& state = shakenBox()) {
        EXPECT_TRUE(plugin->apply(state));
        plugin->takes().driveByHand(nowNs_);
    }

    void wait(std::int64_t lengthNs) {
        for (const std::int64_t end = nowNs_ + lengthNs; nowNs_ < end;) {
            const std::int64_t next = std::min(end, (nowNs_ / tickNs + 1) * tickNs);
            nowNs_ = next;
            if (next % tickNs == 0) plugin->takes().tick();
        }
    }
    void waitFrames(std::int64_t frames) { wait(frames * 1'000'000'000 / 48000); }

    /// Real time as a host does it that wants `blocks(i)` blocks at its i-th waking.
    Samples playBursts(std::int64_t frames, int block, const std::function<int(int)>& blocks) {
        Samples signal;
        for (std::int64_t done = 0, i = 0; done < frames; ++i) {
            const int burst = blocks(static_cast<int>(i)) * block;
            play(burst, signal);
            done += burst;
            waitFrames(burst);
        }
        return signal;
    }

    TakesStatus status() { return plugin->takes().status(); }

private:
    static constexpr std::int64_t tickNs = 5'000'000;
    std::atomic<std::int64_t> nowNs_{0};
};

Samples bounced(const PluginState& state, int block, std::int64_t frames) {
    TestHost host;
    EXPECT_TRUE(host.plugin->apply(state));
    host.prepare(48000, block);
    Samples signal;
    host.play(frames + host.plugin->getLatencySamples(), signal);
    return later(signal, host.plugin->getLatencySamples());
}

/// The scene struck all the time, so that a block that is not the bounce's shows.
PluginState busy() {
    auto state = shakenBox();
    state.limiterEnabled = false;
    return state;
}

/// Frames from the end on that are the bounce's, `latency` later.
std::int64_t equalAtTheEnd(const Samples& signal, const Samples& bounce, std::int64_t latency) {
    std::int64_t least = static_cast<std::int64_t>(signal[0].size());
    for (std::size_t c = 0; c < signal.size(); ++c) {
        std::int64_t n = static_cast<std::int64_t>(signal[c].size());
        for (; n > latency && signal[c][static_cast<std::size_t>(n - 1)] ==
                                  bounce[c][static_cast<std::size_t>(n - 1 - latency)];)
            --n;
        least = std::min(least, static_cast<std::int64_t>(signal[c].size()) - n);
    }
    return least;
}

float largestStep(const Samples& signal) {
    float most = 0;
    for (const auto& c : signal)
        for (std::size_t n = 1; n < c.size(); ++n) most = std::max(most, std::abs(c[n] - c[n - 1]));
    return most;
}

constexpr std::int64_t length = 6 * 48000;

/// Plays until L has settled, as the host is told, and once more from the start with that L.
void expectTheBounce(const std::function<int(int)>& blocks, int block, const char* what) {
    SCOPED_TRACE(what);
    const auto bounce = bounced(busy(), block, 3 * length);
    PacedHost host{busy()};
    host.prepare(48000, block, false);
    const int announced = host.plugin->getLatencySamples();
    const auto first = host.playBursts(length, block, blocks);
    const auto learned = host.plugin->takes().playOutFrames();
    const auto frames = static_cast<std::int64_t>(first[0].size());
    EXPECT_EQ(host.status().slippedNs, 0) << "the world never runs slow";
    EXPECT_EQ(host.status().session.render.late, 0u);
    EXPECT_EQ(learned - announced, host.status().waitedFrames) << "the deviation is told";
    EXPECT_EQ(host.status().burstFrames, host.status().waitedFrames);
    if (host.status().waitedFrames == 0)
        EXPECT_EQ(equalAtTheEnd(first, bounce, announced), frames - announced);
    else
        EXPECT_GT(equalAtTheEnd(first, bounce, learned), 48000) << "of " << frames << ", L " << learned;
    EXPECT_LT(largestStep(first), largestStep(bounce) + 0.01f) << "nothing cuts";

    host.prepare(48000, block, false);
    EXPECT_EQ(host.plugin->getLatencySamples(), learned) << "told, and kept";
    const auto second = host.playBursts(length, block, blocks);
    EXPECT_EQ(host.status().waitedFrames, 0);
    EXPECT_EQ(host.status().slippedNs, 0);
    EXPECT_EQ(equalAtTheEnd(second, bounce, learned), static_cast<std::int64_t>(second[0].size()) - learned)
        << "every block";
}

TEST(PacedHost, BurstsAreTheBounce) {
    for (const int burst : {1, 2, 3, 5, 12, 20, 40})
        expectTheBounce([=](int) { return burst; }, 512, std::to_string(burst).c_str());
    expectTheBounce([](int) { return 40; }, 64, "40 of 64");
}

TEST(PacedHost, BurstsOfAnySizeAreTheBounceOnceTheLargestWasSeen) {
    Random random{8};
    std::vector<int> sizes(64);
    for (int& size : sizes) size = 1 + random.below(40);
    expectTheBounce([&](int i) { return sizes[static_cast<std::size_t>(i) % sizes.size()]; }, 256, "1 to 40");
}

TEST(PacedHost, HalfASecondAheadIsTheBounce) {
    for (const int block : {64, 512, 1024}) {
        const int ahead = 24000 / block;
        expectTheBounce([=](int i) { return i == 0 ? ahead : 1; }, block, "filled once");
        expectTheBounce([=](int i) { return i % 10 == 0 ? ahead : 1; }, block, "filled now and then");
    }
}

TEST(PacedHost, ABlockLargerThanAnnouncedLosesNothingAndLGrows) {
    for (const int sent : {600, 2048, 16384}) {
        const auto bounce = bounced(busy(), 512, 2 * length);
        PacedHost host{busy()};
        host.prepare(48000, 512, false);
        Samples signal;
        for (std::int64_t done = 0; done < length; done += sent) {
            host.largest = sent;
            host.play(sent, signal);
            host.waitFrames(sent);
        }
        const auto learned = host.plugin->takes().playOutFrames();
        EXPECT_EQ(host.status().slippedNs, 0) << sent;
        EXPECT_GE(learned, sent) << sent;
        EXPECT_GT(equalAtTheEnd(signal, bounce, learned), length / 2) << sent;
        for (int i = 0; i < 100 && host.plugin->getLatencySamples() != learned; ++i) runFor(0.01);
        EXPECT_EQ(host.plugin->getLatencySamples(), learned) << "the host is told while it plays";
    }
}

// As LV2 hosts do that announce what an export may need.
TEST(PacedHost, LIsThatOfTheUsualBlockUntilALargerOneComes) {
    PacedHost host{busy()};
    host.plugin->expectBlocksOf(512);
    host.prepare(48000, 8192, false);
    const int usual = host.plugin->getLatencySamples();
    EXPECT_EQ(usual, 512 + 480 + 960 + 47);
    Samples signal;
    host.largest = 512;
    for (int b = 0; b < 20; ++b) {
        host.play(512, signal);
        host.waitFrames(512);
    }
    EXPECT_EQ(host.plugin->takes().playOutFrames(), usual);
    host.largest = 2048;
    for (int b = 0; b < 20; ++b) {
        host.play(2048, signal);
        host.waitFrames(2048);
    }
    const auto learned = host.plugin->takes().playOutFrames();
    EXPECT_GE(learned, 2048);
    EXPECT_LT(learned, usual + 8192 - 512) << "less than for the largest that can come";
    for (int i = 0; i < 100 && host.plugin->getLatencySamples() != learned; ++i) runFor(0.01);
    EXPECT_EQ(host.plugin->getLatencySamples(), learned);
}

TEST(PacedHost, AnInputActsWhereItCameWhileLGrows) {
    auto state = busy();
    const auto played = [&](auto& host, int burst, auto pause) {
        Samples signal;
        for (int b = 0; b < 600; ++b) {
            if (b % 20 == 7)
                host.plugin->parameter(Parameter::tilt).setValue(static_cast<float>(b % 200) / 200.0f);
            host.play(512, signal);
            if (b % burst == burst - 1) pause(burst * 512);
        }
        return signal;
    };
    TestHost offline;
    ASSERT_TRUE(offline.plugin->apply(state));
    offline.prepare(48000, 512);
    const auto bounce = later(played(offline, 20, [](int) {}), offline.plugin->getLatencySamples());
    PacedHost host{state};
    host.prepare(48000, 512, false);
    const auto live = played(host, 20, [&](int frames) { host.waitFrames(frames); });
    EXPECT_GT(host.status().waitedFrames, 0);
    Samples rest = bounce;
    for (auto& c : rest) c.resize(live[0].size());
    EXPECT_GT(equalAtTheEnd(live, rest, host.plugin->takes().playOutFrames()), 5 * 48000);
}

TEST(PacedHost, AThreadThatComesLateIsAStallAndNoBurst) {
    PacedHost host{busy()};
    host.prepare(48000, 512, false);
    Samples signal;
    for (int b = 0; b < 100; ++b) {
        host.play(512, signal);
        host.waitFrames(512);
    }
    EXPECT_EQ(host.status().slippedNs, 0);
    const auto before = host.plugin->takes().playOutFrames();
    std::atomic<std::int64_t> later{60'000'000'000}; // the clock has gone on, the thread has not come
    host.plugin->takes().driveByHand(later);
    for (int b = 0; b < 20; ++b) host.play(512, signal);
    host.plugin->takes().tick();
    host.play(512, signal);
    EXPECT_GT(host.status().slippedNs, 0);
    EXPECT_EQ(host.plugin->takes().playOutFrames(), before);
    host.plugin->releaseResources();
}

/// Blocks in time for so long.
void playInTime(PacedHost& host, double seconds, Samples& signal) {
    for (std::int64_t done = 0; done < static_cast<std::int64_t>(seconds * 48000); done += 512) {
        host.play(512, signal);
        host.waitFrames(512);
    }
}

/// The host does not come for so long, and makes up for it.
void stutter(PacedHost& host, int ms, Samples& signal) {
    host.wait(ms * 1'000'000);
    host.play(48 * ms / 512 * 512, signal);
}

TEST(PacedHost, AStutterLeavesLAsItIs) {
    PacedHost host{busy()};
    host.prepare(48000, 512, false);
    const int latency = host.plugin->getLatencySamples();
    Samples signal;
    playInTime(host, 1.0, signal);
    for (const int ms : {40, 80, 120, 160}) {
        stutter(host, ms, signal);
        playInTime(host, 1.2, signal);
        EXPECT_EQ(host.plugin->takes().playOutFrames(), latency) << ms;
    }
    EXPECT_GT(host.status().slippedNs, 0) << "counted";
    EXPECT_EQ(host.status().session.render.late, 0u);
}

/// When a note is felt that comes now: the first sample of its own.
std::int64_t delayOfNote(PacedHost& host) {
    juce::MidiBuffer midi;
    midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{127}), 0);
    std::int64_t waited = 0;
    for (auto* out = &host.block(512, midi); waited < 48000; waited += 512) {
        for (int n = 0; n < 512; ++n)
            if (out->getSample(0, n) != 0.0f) return waited + n;
        host.waitFrames(512);
        out = &host.block(512);
    }
    return -1;
}

TEST(PacedHost, StuttersThatComeAgainLengthenLUntilItIsCalm) {
    PacedHost host{strikeAt(0, 1)};
    host.prepare(48000, 512, false);
    const int latency = host.plugin->getLatencySamples();
    Samples signal;
    playInTime(host, 1.0, signal);
    for (int i = 0; i < 4; ++i) {
        stutter(host, 100, signal);
        playInTime(host, 0.3, signal);
    }
    const auto grown = host.plugin->takes().playOutFrames();
    EXPECT_GT(grown, latency);
    EXPECT_EQ(host.status().burstFrames, grown - latency);
    EXPECT_NEAR(static_cast<double>(delayOfNote(host)), static_cast<double>(grown), 2.0);
    playInTime(host, 4.0, signal);
    EXPECT_EQ(host.plugin->takes().playOutFrames(), latency);
    EXPECT_EQ(host.status().burstFrames, 0);
    EXPECT_NEAR(static_cast<double>(delayOfNote(host)), latency, 2.0) << "a key is felt as soon as before";
    host.prepare(48000, 512, false);
    EXPECT_EQ(host.plugin->getLatencySamples(), latency);
}

TEST(PacedHost, AHostThatWentAheadHasTheShortLAgainWhereItsTransportStands) {
    for (const bool byHand : {false, true}) {
        PacedHost host{strikeAt(0, 1)};
        host.prepare(48000, 512, false);
        const int latency = host.plugin->getLatencySamples();
        host.playHead.isThere = host.playHead.isPlaying = true;
        Samples signal;
        host.playBursts(96000, 512, [](int) { return 20; });
        const auto grown = host.plugin->takes().playOutFrames();
        EXPECT_GT(grown, latency);
        playInTime(host, 4.0, signal);
        EXPECT_EQ(host.plugin->takes().playOutFrames(), grown) << "while it plays";
        if (byHand)
            host.plugin->takes().giveBack();
        else
            host.playHead.isPlaying = false;
        playInTime(host, 1.0, signal);
        EXPECT_EQ(host.plugin->takes().playOutFrames(), latency);
        EXPECT_NEAR(static_cast<double>(delayOfNote(host)), latency, 2.0);
        host.prepare(48000, 512, false);
        EXPECT_EQ(host.plugin->getLatencySamples(), latency);
    }
}

TEST(PacedHost, WhatARunDidWithoutIsGivenBackAtTheNextStart) {
    PacedHost host{busy()};
    host.prepare(48000, 512, false);
    const int latency = host.plugin->getLatencySamples();
    Samples signal;
    host.playBursts(96000, 512, [](int) { return 20; });
    host.prepare(48000, 512, false);
    EXPECT_GT(host.plugin->getLatencySamples(), latency) << "it may do so again";
    playInTime(host, 4.0, signal);
    host.prepare(48000, 512, false);
    EXPECT_EQ(host.plugin->getLatencySamples(), latency);
}

TEST(PacedHost, RestartsInBurstsAreTheBounceToo) {
    auto state = busy();
    state.transport = TransportMode::restartOnPlay;
    PacedHost host{state};
    host.prepare(48000, 512, false);
    host.playHead.isThere = host.playHead.isPlaying = true;
    Samples signal;
    const int loop = 200; // blocks
    for (int take = 0; take < 4; ++take) {
        host.playHead.frame = 0;
        for (int b = 0; b < loop; b += 20) {
            host.play(20 * 512, signal);
            host.waitFrames(20 * 512);
        }
    }
    EXPECT_EQ(host.status().take, 4);
    EXPECT_EQ(host.status().delayedBlocks, 0u);
    EXPECT_EQ(host.status().slippedNs, 0);
    const auto latency = host.plugin->takes().playOutFrames();
    const auto bounce = bounced(busy(), 512, loop * 512);
    for (int take = 1; take < 3; ++take)
        for (std::size_t c = 0; c < 4; ++c) { // the one before fades in the first 10 ms
            const auto from = signal[c].begin() + latency + take * loop * 512;
            EXPECT_TRUE(std::equal(from + 480, from + loop * 512, bounce[c].begin() + 480)) << take;
        }
}

TEST(PacedHost, TheEditorSaysWhatItWaitedFor) {
    PacedHost host{busy()};
    host.prepare(48000, 512, false);
    const std::unique_ptr<PluginEditor> editor{
        dynamic_cast<PluginEditor*>(host.plugin->createEditorIfNeeded())};
    editor->refresh();
    EXPECT_FALSE(editor->statusText().contains("ahead"));
    host.playBursts(48000, 512, [](int) { return 20; });
    editor->refresh();
    EXPECT_TRUE(editor->statusText().contains("ahead")) << editor->statusText();
}

} // namespace
} // namespace physvib
