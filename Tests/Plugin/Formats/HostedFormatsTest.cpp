// SPDX-License-Identifier: GPL-3.0-or-later
// VST3 and LV2 in JUCE's host: what leaves them is what the processor renders, sample by sample.
#include "Plugin/Formats/Player.h"
#include <functional>

namespace physvib::hosted_formats_test {

using namespace test;

/// `prepared`: before the first block.
Samples blocksOf(juce::AudioProcessor& plugin, int frames, bool withNotes,
                 const std::function<void()>& prepared = {}) {
    plugin.setNonRealtime(true);
    auto buffer = prepareBlocks(plugin, 512);
    if (prepared) prepared();
    Samples signal(static_cast<std::size_t>(plugin.getTotalNumOutputChannels()));
    for (int done = 0; done < frames; done += 512) {
        auto midi = withNotes ? oneNote(36 + done / 512 % 60, 100, done / 512 % 512) : juce::MidiBuffer{};
        buffer.clear();
        plugin.processBlock(buffer, midi);
        append(signal, buffer);
    }
    runFor(0.05); // this host hears of latencies by a message
    EXPECT_EQ(plugin.getLatencySamples(), withNotes ? 47 : 1999) << "of the limiter; with a world, of L";
    plugin.releaseResources();
    return signal;
}

Samples expected(int width) {
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, width}};
    return blocksOf(plugin, 96'256, true);
}

void expectTheProcessorsSamples(const Format& format, const juce::String& identifier, int width) {
    const auto plugin = format.load(identifier);
    ASSERT_NE(plugin, nullptr) << identifier;
    EXPECT_EQ(plugin->getTotalNumOutputChannels(), width);
    EXPECT_EQ(plugin->getTotalNumInputChannels(), 0) << "the side chain is off, or not there";
    const auto signal = blocksOf(*plugin, 96'256, true);
    EXPECT_GT(peakOf(signal), 0.01f);
    EXPECT_TRUE(signal == expected(width)) << identifier;
}

TEST(HostedFormats, Vst3) { expectTheProcessorsSamples(Format{true}, vst3Identifier, 4); }

TEST(HostedFormats, Lv2OfEveryWidth) {
    const Format format{false};
    for (const auto& [suffix, width] : {std::pair{":2", 2}, {"", 4}, {":8", 8}, {":16", 16}})
        expectTheProcessorsSamples(format, lv2Identifier + suffix, width);
}

TEST(HostedFormats, ParametersHaveTheirNamesAndDefaults) {
    for (const bool isVst3 : {true, false}) {
        const Format format{isVst3};
        const auto plugin = format.load(isVst3 ? vst3Identifier : lv2Identifier);
        ASSERT_NE(plugin, nullptr);
        for (const auto& row : allParameters()) {
            const auto* parameter = named(*plugin, row.name);
            ASSERT_NE(parameter, nullptr) << row.name;
            // LV2 tells the range, hosts make the scale
            const bool isBent = !isVst3 && row.scale == ParameterScale::log;
            if (!isBent)
                EXPECT_NEAR(parameter->getDefaultValue(), normalised(row, row.initial), 1e-6) << row.name;
        }
    }
}

TEST(HostedFormats, StateGoesThroughTheFormats) {
    for (const bool isVst3 : {true, false}) {
        const Format format{isVst3};
        const auto identifier = isVst3 ? vst3Identifier : lv2Identifier;
        const auto first = format.load(identifier), second = format.load(identifier);
        ASSERT_NE(second, nullptr);
        int world = 0; // LV2's hosts list presets in any order
        while (world < first->getNumPrograms() &&
               first->getProgramName(world).toStdString() != displayName(builtInScenes()[1].name))
            ++world;
        ASSERT_LT(world, first->getNumPrograms()) << identifier;
        first->setCurrentProgram(world);
        // Hosts hand parameters over with a block; JUCE's makes an LV2 anew from them when it prepares.
        blocksOf(*first, 512, false, [&first] { named(*first, "Level")->setValue(1.0f); });
        restore(*second, chunkOf(*first));
        const auto a = blocksOf(*first, 48'128, false), b = blocksOf(*second, 48'128, false);
        EXPECT_TRUE(a == b) << identifier;
        EXPECT_GT(peakOf(a), 0.001f);
        EXPECT_NEAR(named(*second, "Level")->getValue(), 1.0f, 1e-6f) << identifier;
    }
}

TEST(HostedFormats, TheHostIsToldOfTheTimingHoweverOftenItIsSwitchedWhileItPlays) {
    for (const auto kind : {Kind::vst3, Kind::lv2}) {
        Player player{kind};
        player.load(playing());
        player.prepare(true);
        auto* const timing = named(dynamic_cast<juce::AudioPluginInstance&>(player.plugin()), "Timing");
        ASSERT_NE(timing, nullptr);
        const auto toldSoon = [&](int latency) {
            for (int i = 0; i < 250 && player.plugin().getLatencySamples() != latency; ++i)
                player.peakOf(1), runFor(0.02);
            return player.plugin().getLatencySamples();
        };
        EXPECT_EQ(toldSoon(1999), 1999);
        for (int i = 0; i < 40; ++i) {
            timing->setValue(i % 2 == 0 ? 1.0f : 0.0f);
            EXPECT_LE(player.peakOf(8), 1.0f);
        }
        timing->setValue(1.0f);
        EXPECT_EQ(toldSoon(1007), 1007);
    }
}

} // namespace physvib::hosted_formats_test
