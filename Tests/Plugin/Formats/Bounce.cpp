// SPDX-License-Identifier: GPL-3.0-or-later
// What a plug-in of that width plays from its start, as a host that is not in real time gets it: raw interleaved floats on
// stdout. With STATE_FOLDER, eight enchanters in a line, and that state as an LV2 preset for other hosts.
// Usage: physvib-plugin-bounce CHANNELS SECONDS BLOCK_FRAMES [STATE_FOLDER]
#include "PluginProcessor.h"
#include <cstdio>
#include <cstdlib>

namespace {

using namespace physvib;

PluginState inALine(PluginState state, int enchanters) {
    EnchanterLayout line{enchanters - 1.0, 1.0, enchanters, {}};
    for (int j = 0; j < enchanters; ++j) line.places[static_cast<std::size_t>(j)] = {static_cast<double>(j), 0.5};
    state.layout = describeLayout("line", line);
    return state;
}

bool writePreset(PluginProcessor& plugin, int channels, const juce::File& folder) {
    juce::MemoryBlock chunk;
    plugin.getStateInformation(chunk);
    const juce::String uri = "urn:physvib:plugin:" + juce::String{channels};
    const juce::String text = "@prefix lv2: <http://lv2plug.in/ns/lv2core#> .\n@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                              "@prefix state: <http://lv2plug.in/ns/ext/state#> .\n\n<>\n\ta pset:Preset ;\n\tlv2:appliesTo <" + uri +
                              "> ;\n\tstate:state [ <" + uri + ":StateString> \"\"\"" + chunk.toBase64Encoding() + "\"\"\" ] .\n";
    return folder.createDirectory().wasOk() && folder.getChildFile("state.ttl").replaceWithText(text, false, false, "\n") &&
           folder.getChildFile("manifest.ttl").replaceWithText("@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n@prefix pset: "
                                                               "<http://lv2plug.in/ns/ext/presets#> .\n@prefix lv2: <http://lv2plug.in/ns/lv2core#> "
                                                               ".\n\n<state.ttl>\n\ta pset:Preset ;\n\tlv2:appliesTo <" + uri + "> ;\n\trdfs:seeAlso <state.ttl> .\n", false, false, "\n");
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 4 && argc != 5) return 2;
    const int channels = std::atoi(argv[1]), block = std::atoi(argv[3]);
    const juce::ScopedJuceInitialiser_GUI juce;
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, channels}};
    if (argc == 5) {
        if (!plugin.apply(inALine(plugin.state(), channels))) return 1;
        if (!writePreset(plugin, channels, juce::File{argv[4]})) return 1;
    }
    plugin.setNonRealtime(true);
    plugin.prepareToPlay(48000.0, block);
    juce::AudioBuffer<float> buffer(channels, block);
    juce::MidiBuffer midi;
    for (auto frames = static_cast<long>(std::atof(argv[2]) * 48000.0); frames > 0; frames -= block) {
        plugin.processBlock(buffer, midi);
        for (int n = 0; n < block; ++n)
            for (int c = 0; c < channels; ++c) {
                const float x = buffer.getSample(c, n);
                if (std::fwrite(&x, sizeof x, 1, stdout) != 1) return 1;
            }
    }
    return 0;
}
