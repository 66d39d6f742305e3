// SPDX-License-Identifier: GPL-3.0-or-later
// Plots of a material: spectrum and waveform of an impact, with its frequency and decay drawn over a
// recording.
#pragma once
#include "Mixer/Materials/RecordedHit.h"
#include <optional>

namespace physvib {

/// Input of both plots; they redraw when it changes.
struct ShownHit {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< 0 Hz: empty plot
    juce::Colour colour;
    const RecordedHit* recording = nullptr; ///< must stay valid until the next show()
    bool operator==(const ShownHit&) const = default;
};

class SpectrumPlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    SpectrumPlot() { setTitle("Spectrum of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    SpectrumLevels levels_{};
};

class CoursePlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    CoursePlot() { setTitle("Decay of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    HitCourse course_;
};

/// Quality of a measurement: "residual -31 dB, confidence high".
juce::String confidenceText(const ContactSound& sound);

} // namespace physvib
