// SPDX-License-Identifier: GPL-3.0-or-later
// The finished modules in JUCE's host.
#pragma once
#include "Plugin/PluginTesting.h"
#include <juce_audio_processors/juce_audio_processors.h>

namespace physvib::test {

inline const juce::String vst3Identifier = PHYSVIB_PLUGINS "/PhysVib.vst3",
                          lv2Identifier = "urn:physvib:plugin";

/// VST3 goes by its bundle, LV2 by the address that its bundle tells.
struct Format {
    explicit Format(bool isVst3) {
        if (isVst3)
            format = std::make_unique<juce::VST3PluginFormat>();
        else
            format = std::make_unique<juce::LV2PluginFormat>();
        format->searchPathsForPlugins(juce::FileSearchPath{PHYSVIB_PLUGINS}, true, false);
    }
    std::unique_ptr<juce::AudioPluginInstance> load(const juce::String& identifier) const {
        juce::OwnedArray<juce::PluginDescription> found;
        format->findAllTypesForFile(found, identifier);
        if (found.isEmpty()) return nullptr;
        juce::String error;
        auto plugin = format->createInstanceFromDescription(*found[0], 48000.0, 512, error);
        EXPECT_EQ(error, "");
        return plugin;
    }
    std::unique_ptr<juce::AudioPluginFormat> format;
};

/// JUCE's host calls `lv2:enabled` a parameter "Bypass" as well: not that one.
inline juce::AudioProcessorParameter* named(const juce::AudioPluginInstance& plugin, std::string_view name,
                                            const juce::AudioProcessorParameter* notThis = nullptr) {
    for (auto* p : plugin.getParameters())
        if (p != notThis && p->getName(100).toStdString() == name) return p;
    return nullptr;
}

} // namespace physvib::test
