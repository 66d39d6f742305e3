// SPDX-License-Identifier: GPL-3.0-or-later
// Knob for the direction of gravity, also controlled by the arrow keys in the world.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// In degrees, clockwise on the screen. Message thread.
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
    /// Angle for a TiltAction.
    double angleRadians() const { return juce::degreesToRadians(-getValue()); }

    /// Turns to that angle, wrapped to +-180 degrees.
    void turnTo(double degrees) {
        while (degrees > 180.0) degrees -= 360.0;
        while (degrees < -180.0) degrees += 360.0;
        setValue(degrees);
    }
    // the same keys apply when the knob has the focus
    bool keyPressed(const juce::KeyPress& key) override {
        return takeKey(key) || juce::Slider::keyPressed(key);
    }

    /// Left and right turn; down and up set gravity down and up. False for other keys.
    bool takeKey(const juce::KeyPress& key) {
        if (key == juce::KeyPress::leftKey) return turnTo(getValue() + keyDegrees), true;
        if (key == juce::KeyPress::rightKey) return turnTo(getValue() - keyDegrees), true;
        if (key == juce::KeyPress::downKey) return turnTo(0.0), true;
        if (key == juce::KeyPress::upKey) return turnTo(180.0), true;
        return false;
    }
};

} // namespace physvib
