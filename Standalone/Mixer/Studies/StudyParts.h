// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of participants' screens: large buttons, a field with its actuators, arrow keys.
#pragma once
#include "Lab/Study/PercentCounts.h"
#include "Mixer/Window/Parts.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// Left and right margin of the screens that fill the window, in pixels.
constexpr int pageInset = 40;

/// A large button with text, a smaller remark below, and a bar at its lower edge.
class BigButton final : public juce::Button {
public:
    /// `name` is for screen readers.
    BigButton(const juce::String& words, const juce::String& name);
    void setWords(const juce::String& words, const juce::String& remark = {});
    void setShare(double share);   ///< of the bar, 0 to 1; negative: no bar
    void setMain(bool isMain);     ///< the button that continues
    void setMarked(bool isMarked); ///< shows a dot: already felt
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    juce::String words_, remark_;
    double share_ = -1.0;
    bool isMain_ = false, isMarked_ = false;
};

/// Draws the background of a button in its state.
void drawTarget(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner = 8.0f);

/// Largest centred rectangle in `area` with the layout's aspect ratio.
juce::Rectangle<float> fieldIn(juce::Rectangle<float> area, const EnchanterLayout& layout);
/// Place of an actuator on the field: x to the right, y downwards, 0 to 1.
FieldPlace placeOf(const EnchanterLayout& layout, int enchanter);
juce::Point<float> pointOn(const juce::Rectangle<float>& field, const FieldPlace& place);
/// Draws the field with its actuators as labelled rings.
void drawField(juce::Graphics& g, const juce::Component& component, const juce::Rectangle<float>& field,
               const LayoutDescription& layout);

/// Draws an actuator of the field with its label, which is moved outwards if a point lies on it.
void drawEnchanterBeside(juce::Graphics& g, const juce::Component& component,
                         const juce::Rectangle<float>& field, const LayoutDescription& layout, int enchanter);

/// Moves the focus to the nearest child of `parent` in the direction of an arrow key; false for other keys.
bool moveFocus(juce::Component& parent, const juce::KeyPress& key);

} // namespace physvib
