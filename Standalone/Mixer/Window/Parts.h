// SPDX-License-Identifier: GPL-3.0-or-later
// Small parts of the mixer's window: buttons with drawn signs, two lines of text, panels.
#pragma once
#include "Host/Views/Look.h"
#include "Mixer/Desk/DeskWords.h"
#include <functional>

namespace physvib {

enum class Sign { play, pause, step, restart, plus, sweep };

/// A button with a sign that needs no font; `name` is what a screen reader and the tooltip say.
class SignButton final : public juce::Button {
public:
    SignButton(Sign sign, const juce::String& name);
    void setSign(Sign sign, const juce::String& name);
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    Sign sign_;
};

/// A line to read and a quieter one under it.
class TwoLines final : public juce::Component, public juce::SettableTooltipClient {
public:
    explicit TwoLines(const juce::String& title) { setTitle(title); }
    void set(const juce::String& first, const juce::String& second, Shade firstShade = Shade::text);
    void paint(juce::Graphics& g) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override {
        return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
    }

private:
    juce::String first_, second_;
    Shade shade_ = Shade::text;
};

/// A rounded ground; what is in it keeps `panelInset` from its edge.
void drawPanel(juce::Graphics& g, const juce::Component& component);
/// The ground of a card over the window, which waits for an answer.
void drawCard(juce::Graphics& g, const juce::Component& component);
constexpr int panelInset = 14, gap = 12, rowHeight = 30;

/// A button that looks like a word in the accent's colour.
std::unique_ptr<juce::TextButton> quietButton(const juce::String& words, const juce::String& name);

/// Calls `use` with every new value of the slider; `goesOn` is true for all but the first while it is held.
void onSlide(juce::Slider& slider, std::function<void(bool goesOn)> use);

/// Every control under `root` can be reached by the keyboard, and is seen to be.
void prepareControls(juce::Component& root);

/// A small word beside a control.
void caption(juce::Label& label, const juce::String& words);

/// Fixed notation, with a true minus sign.
juce::String number(double value, int decimals);
inline juce::String dots() { return juce::String::charToString(0x2026); } ///< of what asks for more

} // namespace physvib
