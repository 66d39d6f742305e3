// SPDX-License-Identifier: GPL-3.0-or-later
// Look and feel of the windows: colours of a dark and a light theme, three text sizes, and drawing of
// controls.
#pragma once
#include "Io/Text/ReadableNumber.h"
#include "Pictures/Palette.h"
#include <cmath>
#include <juce_graphics/juce_graphics.h>
#include <juce_gui_basics/juce_gui_basics.h>
#include <utility>

// The colours of Source/Pictures as JUCE types.
namespace physvib::palette {

inline juce::Colour juceColour(picture::Colour colour) { return juce::Colour{colour.argb()}; }

inline const juce::Colour ground = juceColour(picture::palette::ground),
                          panel = juceColour(picture::palette::panel),
                          well = juceColour(picture::palette::well),
                          line = juceColour(picture::palette::line),
                          text = juceColour(picture::palette::text),
                          muted = juceColour(picture::palette::muted),
                          highlight = juceColour(picture::palette::highlight),
                          limit = juceColour(picture::palette::limit),
                          camera = juceColour(picture::palette::camera),
                          grey = juceColour(picture::palette::grey);

using Argb = juce::uint32;
using picture::palette::materialCount;

inline juce::Colour actuator(int index) { return juceColour(picture::palette::actuator(index)); }
inline juce::Colour material(const auto& list, int index) {
    return juceColour(picture::palette::materialOf(list, index));
}
inline juce::Colour ramp(int index) { return juceColour(picture::palette::ramp(index)); }

} // namespace physvib::palette

namespace physvib::readable {

/// number() as a JUCE string. Any thread.
inline juce::String numberString(double value, int decimals) {
    return juce::String::fromUTF8(number(value, decimals).c_str());
}

} // namespace physvib::readable
namespace physvib {

/// Colours of all components, except those of actuators and materials. Read them with shade().
enum class Shade {
    background,
    panel,
    raised,
    well,
    line,
    text,
    muted,
    highlight,
    limit,
    hapticSource,
    accent
};

enum class Theme { dark, light };

JUCE_BEGIN_IGNORE_WARNINGS_GCC_LIKE("-Wdeprecated-declarations") // deprecated in JUCE 8 and 9
/// Area of a display, and the area without the system's bars. M.
inline juce::Rectangle<int> totalAreaOf(const juce::Displays::Display& display) { return display.totalArea; }
inline juce::Rectangle<int> userAreaOf(const juce::Displays::Display& display) { return display.userArea; }

/// Heights of text in pixels; all text has one of these.
namespace text {
constexpr float small = 12.5f, medium = 14.5f, large = 21.0f;

/// A font of that height, with the metrics of JUCE 7. M.
inline juce::Font font(float height, int style = juce::Font::plain) { return juce::Font{height, style}; }
JUCE_END_IGNORE_WARNINGS_GCC_LIKE

/// How wide `words` are in `font`, in pixels. M.
inline float width(const juce::Font& font, const juce::String& words) {
#if JUCE_MAJOR_VERSION >= 8
    return juce::GlyphArrangement::getStringWidth(font, words);
#else
    return font.getStringWidthFloat(words);
#endif
}

/// Width of `words` in whole pixels, rounded up. M.
inline int pixelWidth(const juce::Font& font, const juce::String& words) {
    return static_cast<int>(std::ceil(width(font, words)));
}

/// Height in pixels of `words` in lines of that width. M.
inline int heightInLines(const juce::Font& font, const juce::String& words, int width) {
    juce::AttributedString attributed{words};
    attributed.setFont(font);
    juce::TextLayout lines;
    lines.createLayout(attributed, static_cast<float>(width));
    return static_cast<int>(std::ceil(lines.getHeight()));
}
} // namespace text

/// That colour in the theme of `component`. M.
juce::Colour shade(const juce::Component& component, Shade which);

/// The colour of an actuator, darkened on a light background so that text in it is readable. M.
juce::Colour actuatorColour(const juce::Component& component, int index);

/// Property of red stop buttons; see juce::Component::getProperties.
inline const juce::Identifier stopProperty{"physvib-stop"};
/// Buttons drawn as plain text.
inline const juce::Identifier quietProperty{"physvib-quiet"};
/// The program's name, a button that opens the menu.
inline const juce::Identifier titleProperty{"physvib-title"};
/// Colour (ARGB as int64) of a button in its on state.
inline const juce::Identifier tintProperty{"physvib-tint"};
/// Sliders drawn as mixer faders.
inline const juce::Identifier faderProperty{"physvib-fader"};
/// Icons whose tooltip is their name and appears without the usual delay.
inline const juce::Identifier iconProperty{"physvib-icon"};

/// Sets a displayed value, and repaints the component if it has changed. M.
template <class T>
void setAndRepaint(juce::Component& component, T& shown, const T& value) {
    if (std::exchange(shown, value) != value) component.repaint();
}

/// Text that is only read, also by screen readers. M.
class ReadOnlyText : public juce::Component {
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override {
        return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
    }
};

/// Tooltips, with a short delay for icons. M.
class TooltipHost final : public juce::TooltipWindow {
public:
    explicit TooltipHost(juce::Component& parent)
        : TooltipWindow{&parent} {}
    juce::String getTipFor(juce::Component& c) override {
        setMillisecondsBeforeTipAppears(c.getProperties().contains(iconProperty) ? 100 : 700);
        return TooltipWindow::getTipFor(c);
    }
};

class Look final : public juce::LookAndFeel_V4 {
public:
    explicit Look(Theme theme = Theme::dark) { setTheme(theme); }

