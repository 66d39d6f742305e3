// SPDX-License-Identifier: GPL-3.0-or-later
// What channel strips are made of, in the mixer and in the plug-in: meter, fader, and a ceiling that is
// dragged along the meter.
#pragma once
#include "Host/Views/Look.h"
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

constexpr float meterFloorDb = -60.0f; ///< nobody feels less: full scale is some g

/// Height of that peak in a meter, 0 to 1.
inline float meterHeight(float peak) {
    return juce::jlimit(0.0f, 1.0f, 1.0f - juce::Decibels::gainToDecibels(peak, meterFloorDb) / meterFloorDb);
}

/// A bar from -60 dB to full scale with the peak of the last moments.
class PeakMeter final : public juce::Component {
public:
    explicit PeakMeter(const juce::String& title);
    void set(float peak, float hold);
    void paint(juce::Graphics& g) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override {
        return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
    }

private:
    float peak_ = 0.0f, hold_ = 0.0f; // as heights
};

/// A fader in dB; the least is silence. M.
void setUpFader(juce::Slider& fader, double leastDb, double mostDb, const juce::String& title);

/// What a strip may drive its actuator with at most, in dB of full scale. It has to be dragged: a click, a
/// double click or the wheel move nothing, since hands are attached to what it bounds.
class CeilingHandle final : public juce::Slider {
public:
    explicit CeilingHandle(const juce::String& label);
    /// Over a meter of that place. M.
    void placeOver(juce::Rectangle<int> meter);
    void paint(juce::Graphics& g) override;

private:
    static constexpr int room = 10; // left of the meter, for the mark
};

} // namespace physvib
