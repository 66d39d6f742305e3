// SPDX-License-Identifier: GPL-3.0-or-later
// What a plug-in of that width plays when the transport starts at 0 (restart on play), one enchanter a channel in a
// line, and the pattern of notes, as a host that is not in real time gets it: raw interleaved floats on
// stdout. The folder gets the state for other hosts: state.lv2 (a preset) and state.vstpreset.
// Usage: physvib-plugin-bounce CHANNELS SECONDS BLOCK_FRAMES FOLDER
#include "Live/NotePattern.h"
#include "PluginProcessor.h"
#include <cstdio>
#include <cstdlib>

namespace {

using namespace physvib;

PluginState inALine(PluginState state, int enchanters) {
    EnchanterLayout line{enchanters - 1.0, 1.0, enchanters, {}};
    for (int j = 0; j < enchanters; ++j) line.places[static_cast<std::size_t>(j)] = {static_cast<double>(j), 0.5};
    state.layout = describeLayout("line", line);
    state.transport = TransportMode::restartOnPlay;
    return state;
}

bool writeText(const juce::File& file, const juce::String& text) { return file.replaceWithText(text, false, false, "\n"); }

bool writeLv2Preset(const juce::MemoryBlock& chunk, int channels, const juce::File& folder) {
    const juce::String uri = channels == 4 ? "urn:physvib:plugin" : "urn:physvib:plugin:" + juce::String{channels};
    const juce::String prefixes = "@prefix lv2: <http://lv2plug.in/ns/lv2core#> .\n@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                                  "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n@prefix state: <http://lv2plug.in/ns/ext/state#> .\n\n";
    const juce::String preset = "\ta pset:Preset ;\n\tlv2:appliesTo <" + uri + "> ;\n\trdfs:label \"state\" ;\n";
    return folder.createDirectory().wasOk() && writeText(folder.getChildFile("manifest.ttl"), prefixes + "<state.ttl>\n" + preset + "\trdfs:seeAlso <state.ttl> .\n") &&
           writeText(folder.getChildFile("state.ttl"), prefixes + "<>\n" + preset + "\tstate:state [ <" + uri + ":StateString> \"\"\"" + chunk.toBase64Encoding() + "\"\"\" ] .\n");
}

// "VST 3 Preset File Format": a head, the chunk of the component, and a list of chunks. The class, here that of the module
// of pairs, is named by JUCE's prefix and our two codes.
bool writeVst3Preset(const juce::MemoryBlock& chunk, const juce::File& file) {
    constexpr int headBytes = 4 + 4 + 32 + 8;
    juce::MemoryOutputStream out;
    out << "VST3";
    out.writeInt(1);
    out << "ABCDEF019182FAEB" << juce::String::toHexString("PhVbPhyp", 8, 0).toUpperCase();
    out.writeInt64(headBytes + static_cast<juce::int64>(chunk.getSize()));
    out.write(chunk.getData(), chunk.getSize());
    out << "List";
    out.writeInt(1);
    out << "Comp";
    out.writeInt64(headBytes);
    out.writeInt64(static_cast<juce::int64>(chunk.getSize()));
    return file.replaceWithData(out.getData(), out.getDataSize());
}

struct Rolling final : juce::AudioPlayHead {
    juce::Optional<PositionInfo> getPosition() const override {
        PositionInfo info;
        info.setIsPlaying(true);
        info.setTimeInSamples(frame);
        return info;
    }
    std::int64_t frame = 0;
};

/// Those of the pattern, from `next` on, in [frame, frame + frames).
juce::MidiBuffer notesOf(std::int64_t frame, int frames, int& next) {
    juce::MidiBuffer midi;
    for (auto note = test::patternNote(next); note.frame < frame + frames; note = test::patternNote(++next))
        midi.addEvent(juce::MidiMessage::noteOn(1, note.note, note.velocity), static_cast<int>(note.frame - frame));
    return midi;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    const int channels = std::atoi(argv[1]), block = std::atoi(argv[3]);
    const juce::File folder{argv[4]};
    const juce::ScopedJuceInitialiser_GUI juce;
    Rolling transport;
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, channels}};
    if (!plugin.apply(inALine(plugin.state(), channels))) return 1;
    juce::MemoryBlock chunk;
    plugin.getStateInformation(chunk);
    if (!writeLv2Preset(chunk, channels, folder.getChildFile("state.lv2")) || !writeVst3Preset(chunk, folder.getChildFile("state.vstpreset"))) return 1;
    plugin.setPlayHead(&transport);
    plugin.setNonRealtime(true);
    plugin.prepareToPlay(48000.0, block);
    juce::AudioBuffer<float> buffer(channels, block);
    const auto frames = static_cast<std::int64_t>(std::atof(argv[2]) * 48000.0);
    for (int next = 0; transport.frame < frames; transport.frame += block) {
        auto midi = notesOf(transport.frame, block, next);
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
