// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the screens for participants: large buttons, a field with its enchanters, arrow keys.
#pragma once
#include "Lab/Study/PhantomGrid.h"
#include "Mixer/Window/Parts.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// Left and right margin of the screens that fill the window, in pixels.
constexpr int pageInset = 40;

/// A large target: words, a quieter remark below them, and a bar along its foot.
class BigButton final : public juce::Button {
public:
    /// `name` is what a screen reader says.
    BigButton(const juce::String& words, const juce::String& name);
    void setWords(const juce::String& words, const juce::String& remark = {});
    void setShare(double share);   ///< of the bar, 0 to 1; less than 0: no bar
    void setMain(bool isMain);     ///< the one that goes on
    void setMarked(bool isMarked); ///< a dot: was felt
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    juce::String words_, remark_;
    double share_ = -1.0;
    bool isMain_ = false, isMarked_ = false;
};

/// The ground of all that is chosen by a click, in its state.
void drawTarget(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner = 8.0f);

/// Largest rectangle of the layout's shape in the middle of `area`.
juce::Rectangle<float> fieldIn(juce::Rectangle<float> area, const EnchanterLayout& layout);
/// Where an enchanter is on it: x to the right, y downwards, 0 to 1.
FieldPlace placeOf(const EnchanterLayout& layout, int enchanter);
juce::Point<float> pointOn(const juce::Rectangle<float>& field, const FieldPlace& place);
/// The field, and its enchanters as rings with their labels.
void drawField(juce::Graphics& g, const juce::Component& component, const juce::Rectangle<float>& field,
               const LayoutDescription& layout);

/// An enchanter of the field with its label, pushed outwards where a point lies on it.
void drawEnchanterBeside(juce::Graphics& g, const juce::Component& component,
                         const juce::Rectangle<float>& field, const LayoutDescription& layout, int enchanter);

/// An arrow key moves the focus to the nearest child of `parent` in that direction; false if it is another
/// key.
bool moveFocus(juce::Component& parent, const juce::KeyPress& key);

} // namespace physvib
