// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of the dark and the light theme, and drawing of flat controls.
#include "Host/Views/Look.h"
#include "Core/Limits.h"
#include <array>
#include <initializer_list>

namespace physvib {

namespace {

using Argb = palette::Argb;
constexpr int firstShadeId = 0x7068b00; // JUCE colour ids of this project
constexpr float corner = 5.0f;

int colourId(Shade which) { return firstShadeId + static_cast<int>(which); }

struct Shades {
    juce::Colour ground, panel, raised, well, line, text, muted, highlight, limit, camera, accent;
};

const Shades& findShades(Theme theme) {
    static const Shades dark{palette::ground, palette::panel,      juce::Colour{Argb{0xff272a33}},
                             palette::well,   palette::line,       palette::text,
                             palette::muted,  palette::highlight,  palette::limit,
                             palette::camera, palette::actuator(0)};
    static const Shades light{
        juce::Colour{Argb{0xffe4e7ee}}, juce::Colour{Argb{0xfff6f7fa}}, juce::Colour{Argb{0xffd3d9e4}},
        juce::Colour{Argb{0xffffffff}}, juce::Colour{Argb{0xffc3c9d6}}, juce::Colour{Argb{0xff1b1e27}},
        juce::Colour{Argb{0xff545c6e}}, juce::Colour{Argb{0xff7f5300}}, juce::Colour{Argb{0xffb62222}},
        juce::Colour{Argb{0xff8d7a45}}, juce::Colour{Argb{0xff09665d}}};
    return theme == Theme::dark ? dark : light;
}

bool isTrue(const juce::Component& c, const juce::Identifier& property) {
    return c.getProperties()[property];
}

juce::Colour tintOf(const juce::Component& c) {
    const auto& properties = c.getProperties();
    return properties.contains(tintProperty)
               ? juce::Colour{static_cast<Argb>(static_cast<juce::int64>(properties[tintProperty]))}
               : shade(c, Shade::accent);
}

juce::Colour textColourOn(juce::Colour ground) {
    return ground.getPerceivedBrightness() > 0.55f ? juce::Colour{Argb{0xff101218}} : juce::Colours::white;
}

/// Relative luminance by WCAG 2, 0 to 1.
double relativeLuminance(juce::Colour colour) {
    const auto linear = [](float v) {
        return v <= 0.04045f ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.getFloatRed()) + 0.7152 * linear(colour.getFloatGreen()) +
           0.0722 * linear(colour.getFloatBlue());
}

/// Colour of an actuator, darkened or lightened until text in it has enough contrast on a panel.
juce::Colour readableActuatorColour(Theme theme, int index) {
    constexpr double minContrast = 4.6;
    const bool isLight = theme == Theme::light;
    const auto panel = relativeLuminance(findShades(theme).panel);
    auto colour = palette::actuator(index);
    if (isLight) colour = colour.withMultipliedSaturation(1.6f).withMultipliedBrightness(0.62f);
    const auto contrast = [&] {
        const double luminance = relativeLuminance(colour);
        return (std::max(luminance, panel) + 0.05) / (std::min(luminance, panel) + 0.05);
    };
    while (contrast() < minContrast)
        colour = colour.interpolatedWith(isLight ? juce::Colours::black : juce::Colours::white, 0.04f);
    return colour;
}

void drawFader(juce::Graphics& g, juce::Rectangle<float> area, float place, const juce::Slider& slider) {
    const float x = area.getCentreX();
    g.setColour(shade(slider, Shade::raised));
    g.fillRoundedRectangle(x - 2.0f, area.getY(), 4.0f, area.getHeight(), 2.0f);
    const auto cap = juce::Rectangle<float>{26.0f, 15.0f}.withCentre({x, place});
    g.setColour(shade(slider, Shade::background));
    g.fillRoundedRectangle(cap.expanded(1.5f), 4.5f);
    const auto colour = shade(slider, Shade::text)
                            .interpolatedWith(shade(slider, Shade::panel), slider.isEnabled() ? 0.18f : 0.6f);
    g.setColour(colour);
    g.fillRoundedRectangle(cap, 3.5f);
    g.setColour(shade(slider, Shade::background).withAlpha(0.75f));
    g.fillRect(cap.withSizeKeepingCentre(18.0f, 1.5f));
}

/// The slider's value is drawn on top of it.
void drawBar(juce::Graphics& g, juce::Rectangle<float> area, float place, const juce::Slider& slider) {
    juce::Path bar;
    bar.addRoundedRectangle(area.reduced(0.5f), corner);
    g.setColour(shade(slider, Shade::raised));
    g.fillPath(bar);
    g.setColour(shade(slider, Shade::line)); // its end is visible on any background
    g.strokePath(bar, juce::PathStrokeType{1.0f});
    if (!slider.isEnabled()) return;
    const juce::Graphics::ScopedSaveState savedState{g};
    g.reduceClipRegion(bar);
    g.setColour(tintOf(slider).withMultipliedAlpha(0.4f));
    g.fillRect(area.withRight(place));
}

} // namespace

juce::Colour shade(const juce::Component& component, Shade which) {
    return component.findColour(colourId(which));
}

juce::Colour actuatorColour(const juce::Component& component, int index) {
    using All = std::array<juce::Colour, limits::maxActuators>;
    const auto makeColours = [](Theme theme) {
        All all;
        for (int j = 0; j < limits::maxActuators; ++j)
            all[static_cast<std::size_t>(j)] = readableActuatorColour(theme, j);
        return all;
    };
    static const All dark = makeColours(Theme::dark), light = makeColours(Theme::light);
    const bool isLight = shade(component, Shade::panel).getPerceivedBrightness() > 0.5f;
    return (isLight ? light : dark)[static_cast<std::size_t>(index) % dark.size()];
}

void Look::setTheme(Theme theme) {
    using namespace juce;
    theme_ = theme;
    const Shades& s = findShades(theme);
    const std::array all{s.ground, s.panel,     s.raised, s.well,   s.line,  s.text,
                         s.muted,  s.highlight, s.limit,  s.camera, s.accent};
    for (std::size_t i = 0; i < all.size(); ++i) setColour(firstShadeId + static_cast<int>(i), all[i]);
    setColourScheme(
        {s.ground, s.well, s.panel, s.line, s.text, s.accent.withAlpha(0.35f), s.text, s.raised, s.text});
    const auto set = [this](Colour colour, std::initializer_list<int> ids) {
        for (const int id : ids) setColour(id, colour);
    };
    setColour(ResizableWindow::backgroundColourId, s.ground);
    set(s.raised, {ComboBox::backgroundColourId, TextButton::buttonColourId, Slider::backgroundColourId,
                   Slider::rotarySliderOutlineColourId});
    set(Colours::transparentBlack, {ComboBox::outlineColourId, Slider::textBoxOutlineColourId});
    set(s.panel, {PopupMenu::backgroundColourId, TooltipWindow::backgroundColourId});
    setColour(PopupMenu::highlightedBackgroundColourId, s.accent.withAlpha(0.22f));
    set(s.text, {PopupMenu::highlightedTextColourId, TextButton::textColourOffId, TextButton::textColourOnId,
                 ToggleButton::textColourId, Label::textColourId, Slider::thumbColourId,
                 Slider::textBoxTextColourId, TooltipWindow::textColourId});
    set(s.muted, {PopupMenu::headerTextColourId, ToggleButton::tickDisabledColourId});
    set(s.well,
        {TextEditor::backgroundColourId, ListBox::backgroundColourId, ProgressBar::backgroundColourId});
    set(s.line, {TextEditor::outlineColourId, TooltipWindow::outlineColourId});
    set(s.accent, {TextEditor::focusedOutlineColourId, ToggleButton::tickColourId, Slider::trackColourId,
                   Slider::rotarySliderFillColourId, ProgressBar::foregroundColourId});
    setColour(TextButton::buttonOnColourId, s.accent.withAlpha(0.35f));
    setColour(ScrollBar::thumbColourId, s.muted.withAlpha(0.75f));
}

juce::Font Look::getTextButtonFont(juce::TextButton& button, int) {
    if (isTrue(button, titleProperty)) return text::font(text::large, juce::Font::bold);
    return isTrue(button, stopProperty) ? text::font(text::medium, juce::Font::bold)
                                        : text::font(text::small);
}

void Look::drawButtonBackground(juce::Graphics& g, juce::Button& button, const juce::Colour&, bool isOver,
                                bool isDown) {
    const auto area = button.getLocalBounds().toFloat().reduced(0.5f);
    const bool isQuiet = isTrue(button, quietProperty), stops = isTrue(button, stopProperty);
    auto colour = button.getToggleState() ? tintOf(button) : shade(button, Shade::raised);
    if (stops && button.getToggleState()) colour = shade(button, Shade::limit);
    if (isQuiet && !button.getToggleState()) colour = colour.withAlpha(isOver ? 0.6f : 0.0f);
    if (isOver && button.isEnabled()) colour = colour.brighter(0.08f);
    if (isDown) colour = colour.darker(0.15f);
    g.setColour(button.isEnabled() ? colour : colour.withMultipliedAlpha(0.45f));
    g.fillRoundedRectangle(area, corner);
    if (!stops) return;
    // when off, it is a red frame; a filled button is pressed
    g.setColour(shade(button, button.getToggleState() ? Shade::text : Shade::limit));
    g.drawRoundedRectangle(area.reduced(1.0f), corner, 2.0f);
}

void Look::drawButtonText(juce::Graphics& g, juce::TextButton& button, bool, bool) {
    auto colour = shade(button, Shade::text);
    if (isTrue(button, stopProperty))
        colour =
            button.getToggleState() ? textColourOn(shade(button, Shade::limit)) : shade(button, Shade::limit);
    else if (button.getToggleState())
        colour = textColourOn(tintOf(button));
    else if (isTrue(button, quietProperty) && !isTrue(button, titleProperty))
        colour = shade(button, Shade::accent);
    g.setColour(button.isEnabled() ? colour : shade(button, Shade::muted));
    g.setFont(getTextButtonFont(button, button.getHeight()));
    g.drawFittedText(button.getButtonText(), button.getLocalBounds().reduced(1, 0),
                     juce::Justification::centred, 1, 0.8f);
}

void Look::drawLabel(juce::Graphics& g, juce::Label& label) {
    g.fillAll(label.findColour(juce::Label::backgroundColourId));
    if (label.isBeingEdited()) return;
    g.setColour(label.isEnabled() ? label.findColour(juce::Label::textColourId) : shade(label, Shade::muted));
    g.setFont(getLabelFont(label));
    const auto area = getLabelBorderSize(label).subtractedFrom(label.getLocalBounds());
    const int lines =
        std::max(1, static_cast<int>(static_cast<float>(area.getHeight()) / getLabelFont(label).getHeight()));
    const int high = text::heightInLines(getLabelFont(label), label.getText(), area.getWidth());
    if (lines > 1 && high <= area.getHeight()) { // JUCE's fitting sometimes uses too few lines
        juce::AttributedString words;
        words.append(label.getText(), getLabelFont(label), label.findColour(juce::Label::textColourId));
        words.setJustification(label.getJustificationType());
        words.draw(g, area.toFloat());
    } else
        g.drawFittedText(label.getText(), area, label.getJustificationType(), lines,
                         label.getMinimumHorizontalScale());
    g.setColour(label.findColour(juce::Label::outlineColourId));
    g.drawRect(label.getLocalBounds());
}

void Look::drawToggleButton(juce::Graphics& g, juce::ToggleButton& button, bool isOver, bool isDown) {
    const float size = std::min(15.0f, 0.75f * static_cast<float>(button.getHeight())), tick = 1.1f * size;
    drawTickBox(g, button, 4.0f, 0.5f * (static_cast<float>(button.getHeight()) - tick), tick, tick,
                button.getToggleState(), button.isEnabled(), isOver, isDown);
    g.setColour(button.isEnabled() ? button.findColour(juce::ToggleButton::textColourId)
                                   : shade(button, Shade::muted));
    g.setFont(text::font(size));
    g.drawFittedText(button.getButtonText(),
                     button.getLocalBounds().withTrimmedLeft(juce::roundToInt(tick) + 10).withTrimmedRight(2),
                     juce::Justification::centredLeft, 10);
}

void Look::drawPopupMenuItem(juce::Graphics& g, const juce::Rectangle<int>& area, bool isSeparator,
                             bool isActive, bool isHighlighted, bool isTicked, bool hasSubMenu,
                             const juce::String& words, const juce::String& keys, const juce::Drawable* icon,
                             const juce::Colour* colour) {
    const auto muted = findColour(colourId(Shade::muted));
    juce::LookAndFeel_V4::drawPopupMenuItem(g, area, isSeparator, true, isHighlighted && isActive, isTicked,
                                            hasSubMenu, words, keys, icon, isActive ? colour : &muted);
}

/// Narrow boxes use the small font, so that words fit.
static bool isNarrow(const juce::ComboBox& box) { return box.getWidth() < 120; }

void Look::drawComboBox(juce::Graphics& g, int width, int height, bool, int, int, int, int,
                        juce::ComboBox& box) {
    const auto area = juce::Rectangle<int>{width, height}.toFloat().reduced(0.5f);
    g.setColour(shade(box, Shade::raised).brighter(box.isMouseOver(true) ? 0.08f : 0.0f));
    g.fillRoundedRectangle(area, corner);
    juce::Path arrow;
    const float x = area.getRight() - (isNarrow(box) ? 9.0f : 14.0f), y = area.getCentreY();
    arrow.addTriangle(x - 4.0f, y - 2.0f, x + 4.0f, y - 2.0f, x, y + 3.0f);
    g.setColour(shade(box, Shade::muted));
    g.fillPath(arrow);
}

// JUCE's default halves its contrast.
void Look::drawComboBoxTextWhenNothingSelected(juce::Graphics& g, juce::ComboBox& box, juce::Label& label) {
    g.setColour(shade(box, Shade::muted));
    g.setFont(getLabelFont(label));
    g.drawText(box.getTextWhenNothingSelected(), label.getBorderSize().subtractedFrom(label.getBounds()),
               label.getJustificationType(), true);
}

void Look::positionComboBoxText(juce::ComboBox& box, juce::Label& label) {
    const bool narrow = isNarrow(box);
    label.setBounds(narrow ? 0 : 6, 0, box.getWidth() - (narrow ? 13 : 24), box.getHeight()); // to the arrow
    label.setBorderSize({1, 5, 1, 0});
    label.setFont(narrow ? text::font(text::small) : getComboBoxFont(box));
}

void Look::drawLinearSlider(juce::Graphics& g, int x, int y, int width, int height, float place, float, float,
                            juce::Slider::SliderStyle style, juce::Slider& slider) {
    const auto area = juce::Rectangle<int>{x, y, width, height}.toFloat();
    if (isTrue(slider, faderProperty)) return drawFader(g, area, place, slider);
    if (slider.isBar()) return drawBar(g, area, place, slider);
    const bool isUpright = style == juce::Slider::LinearVertical;
    const auto track = isUpright ? area.withSizeKeepingCentre(4.0f, area.getHeight())
                                 : area.withSizeKeepingCentre(area.getWidth(), 4.0f);
    g.setColour(shade(slider, Shade::raised));
    g.fillRoundedRectangle(track, 2.0f);
    g.setColour(tintOf(slider).withMultipliedAlpha(slider.isEnabled() ? 1.0f : 0.4f));
    g.fillRoundedRectangle(isUpright ? track.withTop(place) : track.withRight(place), 2.0f);
    g.setColour(shade(slider, Shade::text));
    g.fillEllipse(juce::Rectangle<float>{13.0f, 13.0f}.withCentre(
        isUpright ? juce::Point<float>{area.getCentreX(), place}
                  : juce::Point<float>{place, area.getCentreY()}));
}

juce::Label* Look::createSliderTextBox(juce::Slider& slider) {
    auto* box = juce::LookAndFeel_V4::createSliderTextBox(slider);
    if (slider.isBar()) box->setFont(text::font(text::small));
    return box;
}

void Look::drawRotarySlider(juce::Graphics& g, int x, int y, int width, int height, float place, float start,
                            float end, juce::Slider& slider) {
    const auto dial = juce::Rectangle<int>{x, y, width, height}.toFloat().withSizeKeepingCentre(
        static_cast<float>(std::min(width, height)) - 4.0f,
        static_cast<float>(std::min(width, height)) - 4.0f);
    const auto centre = dial.getCentre();
    const float radius = 0.5f * dial.getWidth(), angle = start + place * (end - start);
    g.setColour(shade(slider, Shade::well));
    g.fillEllipse(dial);
    g.setColour(shade(slider, Shade::line));
    g.drawEllipse(dial, 1.5f);
    const auto tip = centre.getPointOnCircumference(radius - 6.0f, angle);
    g.setColour(tintOf(slider));
    g.drawLine({centre, tip}, 3.0f);
    g.fillEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(tip));
}

