// SPDX-License-Identifier: GPL-3.0-or-later
// A host that has a song at the side chain.
#pragma once
#include "PluginTesting.h"
#include "Support/BeatSong.h"
#include <atomic>

namespace physvib::test {

constexpr int songRateHz = 48000;

struct SongBlocks {
    int frames = 64;
    bool isLive = false;
    bool vary = false; ///< up to twice what was announced
};

inline PluginState quietState(bool isDirect = false) {
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
        layout.inputBuses.getReference(0) = channels == 0   ? juce::AudioChannelSet::disabled()
                                            : channels == 1 ? juce::AudioChannelSet::mono()
                                                            : juce::AudioChannelSet::stereo();
        ASSERT_TRUE(plugin->setBusesLayout(layout));
    }
    void listen(float readiness = 0.5f) { plugin->parameter(Parameter::beats).setValue(readiness); }

    /// One block of it, from frame `at` on; what is played is appended to `signal`.
    void feed(const BeatSong& song, int at, int frames, Samples& signal) {
        signal.resize(4);
        buffer.setSize(4, frames, false, false, true);
        // whatever stands in a host's buffer
        for (int c = 0; c < 4; ++c)
            buffer.copyFrom(c, 0, (c == 1 && right ? right->samples : song.samples).data() + at, frames);
        auto midi = notes(at, frames);
        plugin->processBlock(buffer, midi);
        append(signal, buffer);
    }

    /// What is played of all of it.
    Samples play(const BeatSong& song, SongBlocks blocks) {
        if (blocks.isLive) plugin->takes().driveByHand();
        prepare(songRateHz, blocks.frames, !blocks.isLive);
        Samples signal;
        Random random{3};
        const int length = static_cast<int>(song.samples.size());
        for (int at = 0; at < length;) {
            const int frames =
                std::min(blocks.vary ? 1 + random.below(2 * blocks.frames) : blocks.frames, length - at);
            feed(song, at, frames, signal);
            at += frames;
            if (!blocks.isLive) continue;
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

    const BeatSong* right = nullptr; ///< of the second channel, if it is another; as long
    bool hasNotes = false;           ///< and a controller that moves what beats are struck with

private:
    juce::MidiBuffer notes(int at, int frames) const {
        juce::MidiBuffer midi;
        for (int i = 0; i < frames && hasNotes; ++i) {
            if ((at + i) % 4999 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{100}), i);
            if ((at + i) % 7001 == 0)
                midi.addEvent(juce::MidiMessage::controllerEvent(1, 1, (at + i) / 7001 % 30 + 90), i);
        }
        return midi;
    }
};

} // namespace physvib::test
