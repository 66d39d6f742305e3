// SPDX-License-Identifier: GPL-3.0-or-later
// Small components of the mixer's window: icon buttons, two lines of text, panels.
#pragma once
#include "Host/Views/Look.h"
#include "Mixer/Desk/DeskWords.h"
#include <functional>

namespace physvib {

enum class Sign { play, pause, step, restart, plus, sweep, save, undo, redo };

/// Button with a drawn icon; `name` is for screen readers and the tooltip.
class SignButton final : public juce::Button {
public:
    SignButton(Sign sign, const juce::String& name);
    void setSign(Sign sign, const juce::String& name);
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    Sign sign_;
};

/// A line of text with a less prominent one below.
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

/// Draws a rounded background; contents keep `panelInset` from its edge.
void drawPanel(juce::Graphics& g, const juce::Component& component);
/// Draws the background of a card over the window, which asks the user.
void drawCard(juce::Graphics& g, const juce::Component& component);
constexpr int panelInset = 14, gap = 12, rowHeight = 30;

/// A button that looks like a text link.
std::unique_ptr<juce::TextButton> quietButton(const juce::String& words, const juce::String& name);

/// Calls `use` with every new value of the slider. `goesOn` is true for all but the first value of a drag.
void onSlide(juce::Slider& slider, std::function<void(bool goesOn)> use);

/// Makes every control under `root` reachable by keyboard, with a visible focus.
void prepareControls(juce::Component& root);

/// Sets a small caption beside a control.
void caption(juce::Label& label, const juce::String& words);

/// Fixed notation with a real minus sign.
juce::String number(double value, int decimals);
inline juce::String dots() { return juce::String::charToString(0x2026); } ///< label opens a dialogue

} // namespace physvib