// Within JUCE's bounds, which are those of bold text, in one size: drawFittedText would make it smaller.
void Look::drawTooltip(juce::Graphics& g, const juce::String& tip, int width, int height) {
    const juce::Rectangle<int> area{width, height};
    g.fillAll(findColour(juce::TooltipWindow::backgroundColourId));
    g.setColour(findColour(juce::TooltipWindow::outlineColourId));
    g.drawRect(area);
    juce::AttributedString words;
    words.append(tip, text::font(text::small), findColour(juce::TooltipWindow::textColourId));
    words.draw(g, area.toFloat().reduced(5.0f, 2.0f));
}

std::unique_ptr<juce::FocusOutline> Look::createFocusOutlineForComponent(juce::Component&) {
    struct Ring final : juce::FocusOutline::OutlineWindowProperties {
        juce::Rectangle<int> getOutlineBounds(juce::Component& c) override {
            focused = &c;
            constexpr int handle = 30; // a fader's scale begins beside it
            auto ring = c.getScreenBounds().expanded(2);
            if (c.getProperties()[faderProperty]) ring = ring.withSizeKeepingCentre(handle, ring.getHeight());
            const auto* parent = c.getParentComponent(); // which clips the outline
            return parent ? ring.getIntersection(parent->getScreenBounds()) : ring;
        }
        void drawOutline(juce::Graphics& g, int width, int height) override {
            if (focused != nullptr) g.setColour(shade(*focused, Shade::accent)); // of the current theme
            g.drawRoundedRectangle(juce::Rectangle<int>{width, height}.toFloat().reduced(1.0f), corner + 1.0f,
                                   2.0f);
        }
        juce::Component::SafePointer<juce::Component> focused;
    };
    return std::make_unique<juce::FocusOutline>(std::make_unique<Ring>());
}

} // namespace physvib
