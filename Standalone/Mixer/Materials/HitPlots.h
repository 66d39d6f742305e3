// SPDX-License-Identifier: GPL-3.0-or-later
// A material as it sounds: the spectrum and the course of one hit, with the two numbers that are played drawn
// over a recording.
#pragma once
#include "Mixer/Materials/RecordedHit.h"
#include <optional>

namespace physvib {

/// What both plots show; redrawn when it changes.
struct ShownHit {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< 0 Hz: nothing
    juce::Colour colour;
    const RecordedHit* recording = nullptr; ///< outlives the plots' next show()
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

/// How sure a measurement is: "residual -31 dB, confidence high".
juce::String confidenceText(const ContactSound& sound);

} // namespace physvib
