// SPDX-License-Identifier: GPL-3.0-or-later
// A host for the processor without a plug-in format: blocks, MIDI and a transport, in virtual time.
#pragma once
#include "Host/MessageManagerForTests.h"
#include "PluginProcessor.h"
#include "PluginSettings.h"
#include "Scene/SceneFile.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <span>
#include <thread>
#include <vector>

namespace physvib::test {

/// Of the built-in preset with that name.
inline int presetPlace(std::string_view name) {
    return static_cast<int>(std::ranges::find(presetNames(), name) - presetNames().begin());
}
inline PluginState presetNamed(std::string_view name, int outputs = 4) {
    PluginState state = newPluginState(outputs); // whose layout a world keeps or arranges anew
    applyBuiltInPreset(state, presetPlace(name), outputs);
    return state;
}

/// `Editor`: PluginEditor, where that is included.
template <class Editor>
std::unique_ptr<Editor> openEditor(PluginProcessor& plugin) {
    return std::unique_ptr<Editor>{dynamic_cast<Editor*>(plugin.createEditorIfNeeded())};
}

struct TestPlayHead final : juce::AudioPlayHead {
    juce::Optional<PositionInfo> getPosition() const override {
        if (!isThere) return {};
        PositionInfo info;
        info.setIsPlaying(isPlaying);
        info.setTimeInSamples(frame);
        if (perMinute > 0.0) {
            info.setBpm(perMinute);
            info.setPpqPosition(quarter);
        }
        return info;
    }
    void move(int frames, double rateHz) {
        frame += frames;
        quarter += perMinute / 60.0 * frames / rateHz;
    }
    bool isThere = false, isPlaying = false;
    std::int64_t frame = 0;
    double perMinute = 0.0, quarter = 0.0; // 0: no tempo is told
};

/// What automation moves together: ten, each continuous.
constexpr std::array automatedTogether{Parameter::level,        Parameter::exponent,    Parameter::gravity,
                                       Parameter::tilt,         Parameter::strikeLevel, Parameter::strikeX,
                                       Parameter::strikeY,      Parameter::decay,       Parameter::release,
                                       Parameter::velocityCurve};

using Samples = std::vector<std::vector<float>>; // [channel][frame]

/// Behind it, what was played now; of as many channels, if it has any.
inline void append(Samples& signal, const juce::AudioBuffer<float>& played) {
    if (signal.empty()) signal.resize(static_cast<std::size_t>(played.getNumChannels()));
    for (std::size_t c = 0; c < signal.size(); ++c) {
        const float* const from = played.getReadPointer(static_cast<int>(c));
        signal[c].insert(signal[c].end(), from, from + played.getNumSamples());
    }
}

/// `signal` without its first `frames` frames.
inline Samples later(const Samples& signal, std::int64_t frames) {
    Samples rest;
    for (const auto& channel : signal) rest.emplace_back(channel.begin() + frames, channel.end());
    return rest;
}

inline juce::MidiBuffer oneMessage(const juce::MidiMessage& message, int frame = 0) {
    juce::MidiBuffer midi;
    midi.addEvent(message, frame);
    return midi;
}
inline juce::MidiBuffer oneNote(int note, int velocity = 127, int frame = 0) {
    return oneMessage(juce::MidiMessage::noteOn(1, note, static_cast<juce::uint8>(velocity)), frame);
}

/// The largest change from one sample to the next.
inline float largestStep(std::span<const float> signal) {
    float step = 0.0f;
    for (std::size_t n = 1; n < signal.size(); ++n)
        step = std::max(step, std::abs(signal[n] - signal[n - 1]));
    return step;
}

/// A side chain of so many channels, 0 to 2.
inline bool setSideChain(juce::AudioProcessor& plugin, int channels) {
    auto layout = plugin.getBusesLayout();
    layout.inputBuses.getReference(0) = channels == 0   ? juce::AudioChannelSet::disabled()
                                        : channels == 1 ? juce::AudioChannelSet::mono()
                                                        : juce::AudioChannelSet::stereo();
    return plugin.setBusesLayout(layout);
}

/// Ready for blocks of that size, and a buffer for them.
inline juce::AudioBuffer<float> prepareBlocks(juce::AudioProcessor& plugin, int block,
                                              double rate = 48000.0) {
    plugin.setRateAndBufferSizeDetails(rate, block);
    plugin.prepareToPlay(rate, block);
    return {std::max({1, plugin.getTotalNumInputChannels(), plugin.getTotalNumOutputChannels()}), block};
}

/// What a host saves, and what it gives back.
inline juce::MemoryBlock chunkOf(juce::AudioProcessor& plugin) {
    juce::MemoryBlock chunk;
    plugin.getStateInformation(chunk);
    return chunk;
}
template <class Bytes>
void restore(juce::AudioProcessor& plugin, const Bytes& chunk) {
    plugin.setStateInformation(std::data(chunk), static_cast<int>(std::size(chunk)));
}
inline void restore(juce::AudioProcessor& plugin, const juce::MemoryBlock& chunk) {
    plugin.setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
}

/// As instances began before notes had a voice: "shake the box" on four enchanters, running free.
inline PluginState shakenBox() {
    PluginState state;
    state.scene = builtInScenes().front();
    state.layout = presetLayout("phone4");
    return state;
}

/// The same without anything in it.
inline PluginState emptyBox() {
    PluginState state = shakenBox();
    state.scene.bodies.clear();
    state.scene.joints.clear();
    state.scene.script.clear();
    return state;
}

class TestHost {
public:
    explicit TestHost(BusPlan plan = {}) {
        plugin = std::make_unique<PluginProcessor>("PhysVib", plan);
        plugin->setPlayHead(&playHead);
        EXPECT_TRUE(plugin->apply(shakenBox()));
        for (const auto& row : allParameters()) set(row.parameter, row.initial);
        setNormal(Parameter::level, 1.0f);                // 0 dB, to compare with renders
        setNormal(Parameter::strikeLevel, 54.0f / 72.0f); // -6 dB
    }
    explicit TestHost(const PluginState& state)
        : TestHost{} {
        EXPECT_TRUE(plugin->apply(state)) << plugin->errorText();
    }
    /// Prepared at 48 kHz for blocks of that size.
    TestHost(const PluginState& state, int block, bool offline = true)
        : TestHost{state} {
        prepare(48000, block, offline);
    }
    ~TestHost() { plugin->setPlayHead(nullptr); }

