// SPDX-License-Identifier: GPL-3.0-or-later
// Draws icons as paths, and text on backgrounds.
#include "Mixer/Window/Parts.h"
#include "Host/Views/Palette.h"

namespace physvib {
namespace {

juce::Path pathOf(Sign sign) {
    juce::Path p;
    switch (sign) {
    case Sign::play: p.addTriangle(-4.0f, -6.0f, -4.0f, 6.0f, 6.0f, 0.0f); break;
    case Sign::pause:
        p.addRectangle(-5.0f, -6.0f, 3.5f, 12.0f);
        p.addRectangle(1.5f, -6.0f, 3.5f, 12.0f);
        break;
    case Sign::step:
        p.addTriangle(-6.0f, -5.5f, -6.0f, 5.5f, 2.0f, 0.0f);
        p.addRectangle(3.5f, -5.5f, 2.5f, 11.0f);
        break;
    case Sign::restart: {
        juce::Path arc;
        arc.addCentredArc(0.0f, 0.0f, 5.5f, 5.5f, 0.0f, -2.2f, 2.6f, true);
        juce::PathStrokeType{2.0f}.createStrokedPath(p, arc);
        p.addTriangle(-8.2f, -1.0f, -1.6f, -2.2f, -5.6f, -7.0f);
        break;
    }
    case Sign::save: // down into a tray
        p.addRectangle(-1.0f, -7.0f, 2.0f, 7.0f);
        p.addTriangle(-4.5f, -1.5f, 4.5f, -1.5f, 0.0f, 3.5f);
        p.addRectangle(-7.0f, 5.0f, 14.0f, 2.0f);
        break;
    case Sign::undo:
    case Sign::redo: {
        juce::Path arc;
        arc.addCentredArc(0.5f, 1.5f, 5.5f, 4.5f, 0.0f, -1.3f, 2.6f, true);
        juce::PathStrokeType{2.0f}.createStrokedPath(p, arc);
        p.addTriangle(-8.0f, 0.5f, -1.0f, 1.5f, -6.5f, -5.5f);
        if (sign == Sign::redo) p.applyTransform(juce::AffineTransform::scale(-1.0f, 1.0f));
        break;
    }
    case Sign::plus:
        p.addRectangle(-6.0f, -1.0f, 12.0f, 2.0f);
        p.addRectangle(-1.0f, -6.0f, 2.0f, 12.0f);
        break;
    case Sign::sweep: { // a wave of rising frequency
        juce::Path wave;
        wave.startNewSubPath(-9.0f, 0.0f);
        for (int k = 1; k <= 54; ++k) {
            const float t = static_cast<float>(k) / 54.0f;
            wave.lineTo(-9.0f + 18.0f * t,
                        -4.5f * std::sin(juce::MathConstants<float>::twoPi * (0.7f * t + 2.0f * t * t)));
        }
        juce::PathStrokeType{1.6f}.createStrokedPath(p, wave);
    }
    }
    return p;
}

} // namespace

SignButton::SignButton(Sign sign, const juce::String& name)
    : juce::Button{name}
    , sign_{sign} {
    setSign(sign, name);
}

void SignButton::setSign(Sign sign, const juce::String& name) {
    if (sign == sign_ && name == getTitle()) return;
    sign_ = sign;
    setTitle(name);
    setTooltip(name);
    repaint();
}

void SignButton::paintButton(juce::Graphics& g, bool isOver, bool isDown) {
    getLookAndFeel().drawButtonBackground(g, *this, {}, isOver, isDown);
    const bool isQuiet = getProperties()[quietProperty];
    g.setColour(shade(*this, !isEnabled()       ? Shade::muted
                             : getToggleState() ? Shade::well
                             : isQuiet          ? Shade::accent
                                                : Shade::text));
    g.fillPath(pathOf(sign_), juce::AffineTransform::translation(getLocalBounds().toFloat().getCentre()));
}

void TwoLines::set(const juce::String& first, const juce::String& second, Shade firstShade) {
    if (first == first_ && second == second_ && firstShade == shade_) return;
    first_ = first;
    second_ = second;
    shade_ = firstShade;
    setDescription(first + ", " + second);
    repaint();
}

void TwoLines::paint(juce::Graphics& g) {
    auto area = getLocalBounds();
    const auto line = [&](const juce::String& words, juce::Rectangle<int> row, Shade which) {
        g.setColour(shade(*this, which));
        g.setFont(juce::Font{text::small});
        g.drawText(words, row, juce::Justification::centredLeft, true);
    };
    line(first_, area.removeFromTop(getHeight() / 2), shade_);
    line(second_, area, Shade::muted);
}

void drawPanel(juce::Graphics& g, const juce::Component& component) {
    g.setColour(shade(component, Shade::panel));
    g.fillRoundedRectangle(component.getLocalBounds().toFloat(), 8.0f);
}

void drawCard(juce::Graphics& g, const juce::Component& component) {
    const auto area = component.getLocalBounds().toFloat();
    g.setColour(shade(component, Shade::raised));
    g.fillRoundedRectangle(area, 12.0f);
    g.setColour(shade(component, Shade::accent));
    g.drawRoundedRectangle(area.reduced(0.75f), 12.0f, 1.5f);
}

std::unique_ptr<juce::TextButton> quietButton(const juce::String& words, const juce::String& name) {
    auto button = std::make_unique<juce::TextButton>(words);
    button->setTitle(name);
    button->setTooltip(name);
    button->getProperties().set(quietProperty, true);
    return button;
}

void onSlide(juce::Slider& slider, std::function<void(bool)> use) {
    const auto isFirst = std::make_shared<bool>(true);
    slider.onDragStart = [isFirst] { *isFirst = true; };
    slider.onValueChange = [&slider, isFirst, use = std::move(use)] {
        use(slider.isMouseButtonDown() && !std::exchange(*isFirst, false));
    };
}

void prepareControls(juce::Component& root) {
    auto* slider = dynamic_cast<juce::Slider*>(&root);
    if (slider != nullptr) slider->setWantsKeyboardFocus(true);
    // also controls that are disabled now
    const bool isBox = dynamic_cast<juce::ComboBox*>(&root) != nullptr;
    const bool isControl = slider != nullptr || isBox || root.getWantsKeyboardFocus() ||
                           dynamic_cast<juce::Button*>(&root) != nullptr;
    if (isControl && root.getParentComponent() != nullptr) root.setHasFocusOutline(true);
    if (slider == nullptr && !isBox) // these handle their own children
        for (auto* child : root.getChildren()) prepareControls(*child);
}

void caption(juce::Label& label, const juce::String& words) {
    label.setText(words, juce::dontSendNotification);
    label.setFont(juce::Font{text::small});
    label.setBorderSize({0, 0, 0, 0});
}

juce::String number(double value, int decimals) { return readable::words(value, decimals); }

} // namespace physvib
