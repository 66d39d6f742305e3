// SPDX-License-Identifier: GPL-3.0-or-later
// Presets on as many actuators as the host has outputs: none of their sounds is lost, and a window says which
// actuators are where a layout of one's own has more.
#include "PluginEditor.h"
#include "PluginTesting.h"

namespace physvib {
namespace {

using namespace test;

constexpr std::array widths{1, 2, 4, 8, 16};
constexpr float leastDecibels = -40.0f;

struct WidthHost {
    explicit WidthHost(int width)
        : plugin{"PhysVib", {BusPlan::Kind::oneBus, width}} {
        plugin.setNonRealtime(true);
    }
    void prepare() {
        plugin.setRateAndBufferSizeDetails(48000, 512);
        plugin.prepareToPlay(48000, 512);
        buffer.setSize(std::max(plugin.getTotalNumInputChannels(), plugin.getTotalNumOutputChannels()), 512);
    }
    void prepare(int outputs) {
        auto layout = plugin.getBusesLayout();
        layout.outputBuses.getReference(0) = channelsInOrder(outputs, juce::AudioProcessor::wrapperType_VST3);
        EXPECT_TRUE(plugin.setBusesLayout(layout));
        prepare();
    }
    /// The peak of each output in that time, of a note if it has a number.
    std::vector<float> peaks(double seconds, int note = -1) {
        std::vector<float> all(static_cast<std::size_t>(plugin.getTotalNumOutputChannels()));
        for (int b = 0; b * 512 < seconds * 48000; ++b) {
            auto midi = b == 0 && note >= 0 ? oneNote(note) : juce::MidiBuffer{};
            plugin.processBlock(buffer, midi);
            for (std::size_t c = 0; c < all.size(); ++c)
                all[c] = std::max(all[c], buffer.getMagnitude(static_cast<int>(c), 0, 512));
        }
        return all;
    }
    PluginProcessor plugin;
    juce::AudioBuffer<float> buffer;
};

std::vector<int> soundsOf(const PluginState& state) {
    std::vector<int> notes;
    for (const auto& rule : state.notes) notes.push_back(rule.note);
    if (notes.empty())
        for (int note = 60; note < 60 + std::max(12, enchantersOf(state)); ++note) notes.push_back(note);
    return notes;
}

float decibelsOf(const std::vector<float>& peaks) {
    return juce::Decibels::gainToDecibels(*std::ranges::max_element(peaks));
}

TEST(Width, NoSoundOfAPresetIsLostOnAnyNumberOfOutputs) {
    std::printf("peak of the faintest sound, dB of full scale, by outputs\n%-22s", "");
    for (const int width : widths) std::printf("%8d", width);
    std::printf("\n");
    const int worlds = static_cast<int>(builtInScenes().size());
    for (int program = 0; program < static_cast<int>(presetNames().size()); ++program) {
        std::printf("%-22s", presetNames()[static_cast<std::size_t>(program)].c_str());
        for (const int width : widths) {
            WidthHost host{width};
            host.plugin.setCurrentProgram(program);
            host.prepare();
            const auto state = host.plugin.state();
            EXPECT_LE(enchantersOf(state), width) << program;
            std::vector<float> used(static_cast<std::size_t>(width));
            float least = 0.0f;
            const auto hear = [&](const std::vector<float>& peaks) {
                least = std::min(least, decibelsOf(peaks));
                std::ranges::transform(used, peaks, used.begin(),
                                       [](float a, float b) { return std::max(a, b); });
            };
            if (program < worlds)
                hear(host.peaks(10.0));
            else
                for (const int note : soundsOf(state)) {
                    host.prepare();
                    hear(host.peaks(0.1, note));
                }
            EXPECT_GT(least, leastDecibels)
                << presetNames()[static_cast<std::size_t>(program)] << ", " << width;
            if (program >= worlds) {
                EXPECT_EQ(enchantersOf(state), width) << "it uses what there is";
                EXPECT_GT(juce::Decibels::gainToDecibels(*std::ranges::min_element(used)), leastDecibels)
                    << presetNames()[static_cast<std::size_t>(program)] << ": an output of " << width
                    << " is idle";
            }
            std::printf("%8.1f", static_cast<double>(least));
        }
        std::printf("\n");
    }
}

TEST(Width, ANewInstanceHasAsManyActuatorsAsTheTrackHasChannels) {
    WidthHost host{4};
    host.prepare(2);
    EXPECT_EQ(host.plugin.state().layout.name, "phone2");
    host.prepare(8);
    EXPECT_EQ(enchantersOf(host.plugin.state()), 8) << "until somebody chooses";
    auto chosen = host.plugin.state();
    chosen.layout = presetLayout("ring3");
    ASSERT_TRUE(host.plugin.edit(chosen));
    host.prepare();
    EXPECT_EQ(host.plugin.state().layout.name, "ring3");
}

TEST(Width, APresetThatWasChosenFollowsATrackThatIsMadeWiderToo) {
    for (const char* const name : {"Drum kit", "marbles"}) {
        WidthHost host{8};
        host.prepare(2);
        host.plugin.choose(presetPlace(name));
        EXPECT_EQ(enchantersOf(host.plugin.state()), 2) << name;
        auto mixed = host.plugin.state();
        mixed.strips[1].gainDb = -3.0;
        ASSERT_TRUE(host.plugin.edit(mixed)) << "an edit of the mix is none of the layout";
        host.prepare(8);
        EXPECT_EQ(enchantersOf(host.plugin.state()), 8) << name;
        EXPECT_EQ(host.plugin.state().strips[1].gainDb, -3.0) << name;
        WidthHost loaded{4};
        restore(loaded.plugin, chunkOf(host.plugin));
        loaded.prepare();
        EXPECT_EQ(enchantersOf(loaded.plugin.state()), 8) << "what was saved is somebody's wiring";
    }
}

TEST(Width, ALoadedStateKeepsItsLayout) {
    WidthHost four{4}, two{2};
    restore(two.plugin, chunkOf(four.plugin));
    two.prepare();
    EXPECT_EQ(two.plugin.state().layout.name, "phone4");
}

TEST(Width, TheWindowNamesTheActuatorsThatAreLostAndFoldsThem) {
    WidthHost host{2};
    auto state = host.plugin.state();
    state.layout = presetLayout("phone4");
    ASSERT_TRUE(host.plugin.edit(state));
    host.prepare();
    host.peaks(0.1, 60);
    const auto editor = openEditor<PluginEditor>(host.plugin);
    editor->refresh();
    EXPECT_TRUE(editor->statusText().contains("2 outputs for 4 actuators: not felt C, D"))
        << editor->statusText();
    auto* const fold = buttonOf(*editor, "Use 2");
    ASSERT_TRUE(fold != nullptr && fold->isVisible());
    fold->onClick();
    EXPECT_EQ(host.plugin.state().layout.name, "phone2");
    EXPECT_EQ(host.plugin.state().scene.name, "Keys");
}

} // namespace
} // namespace physvib
