// SPDX-License-Identifier: GPL-3.0-or-later
// processBlock under guard: every parameter, every MIDI message, transport, bypass, each width, while another
// thread changes the settings.
#include "Plugin/PluginTesting.h"
#include "Realtime/RealtimeGuard.h"
#include <atomic>

namespace physvib::realtime_plugin_test {

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
    for (const auto mode : {TransportMode::free, TransportMode::restartOnPlay, TransportMode::inTempo}) {
        auto settings = plugin.state();
        settings.transport = mode;
        settings.controllers = {{1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}, {20, "bypass"}};
        plugin.apply(settings);
        plugin.runs().useManualStepping(); // so the worlds are in time, as a live host finds them
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
            if (random.below(90) == 0) host.playHead.perMinute = random.uniform(0, 200);
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
            plugin.runs().tick();
            if (b % 256 == 0) std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        stop = true;
        message.join();
        for (std::size_t i = 0; i < RealtimeGuard::offenceCount; ++i)
            EXPECT_EQ(RealtimeGuard::count(static_cast<RealtimeGuard::Offence>(i)), 0u)
                << RealtimeGuard::names[i];
        EXPECT_GT(plugin.runs().status().runNumber, 1) << "settings arrived";
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
        std::printf("Timing tight: %d pieces of memory taken in 3,000 render calls, %s\n",
                    static_cast<int>(RealtimeGuard::count(RealtimeGuard::allocates)),
                    host.plugin->getProgramName(preset).toRawUTF8());
    }
}

/// One call of a host in no sensible order, from `random`; blocks that are realtime are guarded.
void callOddly(TestHost& host, Random& random, std::vector<juce::MemoryBlock>& chunks) {
    auto& plugin = *host.plugin;
    const auto one = [&random]<class T>(std::initializer_list<T> of) {
        return of.begin()[random.below(static_cast<int>(of.size()))];
    };
    switch (random.below(9)) {
    case 0:
        return host.prepare(one({8'000.0, 44'100.0, 48'000.0, 96'000.0, 192'000.0, 3'000.0}),
                            one({1, 32, 480, 1'024, 8'192}), random.below(2) == 0);
    case 1: return plugin.releaseResources();
    case 2: return plugin.getStateInformation(chunks.emplace_back());
    case 3: {
        auto chunk = chunks[static_cast<std::size_t>(random.below(static_cast<int>(chunks.size())))];
        if (random.below(4) == 0) chunk.setSize(chunk.getSize() / 2); // broken
        return plugin.setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
    }
    case 4: return plugin.setCurrentProgram(random.below(plugin.getNumPrograms()));
    case 5: {
        auto layout = plugin.getBusesLayout();
        layout.outputBuses.getReference(0) = juce::AudioChannelSet::discreteChannels(one({1, 2, 4, 8, 16}));
        plugin.releaseResources();
        plugin.setBusesLayout(layout);
        return;
    }
    case 6:
        host.playHead.isThere = random.below(4) > 0;
        host.playHead.isPlaying = random.below(2) > 0;
        host.playHead.frame = random.below(100'000);
        host.playHead.perMinute = one({0.0, 1.0, 90.0, 120.0, 999.0});
        return;
    case 7: return plugin.setNonRealtime(random.below(2) > 0);
    default: break;
    }
    auto& buffer = host.buffer;
    for (int b = random.below(20); b >= 0; --b) {
        const int frames = one({0, 1, 31, 480, 700, 1'500});
        auto midi = randomMidi(random, std::max(1, frames));
        const int channels =
            std::max({1, plugin.getTotalNumInputChannels(), plugin.getTotalNumOutputChannels()});
        buffer.setSize(channels, frames, false, true, true);
        const bool isBypassed = random.below(8) == 0;
        const auto play = [&] {
            isBypassed ? plugin.processBlockBypassed(buffer, midi) : plugin.processBlock(buffer, midi);
        };
        if (plugin.isNonRealtime()) {
            play();
        } else {
            const RealtimeGuard guard;
            play();
        }
        if (host.playHead.isPlaying) host.playHead.move(frames, std::max(1.0, plugin.getSampleRate()));
        plugin.runs().tick();
    }
}

/// Half a second of notes, offline, as prepared, in blocks that `seed` chooses.
Samples playedWith(TestHost& host, std::uint32_t seed) {
    host.playHead = {};
    host.playHead.isThere = host.playHead.isPlaying = true;
    host.playHead.perMinute = 133.0;
    Random random{seed};
    Samples all(static_cast<std::size_t>(host.buffer.getNumChannels()));
    for (int done = 0; done < 24'000;) {
        const int frames = 1 + random.below(900);
        const auto& out = host.block(frames, randomMidi(random, frames));
        for (std::size_t c = 0; c < all.size(); ++c)
            all[c].insert(all[c].end(), out.getReadPointer(static_cast<int>(c)),
                          out.getReadPointer(static_cast<int>(c)) + frames);
        done += frames;
    }
    return all;
}

TEST(RealtimePlugin, AfterCallsInAnyOrderAnInstanceIsAsAFreshOneAndNoBlockTookMemory) {
    float felt = 0.0f;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        TestHost host, fresh;
        Random random{seed};
        std::vector<juce::MemoryBlock> chunks(1);
        host.plugin->getStateInformation(chunks.front());
        host.plugin->runs().useManualStepping();
        RealtimeGuard::forget();
        for (int call = 0; call < 60; ++call) callOddly(host, random, chunks);
        for (const auto which : {RealtimeGuard::allocates, RealtimeGuard::frees})
            EXPECT_EQ(RealtimeGuard::count(which), 0u) << RealtimeGuard::names[which] << ", seed " << seed;
        const double rateHz = seed % 2 == 0 ? 48'000 : 22'050;
        if (host.plugin->hasRefusedChunk()) // which a save gives back
            host.plugin->setStateInformation(chunks[0].getData(), static_cast<int>(chunks[0].getSize()));
        host.prepare(rateHz, 480);
        juce::MemoryBlock state;
        host.plugin->getStateInformation(state);
        ASSERT_TRUE(fresh.plugin->setBusesLayout(host.plugin->getBusesLayout()));
        fresh.plugin->setStateInformation(state.getData(), static_cast<int>(state.getSize()));
        fresh.prepare(rateHz, 480);
        const auto played = playedWith(host, seed);
        felt = std::max(felt, peakOf(played));
        EXPECT_TRUE(played == playedWith(fresh, seed)) << "seed " << seed;
    }
    EXPECT_GT(felt, 0.05f);
}

TEST(RealtimePlugin, ManyBuses) { expectNothingForbidden({BusPlan::Kind::manyBuses}); }

} // namespace physvib::realtime_plugin_test
