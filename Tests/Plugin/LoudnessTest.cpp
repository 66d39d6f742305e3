// SPDX-License-Identifier: GPL-3.0-or-later
// Presets are as strong as each other at usual play, on any number of outputs. The measure: in 20 s (worlds
// by themselves, notes of velocity 100 twice a second) at the initial level, the mean square in the band that
// is felt, 20 to 400 Hz, of each 125 ms on the actuator where it is largest, over the eight strongest. Not
// the peak: a click and a long note of one peak differ by 15 dB in what is felt.
#include "Host/Music/BeatDetector.h"
#include "MusicInput.h"
#include "PluginTesting.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using namespace test;

constexpr int rate = 48000, block = 480, window = 6000; // 125 ms
constexpr std::array loudnessWidths{1, 2, 4, 8, 16};

/// Twice a second one of its sounds at velocity 100, held for 0.3 s; a world moves by itself.
juce::MidiBuffer usualPlay(int index, const std::vector<int>& notes) {
    juce::MidiBuffer midi;
    if (notes.empty()) return midi;
    const int beat = index / 50, note = notes[static_cast<std::size_t>(beat) % notes.size()];
    if (index % 50 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, note, juce::uint8{100}), 0);
    if (index % 50 == 30) midi.addEvent(juce::MidiMessage::noteOff(1, note), 0);
    return midi;
}

/// Of 20 s: the mean square of each 125 ms in the band that is felt, on the actuator where it is largest; of
/// the eight strongest windows (a second) the mean, in dB of full scale.
double strengthOf(int program, int width) {
    PluginProcessor plugin{"PhysVib", {BusPlan::Kind::oneBus, width}};
    plugin.setNonRealtime(true);
    plugin.setCurrentProgram(program);
    plugin.setRateAndBufferSizeDetails(rate, block);
    plugin.prepareToPlay(rate, block);
    std::vector<int> notes;
    if (program >= static_cast<int>(builtInScenes().size())) {
        for (const auto& rule : plugin.state().notes) notes.push_back(rule.note);
        if (notes.empty()) notes = {48, 52, 55, 60, 64, 67};
    }
    juce::AudioBuffer<float> buffer{
        std::max(plugin.getTotalNumInputChannels(), plugin.getTotalNumOutputChannels()), block};
    std::vector<BandPass> bands(static_cast<std::size_t>(width), BandPass{MusicInput::band, rate});
    std::vector<std::vector<double>> energies(static_cast<std::size_t>(20 * rate / window),
                                              std::vector<double>(static_cast<std::size_t>(width)));
    for (int b = 0; b < 20 * rate / block; ++b) {
        auto midi = usualPlay(b, notes);
        buffer.clear();
        plugin.processBlock(buffer, midi);
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
    std::printf("dB of full scale, 20 to 400 Hz, by outputs\n%-22s", "");
    for (const int width : loudnessWidths) std::printf("%8d", width);
    std::printf("\n");
    for (int program = 0; program < static_cast<int>(presetNames().size()); ++program) {
        std::printf("%-22s", presetNames()[static_cast<std::size_t>(program)].c_str());
        for (const int width : loudnessWidths) {
            const double found = strengthOf(program, width);
            std::printf("%8.1f", found);
            least = std::min(least, found);
            most = std::max(most, found);
        }
        std::printf("\n");
    }
    EXPECT_LE(most - least, 3.0);
}

} // namespace
} // namespace physvib
