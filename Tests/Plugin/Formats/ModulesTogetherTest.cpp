// SPDX-License-Identifier: GPL-3.0-or-later
// An LV2 and a VST3 module in one process, as one host loads them: neither sees anything of the other, and
// both play what the processor renders, at every rate and in blocks of any size.
#include "Plugin/Formats/RawLv2.h"
#include "Plugin/Formats/RawVst3.h"
#include "Plugin/PluginTesting.h"

namespace physvib::modules_together_test {

using namespace test;

constexpr std::size_t channels = RawLv2::channels;
const std::string vst3File = PHYSVIB_PLUGINS "/PhysVib.vst3/Contents/x86_64-linux/PhysVib.so",
                  lv2File = PHYSVIB_PLUGINS "/PhysVib.lv2/PhysVib.so";

void add(Samples& signal, const std::vector<std::vector<float>>& block) {
    signal.resize(channels);
    for (std::size_t c = 0; c < channels; ++c)
        signal[c].insert(signal[c].end(), block[c].begin(), block[c].end());
}

/// `frames` frames as they are felt, whatever block they came in.
Samples felt(const Samples& signal, int latency, int frames) {
    Samples shown;
    for (const auto& channel : signal)
        shown.emplace_back(channel.begin() + latency, channel.begin() + latency + frames);
    return shown;
}

/// The first world, as the LV2 module has it from its presets: chosen, so as strong as an instrument.
PluginState firstWorld() {
    PluginState state = newPluginState();
    applyBuiltInPreset(state, 0);
    state.parameters.clear();
    return state;
}

/// What the processor renders at the modules' level.
Samples expectedAt(double rate, int frames) {
    TestHost host{firstWorld()};
    host.plugin->parameter(Parameter::level)
        .setValue(host.plugin->parameter(Parameter::level).getDefaultValue());
    host.prepare(rate, 480);
    return host.felt(frames);
}

/// Both in turn, block by block.
struct Both {
    Both(double rate, int block)
        : lv2{block, block, rate} {
        vst3.setState(pluginStateJson(firstWorld()));
        vst3.start(block, true, rate);
        lv2.activate();
    }
    ~Both() {
        vst3.stop();
        lv2.deactivate();
    }
    int latency() const { return static_cast<int>(vst3.processor->getLatencySamples()); }
    void play(int frames, int block) {
        for (int done = 0; done < frames; done += block) {
            vst3.process();
            lv2.run(block);
            add(fromVst3, vst3.channels[0]);
            add(fromLv2, {lv2.out.begin(), lv2.out.end()});
        }
    }
    RawVst3 vst3{PHYSVIB_PLUGINS "/PhysVib.vst3", "PhysVib"};
    RawLv2 lv2;
    Samples fromVst3, fromLv2;
};

TEST(ModulesTogether, PlayWhatTheProcessorRendersAtAnyRateInAnyBlocks) {
    for (const double rate : {5000.0, 8000.0, 44100.0, 48000.0, 192000.0}) {
        const int frames = static_cast<int>(rate) / 2;
        const Samples expected = expectedAt(rate, frames);
        EXPECT_GT(peakOf(expected), 0.001f) << rate;
        for (const int block : {1, 37, 512, 16384}) {
            Both both{rate, block};
            ASSERT_TRUE(both.vst3.isLoaded() && both.lv2.isLoaded());
            both.play(both.latency() + frames, block);
            EXPECT_EQ(both.lv2.latency, static_cast<float>(both.latency())) << rate << ' ' << block;
            EXPECT_TRUE(felt(both.fromVst3, both.latency(), frames) == expected) << rate << ' ' << block;
            EXPECT_TRUE(felt(both.fromLv2, both.latency(), frames) == expected) << rate << ' ' << block;
        }
    }
}

TEST(ModulesTogether, AreSilentAtARateThatCannotBeRendered) {
    for (const double rate : {-1.0, 0.0, 1.0, 4999.0, 192001.0, 384000.0, 384001.0, 1e9}) {
        Both both{rate, 512};
        both.play(96000, 512);
        EXPECT_EQ(peakOf(both.fromVst3), 0.0f) << rate;
        EXPECT_EQ(peakOf(both.fromLv2), 0.0f) << rate;
        EXPECT_EQ(both.latency(), 0) << rate;
    }
}

TEST(ModulesTogether, SeeNothingOfEachOther) {
    const Both both{48000.0, 512};
    ASSERT_TRUE(both.vst3.isLoaded() && both.lv2.isLoaded());
    void* const vst3 = dlopen(vst3File.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
    void* const lv2 = dlopen(lv2File.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
    ASSERT_TRUE(vst3 && lv2) << "both are loaded";
    EXPECT_TRUE(dlsym(vst3, "GetPluginFactory") && dlsym(lv2, "lv2_descriptor"));
    EXPECT_FALSE(dlsym(vst3, "lv2_descriptor") || dlsym(lv2, "GetPluginFactory"));
    for (const char* const name : {"GetPluginFactory", "ModuleEntry", "lv2_descriptor", "lv2ui_descriptor"})
        EXPECT_FALSE(dlsym(RTLD_DEFAULT, name)) << name;
    // each has one of its own, and so its statics
    const char* const shared = "_ZN4juce14MessageManager11getInstanceEv";
    EXPECT_FALSE(dlsym(vst3, shared) || dlsym(lv2, shared));
    dlclose(vst3);
    dlclose(lv2);
}

} // namespace physvib::modules_together_test
