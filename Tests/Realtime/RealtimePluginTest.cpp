// SPDX-License-Identifier: GPL-3.0-or-later
// processBlock under guard: every parameter, every MIDI message, transport, bypass, each width, while another
// thread changes the settings.
#include "Plugin/PluginTesting.h"
#include "Realtime/RealtimeGuard.h"
#include <atomic>

namespace physvib {
namespace {

using namespace test;

juce::MidiBuffer randomMidi(Random& random, int frames) {
    juce::MidiBuffer midi;
    for (int i = random.below(6); i > 0; --i) {
        const juce::uint8 status = static_cast<juce::uint8>(0x80 + random.below(0x70));
        const juce::uint8 bytes[3]{status, static_cast<juce::uint8>(random.below(128)),
                                   static_cast<juce::uint8>(random.below(128))};
        const bool isShort = (status & 0xf0) == 0xc0 || (status & 0xf0) == 0xd0;
        midi.addEvent(bytes, isShort ? 2 : 3, random.below(frames));
    }
    return midi;
}

void expectNothingForbidden(BusPlan plan) {
    TestHost host{plan};
    Random random{7};
    auto& plugin = *host.plugin;
    auto layout = plugin.getBusesLayout();
    layout.inputBuses.getReference(0) = juce::AudioChannelSet::stereo();
    ASSERT_TRUE(plugin.setBusesLayout(layout));
    for (const auto mode : {TransportMode::free, TransportMode::restartOnPlay}) {
        auto settings = plugin.state();
        settings.transport = mode;
        settings.controllers = {{1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}, {20, "bypass"}};
        plugin.apply(settings);
        plugin.takes().driveByHand(); // so the worlds are in time, as a live host finds them
        host.prepare(48000, 64, false);
        host.playHead.isThere = true;
        std::atomic<bool> stop{false};
        std::thread message{[&] { // the message thread, and hosts that set states from elsewhere
            for (int i = 0; !stop; ++i) {
                auto other = plugin.state();
                other.seed = static_cast<std::uint32_t>(i);
                other.layout = presetLayout(i % 2 ? "phone4" : "phone2");
                plugin.apply(other);
                std::this_thread::sleep_for(std::chrono::milliseconds{20});
            }
        }};
        RealtimeGuard::forget();
        for (int b = 0; b < 20'000; ++b) {
            const int frames = 1 + random.below(100); // also more than announced
            auto midi = randomMidi(random, frames);
            if (random.below(50) == 0) host.playHead.isPlaying = !host.playHead.isPlaying;
            if (random.below(90) == 0) host.playHead.frame = random.below(100'000);
            host.buffer.setSize(host.buffer.getNumChannels(), frames, false, false, true);
            // a stroke at the side chain
            for (int i = 0; i < frames && b % 100 < 3; ++i)
                host.buffer.setSample(0, i, static_cast<float>(random.uniform(-1, 1)));
            // but Timing: tight is in the call, locks and all
            int index = random.below(static_cast<int>(parameterCount) - 1);
            if (index >= static_cast<int>(Parameter::timing)) ++index;
            auto* parameter = plugin.getParameters()[index];
            const bool bypassed = random.below(100) == 0;
            {
                const RealtimeGuard guard;
                parameter->setValue(static_cast<float>(random.uniform(0, 1)));
                if (bypassed)
                    plugin.processBlockBypassed(host.buffer, midi);
                else
                    plugin.processBlock(host.buffer, midi);
            }
            host.playHead.frame += host.playHead.isPlaying ? frames : 0;
            plugin.takes().tick();
            if (b % 256 == 0) std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        stop = true;
        message.join();
        for (std::size_t i = 0; i < RealtimeGuard::offenceCount; ++i)
            EXPECT_EQ(RealtimeGuard::count(static_cast<RealtimeGuard::Offence>(i)), 0u)
                << RealtimeGuard::names[i];
        EXPECT_GT(plugin.takes().status().take, 1) << "settings arrived";
    }
}

TEST(RealtimePlugin, OneBus) {
    for (const int width : {1, 2, 4, 16}) expectNothingForbidden({BusPlan::Kind::oneBus, width});
}

// What hosts and validators ask of parameters from any thread, the message thread among them: no lock can
// hold them up.
TEST(RealtimePlugin, ParametersAnswerWithoutALock) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    host.prepare(48000, 512, false);
    RealtimeGuard::forget();
    for (auto* parameter : host.plugin->getParameters()) {
        const RealtimeGuard guard;
        const float value = parameter->getValue() + parameter->getDefaultValue();
        const auto words = parameter->getName(512) + parameter->getLabel() + parameter->getText(value, 1024) +
                           parameter->getCurrentValueAsText();
        parameter->setValue(parameter->getValueForText(words));
    }
    EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::locks), 0u);
    EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::waits), 0u);
}

// Worlds that are stepped in the call: every one that comes with it, with notes, shaken and turned.
TEST(RealtimePlugin, TightTakesNoMemory) {
    for (int preset = 0; preset < static_cast<int>(builtInScenes().size()); ++preset) {
        TestHost host;
        host.plugin->setCurrentProgram(preset);
        host.plugin->parameter(Parameter::timing).setValue(1.0f);
        host.prepare(48000, 64, false);
        Random random{3};
        RealtimeGuard::forget();
        for (int b = 0; b < 4 * 750; ++b) {
            auto midi = randomMidi(random, 64);
            for (int n = 0; n < 1000 && b % 400 == 300; ++n)
                midi.addEvent(juce::MidiMessage::noteOn(1, n % 128, juce::uint8{90}), n % 64);
            const RealtimeGuard guard;
            host.plugin->parameter(Parameter::tilt).setValue(static_cast<float>(random.uniform(0, 1)));
            host.plugin->processBlock(host.buffer, midi);
        }
        for (const auto which : {RealtimeGuard::allocates, RealtimeGuard::frees})
            EXPECT_EQ(RealtimeGuard::count(which), 0u)
                << RealtimeGuard::names[which] << ' ' << host.plugin->getProgramName(preset);
        EXPECT_GT(host.plugin->drainEvents().size(), 10u) << host.plugin->getProgramName(preset);
    }
}

TEST(RealtimePlugin, ManyBuses) { expectNothingForbidden({BusPlan::Kind::manyBuses}); }

} // namespace
} // namespace physvib
