// SPDX-License-Identifier: GPL-3.0-or-later
// A state as hosts from outside take it: a preset of LV2, a file of VST3.
#pragma once
#include "PluginProcessor.h"

namespace physvib::test {

inline bool writeText(const juce::File& file, const juce::String& text) {
    return file.replaceWithText(text, false, false, "\n");
}

/// `uri`: of the plug-in; `to` becomes the bundle.
inline bool writeLv2Preset(const juce::MemoryBlock& chunk, const juce::String& uri, const juce::File& to) {
    const juce::String prefixes = "@prefix lv2: <http://lv2plug.in/ns/lv2core#> .\n"
                                  "@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                                  "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
                                  "@prefix state: <http://lv2plug.in/ns/ext/state#> .\n\n";
    const juce::String applies = "\tlv2:appliesTo <" + uri + "> ;\n";
    const juce::String preset = "\ta pset:Preset ;\n" + applies + "\trdfs:label \"state\" ;\n";
    const juce::String manifest = prefixes + "<state.ttl>\n" + preset + "\trdfs:seeAlso <state.ttl> .\n";
    const juce::String value = "<" + uri + ":StateString> \"\"\"" + chunk.toBase64Encoding() + "\"\"\"";
    const juce::String state = prefixes + "<>\n" + preset + "\tstate:state [ " + value + " ] .\n";
    return to.createDirectory().wasOk() && writeText(to.getChildFile("manifest.ttl"), manifest) &&
           writeText(to.getChildFile("state.ttl"), state);
}

/// "VST 3 Preset File Format": a head, the chunk of the component, and a list of chunks. The class is named
/// by JUCE's prefix and two codes: `code` is ours of the module.
inline bool writeVst3Preset(const juce::MemoryBlock& chunk, const char* code, const juce::File& file) {
    constexpr int headBytes = 4 + 4 + 32 + 8;
    juce::MemoryOutputStream out;
    out << "VST3";
    out.writeInt(1);
    const juce::String codes = juce::String{"PhVb"} + code;
    out << "ABCDEF019182FAEB" << juce::String::toHexString(codes.toRawUTF8(), 8, 0).toUpperCase();
    out.writeInt64(headBytes + static_cast<juce::int64>(chunk.getSize()));
    out.write(chunk.getData(), chunk.getSize());
    out << "List";
    out.writeInt(1);
    out << "Comp";
    out.writeInt64(headBytes);
    out.writeInt64(static_cast<juce::int64>(chunk.getSize()));
    return file.replaceWithData(out.getData(), out.getDataSize());
}

/// A transport that rolls.
struct Rolling final : juce::AudioPlayHead {
    juce::Optional<PositionInfo> getPosition() const override {
        PositionInfo info;
        info.setIsPlaying(true);
        info.setTimeInSamples(frame);
        return info;
    }
    std::int64_t frame = 0;
};

} // namespace physvib::test
