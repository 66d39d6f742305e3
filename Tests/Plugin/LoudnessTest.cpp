// SPDX-License-Identifier: GPL-3.0-or-later
// None of a preset's sounds is lost on any number of outputs, a window says which actuators are where a
// layout of one's own has more, and presets are as strong as each other.
#include "Host/Music/BeatDetector.h"
#include "MusicInput.h"
#include "PluginEditor.h"
#include "PluginTesting.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib::loudness_test {

using namespace test;

constexpr std::array widths{1, 2, 4, 8, 16};
constexpr float leastDecibels = -40.0f;

struct WidthHost {
    explicit WidthHost(int width)
        : plugin{"PhysVib", {BusPlan::Kind::oneBus, width}} {
        plugin.setNonRealtime(true);
    }
    void prepare() { buffer = prepareBlocks(plugin, 512); }
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

/// The notes that a preset names; none: others.
std::vector<int> soundsOf(const PluginState& state, std::vector<int> others) {
    if (state.notes.empty()) return others;
    std::vector<int> notes;
    for (const auto& rule : state.notes) notes.push_back(rule.note);
    return notes;
}

/// Prints `valueOf(program, isWorld, width)` of every preset on every width.
template <class ValueOf>
void printOfEach(const char* heading, ValueOf valueOf) {
    std::printf("%s, by outputs\n%-22s", heading, "");
    for (const int width : widths) std::printf("%8d", width);
    for (int program = 0; const auto& name : presetNames()) {
        SCOPED_TRACE(name);
        std::printf("\n%-22s", name.c_str());
        const bool isWorld = program < static_cast<int>(builtInScenes().size());
        for (const int width : widths)
            std::printf("%8.1f", static_cast<double>(valueOf(program, isWorld, width)));
        ++program;
    }
    std::printf("\n");
}

TEST(Width, NoSoundOfAPresetIsLostOnAnyNumberOfOutputs) {
    printOfEach("peak of the faintest sound, dB of full scale", [](int program, bool isWorld, int width) {
        WidthHost host{width};
        host.plugin.setCurrentProgram(program);
        host.prepare();
        const auto state = host.plugin.state();
        EXPECT_LE(actuatorCount(state), width);
        std::vector<float> used(static_cast<std::size_t>(width));
        float least = 0.0f;
        const auto hear = [&](const std::vector<float>& peaks) {
            least = std::min(least, juce::Decibels::gainToDecibels(std::ranges::max(peaks)));
            std::ranges::transform(used, peaks, used.begin(),
                                   [](float a, float b) { return std::max(a, b); });
        };
        std::vector<int> keys(static_cast<std::size_t>(std::max(12, actuatorCount(state))));
        std::iota(keys.begin(), keys.end(), 60);
        if (isWorld)
            hear(host.peaks(10.0));
        else
            for (const int note : soundsOf(state, keys)) {
                host.prepare();
                hear(host.peaks(0.1, note));
            }
        EXPECT_GT(least, leastDecibels) << width;
        if (!isWorld) {
            EXPECT_EQ(actuatorCount(state), width) << "it uses what there is";
            EXPECT_GT(juce::Decibels::gainToDecibels(std::ranges::min(used)), leastDecibels)
                << "an output of " << width << " is idle";
        }
        return least;
    });
}

TEST(Width, ANewInstanceHasAsManyActuatorsAsTheTrackHasChannels) {
    WidthHost host{4};
    host.prepare(2);
    EXPECT_EQ(host.plugin.state().layout.name, "phone2");
    host.prepare(8);
    EXPECT_EQ(actuatorCount(host.plugin.state()), 8) << "until somebody chooses";
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
        host.plugin.choosePreset(presetPlace(name));
        EXPECT_EQ(actuatorCount(host.plugin.state()), 2) << name;
        auto mixed = host.plugin.state();
        mixed.strips[1].gainDb = -3.0;
        ASSERT_TRUE(host.plugin.edit(mixed)) << "an edit of the mix is none of the layout";
        host.prepare(8);
        EXPECT_EQ(actuatorCount(host.plugin.state()), 8) << name;
        EXPECT_EQ(host.plugin.state().strips[1].gainDb, -3.0) << name;
        WidthHost loaded{4};
        restore(loaded.plugin, chunkOf(host.plugin));
        loaded.prepare();
        EXPECT_EQ(actuatorCount(loaded.plugin.state()), 8) << "what was saved is somebody's wiring";
    }
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

// Presets are as strong as each other at usual play, on any number of outputs. The measure: in 20 s
// (worlds by themselves, notes of velocity 100 twice a second) at the initial level, the mean square in
// the band that is felt, 20 to 400 Hz, of each 125 ms on the actuator where it is largest, over the eight
// strongest. Not the peak: a click and a long note of one peak differ by 15 dB in what is felt.

constexpr int rate = 48000, block = 480, window = 6000; // 125 ms

/// Twice a second one of its sounds at velocity 100, held for 0.3 s; a world moves by itself.
juce::MidiBuffer usualPlay(int index, const std::vector<int>& notes) {
    juce::MidiBuffer midi;
    if (notes.empty()) return midi;
    const int beat = index / 50, note = notes[static_cast<std::size_t>(beat) % notes.size()];
    if (index % 50 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, note, juce::uint8{100}), 0);
    if (index % 50 == 30) midi.addEvent(juce::MidiMessage::noteOff(1, note), 0);
    return midi;
}