    void prepare(double rate, int block, bool offline = true) {
        largest = block;
        plugin->setNonRealtime(offline);
        buffer = prepareBlocks(*plugin, block, rate);
    }

    /// As a host moves it: from 0 to 1, in its unit, to its default.
    void setNormal(Parameter which, float normal) { plugin->parameter(which).setValue(normal); }
    void set(Parameter which, double value) {
        setNormal(which, static_cast<float>(normalised(rowOf(which), value)));
    }
    void setToDefault(Parameter which) { set(which, rowOf(which).initial); }

    /// One block of any size; what it played.
    juce::AudioBuffer<float>& block(int frames, juce::MidiBuffer midi = {}) {
        buffer.setSize(buffer.getNumChannels(), frames, false, false, true);
        plugin->processBlock(buffer, midi);
        if (playHead.isPlaying) playHead.move(frames, plugin->getSampleRate());
        return buffer;
    }

    /// `frames` frames in blocks of the prepared size, appended to `signal`.
    void play(std::int64_t frames, Samples& signal) {
        for (std::int64_t done = 0; done < frames; done += largest)
            append(signal, block(static_cast<int>(std::min<std::int64_t>(largest, frames - done))));
    }

    Samples played(std::int64_t frames) {
        Samples signal;
        play(frames, signal);
        return signal;
    }

    /// The same with the latency taken out.
    Samples felt(std::int64_t frames) {
        const int latency = plugin->getLatencySamples();
        return later(played(frames + latency), latency);
    }

    TestPlayHead playHead; // outlives the plug-in
    std::unique_ptr<PluginProcessor> plugin;
    juce::AudioBuffer<float> buffer;
    int largest = 0;
};

/// What a host is told of an instance.
struct HostNews final : juce::AudioProcessorListener {
    explicit HostNews(PluginProcessor& about)
        : plugin{about} {
        plugin.addListener(this);
    }
    ~HostNews() override { plugin.removeListener(this); }
    void audioProcessorParameterChanged(juce::AudioProcessor*, int, float) override { ++parameters; }
    void audioProcessorChanged(juce::AudioProcessor*, const ChangeDetails& details) override {
        latencies += details.latencyChanged ? 1 : 0;
        edits += details.nonParameterStateChanged ? 1 : 0;
        programs += details.programChanged ? 1 : 0;
    }
    PluginProcessor& plugin;
    std::atomic<int> parameters{0}, latencies{0}, edits{0}, programs{0};
};

/// Many discs in one place, each touching each: steps that take long.
inline PluginState heap(int discs) {
    PluginState state = emptyBox();
    Scene& scene = state.scene;
    for (int i = 0; i < discs; ++i) {
        BodyDescription& body = scene.bodies.emplace_back();
        body.name = "disc " + std::to_string(i);
        body.positionMetres = {scene.fieldWidthMetres / 2, scene.fieldHeightMetres / 2};
        body.fixtures.push_back({CircleShape{0.2}, {}, 0.0, 3, true});
    }
    return state;
}

/// Nothing but n enchanters in a line; note 60 strikes at enchanter j.
inline PluginState strikeAt(int j, int n) {
    PluginState s = emptyBox();
    ActuatorLayout line{n > 1 ? n - 1.0 : 1.0, 1.0, n, {}};
    for (int i = 0; i < n; ++i) line.places[static_cast<std::size_t>(i)] = {static_cast<double>(i), 0.0};
    s.layout = describeLayout("line", line);
    // the first material that vibrates
    s.notes = {{.note = 60, .material = 3, .x = n > 1 ? j / (n - 1.0) : 0.0, .y = 0.0}};
    return s;
}

inline float peakOf(const Samples& signal) {
    float peak = 0;
    for (const auto& channel : signal)
        for (const float x : channel) peak = std::max(peak, std::abs(x));
    return peak;
}

/// The first component below `in` that is a Kind and `is`; null if there is none.
template <class Kind, class Is>
Kind* below(juce::Component& in, const Is& is) {
    for (auto* child : in.getChildren()) {
        if (auto* const one = dynamic_cast<Kind*>(child); one && is(*one)) return one;
        if (auto* const found = below<Kind>(*child, is)) return found;
    }
    return nullptr;
}

inline juce::Button* buttonOf(juce::Component& in, const juce::String& words) {
    return below<juce::Button>(in, [&](const auto& button) { return button.getButtonText() == words; });
}

} // namespace physvib::test
