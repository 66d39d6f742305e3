// SPDX-License-Identifier: GPL-3.0-or-later
// What automation says last is what is felt: however much of it there is, and however far the host's blocks
// are from what it told.
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;
using Message = juce::MidiMessage;

/// Enchanters in a line of an empty world, in blocks that are much smaller than announced: L is long,
/// controls are many.
struct AutomatedHost : TestHost {
    AutomatedHost(int channels, double rate, int size)
        : frames{size} {
        auto state = strikeAt(0, channels);
        state.notes.front().x = 0.25 / (channels - 1);
        state.controllers = {{7, "level"}};
        EXPECT_TRUE(plugin->apply(state));
        prepare(rate, 8192);
        latency = plugin->getLatencySamples();
    }
    void automate(Parameter which, int blocks) {
        for (int i = 0; i < blocks; ++i) {
            plugin->parameter(which).setValue(0.3f + 0.5f * static_cast<float>(i % 101) / 101.0f);
            block(frames);
        }
    }
    void strike() { block(frames, oneNote(60)); }
    /// The loudest sample of the next `count` frames.
    float peakOfNext(std::int64_t count) {
        float peak = 0.0f;
        for (std::int64_t done = 0; done < count; done += frames)
            peak = std::max(peak, block(frames).getMagnitude(0, frames));
        return peak;
    }
    /// The loudest sample of what is struck now, L later.
    float peakOfStrike() {
        peakOfNext(latency + static_cast<std::int64_t>(getRate() / 50)); // what was before is over, and ramps
        strike();
        peakOfNext(latency - 2 * frames);
        return peakOfNext(static_cast<std::int64_t>(getRate() / 10));
    }
    double getRate() const { return plugin->getSampleRate(); }
    int frames, latency = 0;
};

struct AutomationCase {
    int channels, frames, blocks;
    double rate;
};

class LevelAutomation : public testing::TestWithParam<AutomationCase> {};

TEST_P(LevelAutomation, EndsAtItsLastValue) {
    const auto [channels, frames, blocks, rate] = GetParam();
    AutomatedHost host{channels, rate, frames};
    host.automate(Parameter::level, blocks);
    host.plugin->parameter(Parameter::level).setValue(0.0f);
    EXPECT_EQ(host.peakOfStrike(), 0.0f);
    host.automate(Parameter::level, blocks);
    host.plugin->parameter(Parameter::level).setValue(1.0f);
    EXPECT_GT(host.peakOfStrike(), 0.1f);
}

INSTANTIATE_TEST_SUITE_P(Hosts, LevelAutomation,
                         testing::Values(AutomationCase{4, 64, 400, 48000.0},
                                         AutomationCase{64, 64, 400, 48000.0},
                                         AutomationCase{4, 1, 12000, 48000.0},
                                         AutomationCase{4, 64, 10 * 60 * 8000 / 64, 8000.0}), // ten minutes
                         [](const auto& info) {
                             return std::to_string(info.param.channels) + "x" +
                                    std::to_string(info.param.blocks) + "of" +
                                    std::to_string(info.param.frames);
                         });

TEST(Controls, ALawThatIsAutomatedEndsAtItsLastValue) {
    AutomatedHost host{2, 48000.0, 16};
    host.automate(Parameter::exponent, 1500);
    host.plugin->parameter(Parameter::exponent).setValue(0.0f);
    const float low = host.peakOfStrike();
    AutomatedHost plain{2, 48000.0, 16};
    plain.plugin->parameter(Parameter::exponent).setValue(0.0f);
    EXPECT_NEAR(low, plain.peakOfStrike(), 1e-6f);
    plain.plugin->parameter(Parameter::exponent).setValue(1.0f);
    EXPECT_GT(std::abs(low - plain.peakOfStrike()), 1e-3f);
}

TEST(Controls, AControllerThatMovesAtEveryFrameEndsAtItsLastValueWithinTheBlock) {
    AutomatedHost host{4, 48000.0, 8192};
    juce::MidiBuffer midi;
    for (int n = 0; n < 4000; ++n) midi.addEvent(Message::controllerEvent(1, 7, n % 127 + 1), n);
    midi.addEvent(Message::controllerEvent(1, 7, 0), 4000);
    midi.addEvent(Message::noteOn(1, 60, juce::uint8{127}), 5000);
    host.block(8192, midi);
    EXPECT_EQ(host.peakOfNext(host.latency + 8192), 0.0f);
}

TEST(Controls, AllSoundOffBehindMuchAutomationIsNotLost) {
    AutomatedHost host{64, 48000.0, 64};
    host.peakOfNext(host.latency);
    host.strike();
    host.automate(Parameter::level, 100);
    juce::MidiBuffer midi;
    midi.addEvent(Message::allSoundOff(1), 0);
    host.block(64, midi);
    host.automate(Parameter::level, host.latency / 64);
    host.peakOfNext(480);
    EXPECT_EQ(host.peakOfNext(4800), 0.0f);
}

} // namespace
} // namespace physvib
