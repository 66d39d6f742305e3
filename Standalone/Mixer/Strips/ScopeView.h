// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with a scope of the last second, one lane per actuator (ScopeView), and their spectra (SpectrumView).
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"

namespace physvib {

/// Height of a sample in all waveforms, -1 to 1: the square root makes weak impacts visible. Any thread.
inline float displayLevel(float sample) {
    return std::copysign(std::sqrt(std::min(1.0f, std::abs(sample))), sample);
}

/// Spectra of the actuators' output, one curve each, with fast attack and slow decay.
class SpectrumView final : public juce::Component {
public:
    static constexpr int maxCurves = 8, updatesPerSecond = 10;

    explicit SpectrumView(MixerModel& model);

    /// Updates the levels at a limited rate; repaints if the change is visible.
    void refresh();
    const SpectrumLevels& levelsDb(int channel) const { return nth(levelsDb_, channel); }
    void paint(juce::Graphics& g) override;

private:
    MixerModel& model_;
    std::array<SpectrumLevels, maxCurves> levelsDb_;
    std::int64_t drawnColumns_ = -1;
    double updatedAtMs_ = 0.0;
};

/// Waveforms of the last second beside their spectra. Message thread.
class ScopeView final : public Tab {
public:
    explicit ScopeView(MixerModel& model);

    void mixChanged() override { repaint(); }
    void refresh(const MixerSnapshot&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isQuiet() const;
    void drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const;

    MixerModel& model_;
    SpectrumView spectrum_;
    juce::Rectangle<int> lanes_;
    std::int64_t drawnColumns_ = -1;
    bool wasQuiet_ = false;
};

} // namespace physvib