    /// M; call sendLookAndFeelChange on the components that use it afterwards.
    void setTheme(Theme theme);
    Theme theme() const noexcept { return theme_; }

    juce::Font getTextButtonFont(juce::TextButton& button, int) override;
    juce::Font getComboBoxFont(juce::ComboBox&) override { return text::font(text::medium); }
    juce::Font getPopupMenuFont() override { return text::font(text::medium); }
    juce::Font getLabelFont(juce::Label& label) override { return label.getFont(); }
    void drawButtonBackground(juce::Graphics& g, juce::Button& button, const juce::Colour&, bool isOver,
                              bool isDown) override;
    void drawButtonText(juce::Graphics& g, juce::TextButton& button, bool isOver, bool isDown) override;
    // Disabled text is muted but readable: JUCE's default halves its contrast.
    void drawLabel(juce::Graphics& g, juce::Label& label) override;
    void drawToggleButton(juce::Graphics& g, juce::ToggleButton& button, bool isOver, bool isDown) override;
    void drawPopupMenuItem(juce::Graphics& g, const juce::Rectangle<int>& area, bool isSeparator,
                           bool isActive, bool isHighlighted, bool isTicked, bool hasSubMenu,
                           const juce::String& words, const juce::String& keys, const juce::Drawable* icon,
                           const juce::Colour* colour) override;
    void drawComboBox(juce::Graphics& g, int width, int height, bool isDown, int, int, int, int,
                      juce::ComboBox& box) override;
    void drawComboBoxTextWhenNothingSelected(juce::Graphics& g, juce::ComboBox& box,
                                             juce::Label& label) override;
    void positionComboBoxText(juce::ComboBox& box, juce::Label& label) override;
    void drawLinearSlider(juce::Graphics& g, int x, int y, int width, int height, float place, float, float,
                          juce::Slider::SliderStyle, juce::Slider& slider) override;
    juce::Label* createSliderTextBox(juce::Slider& slider) override;
    void drawRotarySlider(juce::Graphics& g, int x, int y, int width, int height, float place, float start,
                          float end, juce::Slider& slider) override;
    int getSliderThumbRadius(juce::Slider&) override { return 9; }
    void drawTooltip(juce::Graphics& g, const juce::String& tip, int width, int height) override;
    std::unique_ptr<juce::FocusOutline> createFocusOutlineForComponent(juce::Component&) override;

private:
    Theme theme_ = Theme::dark;
};
} // namespace physvib
