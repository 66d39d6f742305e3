// SPDX-License-Identifier: GPL-3.0-or-later
// Scope of the last second, one trace per actuator, with their spectra.
#pragma once
#include "Mixer/Widgets/Parts.h"

namespace physvib {

/// Height of a sample in all waveforms: the square root makes weak impacts visible. Any thread.
inline float shownLevel(float sample) {
    return std::copysign(std::sqrt(std::min(1.0f, std::abs(sample))), sample);
}

/// Spectra of the actuators' output, one curve each, with fast attack and slow decay.
class SpectrumView final : public juce::Component {
public:
    static constexpr int maxCurves = 8, looksPerSecond = 10;

    explicit SpectrumView(MixerModel& model);

    /// Updates if it is time; repaints if the change is visible.
    void refresh();
    const SpectrumLevels& shown(int channel) const { return nth(shown_, channel); }
    void paint(juce::Graphics& g) override;

private:
    MixerModel& model_;
    std::array<SpectrumLevels, maxCurves> shown_;
    std::int64_t seen_ = -1;
    double lookedAtMs_ = 0.0;
};

class ScopeView final : public Tab {
public:
    explicit ScopeView(MixerModel& model);

    void mixChanged() override { repaint(); }
    void refresh(const MixerMoment&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isQuiet() const;
    void drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const;

    MixerModel& model_;
    SpectrumView spectrum_;
    juce::Rectangle<int> lanes_;
    std::int64_t shown_ = -1;
    bool wasQuiet_ = false;
};

} // namespace physvib
