// SPDX-License-Identifier: GPL-3.0-or-later
// What a plug-in of that width plays when the transport starts at 0 (restart on play), one enchanter a
// channel in a line, and the pattern of notes, as a host that is not in real time gets it: raw interleaved
// floats on stdout. The folder gets the state for other hosts: state.lv2 (a preset) and state.vstpreset.
// A file NOTES of lines FRAME NOTE VELOCITY takes the pattern's place.
// Usage: physvib-plugin-bounce CHANNELS SECONDS BLOCK_FRAMES FOLDER [NOTES]
#include "Live/NotePattern.h"
#include "Plugin/Formats/HostStates.h"
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace {

using namespace physvib;

PluginState inALine(PluginState state, int enchanters) {
    ActuatorLayout line{enchanters - 1.0, 1.0, enchanters, {}};
    for (int j = 0; j < enchanters; ++j)
        line.places[static_cast<std::size_t>(j)] = {static_cast<double>(j), 0.5};
    state.layout = describeLayout("line", line);
    state.transport = TransportMode::restartOnPlay;
    return state;
}

/// Those before that frame, in the order of time; of a file, or of the pattern.
std::vector<test::PatternNote> notesBefore(std::int64_t frames, const char* path) {
    std::vector<test::PatternNote> notes;
    if (!path)
        for (int k = 0; test::patternNote(k).frame < frames; ++k) notes.push_back(test::patternNote(k));
    std::ifstream file{path ? path : ""};
    for (int frame = 0, note = 0, velocity = 0; file >> frame >> note >> velocity;)
        notes.push_back({frame, static_cast<std::uint8_t>(note), static_cast<std::uint8_t>(velocity)});
    return notes;
}

/// Those in [frame, frame + frames), from `next` on.
juce::MidiBuffer notesOf(const std::vector<test::PatternNote>& notes, std::int64_t frame, int frames,
                         std::size_t& next) {
    juce::MidiBuffer midi;
    for (; next < notes.size() && notes[next].frame < frame + frames; ++next)
        midi.addEvent(juce::MidiMessage::noteOn(1, notes[next].note, notes[next].velocity),
                      static_cast<int>(notes[next].frame - frame));
    return midi;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 5 || argc > 6) return 2;
    const int channels = std::atoi(argv[1]), block = std::atoi(argv[3]);
    const juce::File folder{argv[4]};
    const juce::ScopedJuceInitialiser_GUI juce;
    test::Rolling transport;
    const juce::String uri =
        "urn:physvib:plugin" + (channels == 4 ? juce::String{} : ":" + juce::String{channels});
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, channels}};
    if (!plugin.apply(inALine(plugin.state(), channels))) return 1;
    juce::MemoryBlock chunk;
    plugin.getStateInformation(chunk);
    if (!test::writeLv2Preset(chunk, uri, folder.getChildFile("state.lv2"))) return 1;
    if (!test::writeVst3Preset(chunk, "Phyp", folder.getChildFile("state.vstpreset"))) return 1;
    plugin.setPlayHead(&transport);
    plugin.setNonRealtime(true);
    plugin.prepareToPlay(48000.0, block);
    juce::AudioBuffer<float> buffer(channels, block);
    const auto frames = static_cast<std::int64_t>(std::atof(argv[2]) * 48000.0);
    const auto notes = notesBefore(frames, argv[5]); // null where there is none
    for (std::size_t next = 0; transport.frame < frames; transport.frame += block) {
        auto midi = notesOf(notes, transport.frame, block, next);
        plugin.processBlock(buffer, midi);
        for (int n = 0; n < block; ++n)
            for (int c = 0; c < channels; ++c) {
                const float x = buffer.getSample(c, n);
                if (std::fwrite(&x, sizeof x, 1, stdout) != 1) return 1;
            }
    }
    plugin.setPlayHead(nullptr);
    return 0;
}