/// Of 20 s: the mean square of each 125 ms in the band that is felt, on the actuator where it is largest;
/// of the eight strongest windows (a second) the mean, in dB of full scale.
double strengthOf(int program, bool isWorld, int width) {
    WidthHost host{width};
    host.plugin.setCurrentProgram(program);
    auto buffer = prepareBlocks(host.plugin, block);
    std::vector<int> notes;
    if (!isWorld) notes = soundsOf(host.plugin.state(), {48, 52, 55, 60, 64, 67});
    std::vector<BandPass> bands(static_cast<std::size_t>(width), BandPass{MusicInput::band, rate});
    std::vector<std::vector<double>> energies(static_cast<std::size_t>(20 * rate / window),
                                              std::vector<double>(static_cast<std::size_t>(width)));
    for (int b = 0; b < 20 * rate / block; ++b) {
        auto midi = usualPlay(b, notes);
        buffer.clear();
        host.plugin.processBlock(buffer, midi);
        for (int c = 0; c < width; ++c) {
            const auto one = static_cast<std::size_t>(c);
            float* const samples = buffer.getWritePointer(c);
            bands[one].process({samples, static_cast<std::size_t>(block)});
            for (int n = 0; n < block; ++n)
                energies[static_cast<std::size_t>((b * block + n) / window)][one] +=
                    static_cast<double>(samples[n]) * static_cast<double>(samples[n]) / window;
        }
    }
    std::vector<double> windows;
    for (const auto& channels : energies) windows.push_back(std::ranges::max(channels));
    std::ranges::sort(windows, std::greater{});
    windows.resize(8);
    double sum = 0.0;
    for (const double energy : windows) sum += energy / static_cast<double>(windows.size());
    return 10.0 * std::log10(sum + 1e-30);
}

TEST(Loudness, OfAllPresetsIsWithinThreeDecibelsOnAnyNumberOfOutputs) {
    double least = 0.0, most = -200.0;
    printOfEach("dB of full scale, 20 to 400 Hz", [&](int program, bool isWorld, int width) {
        const double found = strengthOf(program, isWorld, width);
        least = std::min(least, found);
        most = std::max(most, found);
        return found;
    });
    EXPECT_LE(most - least, 3.0);
}

// Which layouts are taken, and that channel j is enchanter j on each.

using Set = juce::AudioChannelSet;
constexpr auto vst3 = juce::AudioProcessor::wrapperType_VST3, lv2 = juce::AudioProcessor::wrapperType_LV2;

juce::AudioProcessor::BusesLayout outputs(std::initializer_list<Set> sets) {
    juce::AudioProcessor::BusesLayout layout;
    for (const auto& set : sets) layout.outputBuses.add(set);
    return layout;
}

TEST(BusPlan, OneBusTakesOneToSixteenChannelsInOrder) {
    for (int n = 1; n <= 16; ++n) {
        EXPECT_TRUE(isAccepted({}, vst3, outputs({channelsInOrder(n, vst3)}))) << n;
        EXPECT_TRUE(isAccepted({}, lv2, outputs({Set::discreteChannels(n)}))) << n;
    }
    EXPECT_FALSE(isAccepted({}, vst3, outputs({channelsInOrder(17, vst3)})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set{}})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::stereo(), Set::stereo()})));
}

