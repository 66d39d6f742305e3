// SPDX-License-Identifier: GPL-3.0-or-later
// Presets are as strong as each other at usual play: the measure of Docs/plugin-reference.md, and beside it
// the energy.
#include "PluginTesting.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;

constexpr int rate = 48000, block = 480, window = 6000; // 125 ms
constexpr double silentDecibels = -60.0;

/// Twice a second one of its sounds at velocity 100, held for 0.3 s; a world moves by itself.
juce::MidiBuffer usualPlay(int index, const std::vector<int>& notes) {
    juce::MidiBuffer midi;
    if (notes.empty()) return midi;
    const int beat = index / 50, note = notes[static_cast<std::size_t>(beat) % notes.size()];
    if (index % 50 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, note, juce::uint8{100}), 0);
    if (index % 50 == 30) midi.addEvent(juce::MidiMessage::noteOff(1, note), 0);
    return midi;
}

struct Strength {
    double decibels = 0.0, peak = 0.0;
};

/// Of 20 s: the rms over all actuators of each 125 ms, and of those above silence the one that a tenth
/// exceeds.
Strength strengthOf(int program) {
    PluginProcessor plugin{"PhysVib", {}};
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
    std::vector<double> energies(20 * rate / window);
    Strength found;
    for (int b = 0; b < 20 * rate / block; ++b) {
        auto midi = usualPlay(b, notes);
        buffer.clear();
        plugin.processBlock(buffer, midi);
        for (int c = 0; c < plugin.getTotalNumOutputChannels(); ++c)
            for (int n = 0; n < block; ++n) {
                const double x = static_cast<double>(buffer.getSample(c, n));
                energies[static_cast<std::size_t>((b * block + n) / window)] += x * x / window;
                found.peak = std::max(found.peak, std::abs(x));
            }
    }
    std::erase_if(energies, [](double e) { return 10.0 * std::log10(e + 1e-30) < silentDecibels; });
    EXPECT_FALSE(energies.empty()) << program;
    if (energies.empty()) return found;
    std::ranges::sort(energies);
    found.decibels = 10.0 * std::log10(energies[energies.size() * 9 / 10]);
    return found;
}

TEST(Loudness, OfAllPresetsIsWithinThreeDecibels) {
    double least = 0.0, most = -200.0;
    std::printf("%-22s %9s %7s\n", "preset", "rms, dB", "peak");
    for (int program = 0; program < static_cast<int>(presetNames().size()); ++program) {
        const auto& name = presetNames()[static_cast<std::size_t>(program)];
        const auto found = strengthOf(program);
        std::printf("%-22s %9.1f %7.3f\n", name.c_str(), found.decibels, found.peak);
        least = std::min(least, 20.0 * std::log10(found.peak));
        most = std::max(most, 20.0 * std::log10(found.peak));
    }
    EXPECT_LE(most - least, 3.0);
}

} // namespace
} // namespace physvib
