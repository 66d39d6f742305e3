// SPDX-License-Identifier: GPL-3.0-or-later
// The look of windows: shades of a dark and a light ground, three sizes of text, and how controls are drawn.
#pragma once
#include "Host/Views/Palette.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// Every colour of a component but those of enchanters and materials: look it up with shade().
enum class Shade { ground, panel, raised, well, line, text, muted, now, limit, camera, accent };

enum class Ground { dark, light };

/// Heights of text in pixels; nothing is written in another.
namespace text {
constexpr float small = 12.5f, medium = 14.5f, large = 21.0f;
}

/// That shade where `component` is shown. M.
juce::Colour shade(const juce::Component& component, Shade which);

/// The colour of an enchanter, dark enough to be read where the ground is light. M.
juce::Colour enchanterColour(const juce::Component& component, int index);

/// Red buttons are those that stop: see juce::Component::getProperties.
inline const juce::Identifier stopProperty{"physvib-stop"};
/// Buttons that look like a word.
inline const juce::Identifier quietProperty{"physvib-quiet"};
/// The name of the program, which opens its menu.
inline const juce::Identifier titleProperty{"physvib-title"};
/// Colour (ARGB as int64) of a button that is on.
inline const juce::Identifier tintProperty{"physvib-tint"};
/// Sliders that are drawn as a fader of a mixer.
inline const juce::Identifier faderProperty{"physvib-fader"};

class Look final : public juce::LookAndFeel_V4 {
public:
    explicit Look(Ground ground = Ground::dark) { setGround(ground); }

    /// M; the components that use it have to be told (sendLookAndFeelChange).
    void setGround(Ground ground);
    Ground ground() const noexcept { return ground_; }

    juce::Font getTextButtonFont(juce::TextButton& button, int) override;
    juce::Font getComboBoxFont(juce::ComboBox&) override { return juce::Font{text::medium}; }
    juce::Font getPopupMenuFont() override { return juce::Font{text::medium}; }
    juce::Font getLabelFont(juce::Label& label) override { return label.getFont(); }
    void drawButtonBackground(juce::Graphics& g, juce::Button& button, const juce::Colour&, bool isOver,
                              bool isDown) override;
    void drawButtonText(juce::Graphics& g, juce::TextButton& button, bool isOver, bool isDown) override;
    // Texts of what is disabled are muted, and can be read: JUCE halves their contrast.
    void drawLabel(juce::Graphics& g, juce::Label& label) override;
    void drawToggleButton(juce::Graphics& g, juce::ToggleButton& button, bool isOver, bool isDown) override;
    void drawPopupMenuItem(juce::Graphics& g, const juce::Rectangle<int>& area, bool isSeparator,
                           bool isActive, bool isHighlighted, bool isTicked, bool hasSubMenu,
                           const juce::String& words, const juce::String& keys, const juce::Drawable* icon,
                           const juce::Colour* colour) override;
    void drawComboBox(juce::Graphics& g, int width, int height, bool isDown, int, int, int, int,
                      juce::ComboBox& box) override;
    void positionComboBoxText(juce::ComboBox& box, juce::Label& label) override;
    void drawLinearSlider(juce::Graphics& g, int x, int y, int width, int height, float place, float, float,
                          juce::Slider::SliderStyle, juce::Slider& slider) override;
    juce::Label* createSliderTextBox(juce::Slider& slider) override;
    void drawRotarySlider(juce::Graphics& g, int x, int y, int width, int height, float place, float start,
                          float end, juce::Slider& slider) override;
    int getSliderThumbRadius(juce::Slider&) override { return 9; }
    std::unique_ptr<juce::FocusOutline> createFocusOutlineForComponent(juce::Component&) override;

private:
    Ground ground_ = Ground::dark;
};

} // namespace physvib