TEST(BusPlan, Vst3RefusesWhatItWouldPermute) {
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::discreteChannels(8)})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::create7point1()})));
    EXPECT_FALSE(isAccepted({}, vst3, outputs({Set::ambisonic(2)})));
    for (const auto& set :
         {Set::mono(), Set::stereo(), Set::quadraphonic(), Set::create5point1(), Set::create7point1SDDS()})
        EXPECT_TRUE(isAccepted({}, vst3, outputs({set}))) << set.getDescription();
}

TEST(BusPlan, ManyBusesTakeMonoStereoAndNothing) {
    const BusPlan many{BusPlan::Kind::manyBuses};
    EXPECT_TRUE(
        isAccepted(many, vst3, outputs({Set::stereo(), Set::mono(), Set::disabled(), Set::stereo()})));
    EXPECT_FALSE(isAccepted(many, vst3, outputs({Set::disabled(), Set::stereo()})));
    EXPECT_FALSE(isAccepted(many, vst3, outputs({Set::quadraphonic()})));
}

/// Channel j of the buffer that carries each enchanter; -1: none.
std::vector<int> channelsOfEnchanters(TestHost& host, int enchanters) {
    std::vector<int> found;
    host.setNormal(Parameter::exponent, 1.0f); // neighbours get less than half
    for (int j = 0; j < enchanters; ++j) {
        EXPECT_TRUE(host.plugin->apply(strikeAt(j, enchanters)));
        host.prepare(48000, 512);
        host.block(512, oneNote(60));
        int loudest = -1;
        float peak = 0.35f; // a strike is 0.5 where it is
        for (int done = 0; done < 24000; done += 512) {
            const auto& out = host.block(512);
            for (int c = 0; c < out.getNumChannels(); ++c)
                if (out.getMagnitude(c, 0, 512) > peak) peak = out.getMagnitude(loudest = c, 0, 512);
        }
        found.push_back(loudest);
    }
    return found;
}

TEST(BusPlan, BusesOfPairsBearTheLabelsOfTheirEnchanters) {
    const auto buses = newBuses({BusPlan::Kind::manyBuses}, vst3);
    EXPECT_EQ(buses[0].name, "A, B");
    EXPECT_EQ(buses[1].name, "C, D");
    EXPECT_EQ(buses[12].name, "Y, Z");
    for (std::size_t b = 13; b < buses.size(); ++b) EXPECT_NE(buses[b].name, buses[b - 1].name);
}

TEST(BusPlan, ChannelJIsEnchanterJOnOneBus) {
    for (const int n : {1, 2, 3, 4, 8, 16}) {
        TestHost host{{BusPlan::Kind::oneBus, n}};
        ASSERT_EQ(host.plugin->getTotalNumOutputChannels(), n);
        const auto found = channelsOfEnchanters(host, n);
        for (int j = 0; j < n; ++j) EXPECT_EQ(found[static_cast<std::size_t>(j)], j) << "of " << n;
    }
}

TEST(BusPlan, FourEnchantersOnAStereoTrackSurvive) {
    TestHost host{{BusPlan::Kind::oneBus, 2}};
    EXPECT_EQ(channelsOfEnchanters(host, 4), (std::vector<int>{0, 1, -1, -1}));
    const auto meters = host.plugin->meters();
    EXPECT_EQ(meters.actuatorCount, 4);
    EXPECT_EQ(meters.connectedCount, 2);
}

TEST(BusPlan, ABusThatIsOffKeepsThePlacesOfItsEnchanters) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    auto layout = host.plugin->getBusesLayout();
    layout.outputBuses.getReference(1) = Set::disabled();
    layout.outputBuses.getReference(2) = Set::stereo();
    ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    EXPECT_EQ(channelsOfEnchanters(host, 6), (std::vector<int>{0, 1, -1, -1, 2, 3}));
}

TEST(BusPlan, ManyBusesCarryMoreThanSixteenEnchanters) {
    TestHost host{{BusPlan::Kind::manyBuses}};
    auto layout = host.plugin->getBusesLayout();
    for (auto& set : layout.outputBuses) set = Set::stereo();
    ASSERT_TRUE(host.plugin->setBusesLayout(layout));
    const auto found = channelsOfEnchanters(host, 20);
    for (int j = 0; j < 20; ++j) EXPECT_EQ(found[static_cast<std::size_t>(j)], j);
}

} // namespace physvib::loudness_test
