// SPDX-License-Identifier: GPL-3.0-or-later
// The way down: a knob, and the arrow keys of the world that it tilts.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// In degrees, clockwise as seen on the screen. M.
class TiltKnob final : public juce::Slider {
public:
    static constexpr double keyDegrees = 5.0;

    TiltKnob() {
        setTitle("Tilt");
        setTooltip("Tilt: which way gravity pulls; double click: down (arrow keys in the world)");
        setSliderStyle(juce::Slider::RotaryHorizontalVerticalDrag);
        setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
        setRotaryParameters(0.0f, juce::MathConstants<float>::twoPi, false);
        setRange(-180.0, 180.0, 1.0);
        setValue(0.0, juce::dontSendNotification);
        setDoubleClickReturnValue(true, 0.0);
    }
    /// Of a TiltAction.
    double angleRadians() const { return juce::degreesToRadians(-getValue()); }

    /// To that angle, however often it goes round.
    void turnTo(double degrees) {
        while (degrees > 180.0) degrees -= 360.0;
        while (degrees < -180.0) degrees += 360.0;
        setValue(degrees);
    }
    // the same law with the focus on it
    bool keyPressed(const juce::KeyPress& key) override {
        return takeKey(key) || juce::Slider::keyPressed(key);
    }

    /// Left and right turn, down and up stand for themselves; false: another key.
    bool takeKey(const juce::KeyPress& key) {
        if (key == juce::KeyPress::leftKey) return turnTo(getValue() + keyDegrees), true;
        if (key == juce::KeyPress::rightKey) return turnTo(getValue() - keyDegrees), true;
        if (key == juce::KeyPress::downKey) return turnTo(0.0), true;
        if (key == juce::KeyPress::upKey) return turnTo(180.0), true;
        return false;
    }
};

} // namespace physvib
