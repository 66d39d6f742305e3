// SPDX-License-Identifier: GPL-3.0-or-later
// Ten seconds of every preset of the plug-in, bounced, with a phrase that suits an instrument: NAME.wav (32
// bits, a channel for each actuator), NAME.csv (what was felt) and NAME.json (its layout). presets.sh draws
// them. Usage: physvib-plugin-presets FOLDER
#include "Io/Disk/AtomicFile.h"
#include "Io/Wav/WavSink.h"
#include "PlayedExport.h"
#include "PluginProcessor.h"
#include "PluginSettings.h"
#include "Scene/LayoutFile.h"
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace physvib;

constexpr int rateHz = 48000, block = 480, seconds = 10, blocks = rateHz / block * seconds;

/// A key every half second through the preset's notes, or two octaves, for 0.4 s; every fourth is bent and
/// slid.
juce::MidiBuffer phrase(const PluginState& state, int at) {
    constexpr int blocksPerNote = 50, heldBlocks = 40;
    juce::MidiBuffer midi;
    const int index = at / blocksPerNote, inNote = at % blocksPerNote;
    const auto rules = static_cast<int>(state.notes.size());
    const int note =
        rules > 0 ? state.notes[static_cast<std::size_t>(index % rules)].note : 48 + index * 5 % 24;
    if (inNote == 0)
        midi.addEvent(juce::MidiMessage::noteOn(1, note, static_cast<juce::uint8>(60 + index * 13 % 67)), 0);
    if (inNote == heldBlocks) midi.addEvent(juce::MidiMessage::noteOff(1, note), 0);
    if (index % 4 != 3 || inNote >= heldBlocks) return midi;
    const double turn = std::sin(2.0 * std::numbers::pi * inNote / heldBlocks);
    midi.addEvent(juce::MidiMessage::pitchWheel(1, 8192 + static_cast<int>(2000.0 * turn)), 1);
    midi.addEvent(juce::MidiMessage::controllerEvent(1, 74, 64 + static_cast<int>(50.0 * turn)), 1);
    return midi;
}

/// Two clicks a second, the first of four stronger: music for a preset of beats.
void addClicks(juce::AudioBuffer<float>& buffer, int at) {
    buffer.clear();
    if (at % 50 > 8) return;
    const double level = at / 50 % 4 == 0 ? 0.8 : 0.4;
    for (int n = 0; n < block; ++n) {
        const double t = static_cast<double>(at % 50 * block + n) / rateHz;
        for (int c = 0; c < 2; ++c)
            buffer.setSample(c, n,
                             static_cast<float>(level * std::exp(-40.0 * t) *
                                                std::sin(2.0 * std::numbers::pi * 90.0 * t)));
    }
}

bool render(const std::string& name, int program, const juce::File& folder) {
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, BusPlan::maxBusChannels}};
    auto layout = plugin.getBusesLayout();
    layout.inputBuses.getReference(0) = juce::AudioChannelSet::stereo();
    plugin.setBusesLayout(layout);
    auto state = plugin.state();
    applyBuiltInPreset(state, program);
    plugin.open(state);
    state = plugin.state();
    plugin.setNonRealtime(true);
    plugin.prepareToPlay(rateHz, block);
    const int channels = actuatorCount(state), latency = plugin.getLatencySamples();
    std::vector<std::vector<float>> signal(static_cast<std::size_t>(channels));
    juce::AudioBuffer<float> buffer{BusPlan::maxBusChannels, block};
    const bool isInstrument = state.scene.bodies.empty();
    for (int at = 0; at < blocks + latency / block + 1; ++at) {
        addClicks(buffer, at);
        auto midi = isInstrument && plugin.parameter(Parameter::beats).value() == 0.0 ? phrase(state, at)
                                                                                      : juce::MidiBuffer{};
        plugin.processBlock(buffer, midi);
        for (int c = 0; c < channels; ++c)
            signal[static_cast<std::size_t>(c)].insert(signal[static_cast<std::size_t>(c)].end(),
                                                       buffer.getReadPointer(c),
                                                       buffer.getReadPointer(c) + block);
    }
    plugin.drainEvents();
    const auto events = plugin.playedEvents().events(false);
    const auto path = [&](const char* ending) {
        return folder.getChildFile(juce::File::createLegalFileName(name).replaceCharacter(' ', '-') + ending)
            .getFullPathName()
            .toStdString();
    };
    const auto written =
        exportPlayed({events, state, makePanner(state, PanningLaw::linear, 1.0)}, path(".csv"));
    std::string error = written ? writeFile(path(".json"), layoutJson(state.layout)) : written.error;
    float peak = 0.0f;
    if (error.empty()) {
        std::vector<const float*> from;
        for (const auto& channel : signal) {
            from.push_back(channel.data() + latency);
            for (const float x : channel) peak = std::max(peak, std::abs(x));
        }
        WavSink wav{path(".wav"), channels, rateHz};
        wav.write(from.data(), rateHz * seconds);
        error = wav.finish();
    }
    if (!error.empty()) std::fprintf(stderr, "%s\n", error.c_str());
    // name, field, events, peak: presets.sh reads these
    std::printf("%s\t%g,%g\t%zu\t%.3f\n", juce::File{path("")}.getFileName().toRawUTF8(),
                state.scene.fieldWidthMetres, state.scene.fieldHeightMetres, events.size(), peak);
    return error.empty();
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const juce::ScopedJuceInitialiser_GUI juce;
    const juce::File folder{juce::File::getCurrentWorkingDirectory().getChildFile(argv[1])};
    if (folder.createDirectory().failed()) return 1;
    bool isDone = true;
    for (int program = 0; const auto& name : presetNames())
        isDone = render(name, program++, folder) && isDone;
    return isDone ? 0 : 1;
}
