// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing of meters, faders and ceiling handles, on a common dB scale.
#include "Host/Views/StripParts.h"
#include "Live/Documents/Mix.h"
#include <cmath>

namespace physvib {

void Fader::setUp(double least, double most, const juce::String& title, double byDefault) {
    setSliderStyle(LinearVertical);
    setSliderSnapsToMousePosition(false);
    setTextBoxStyle(NoTextBox, true, 0, 0);
    getProperties().set(faderProperty, true);
    setRange(least, most, 0.1);
    setSkewFactorFromMidPoint(-15.0);
    setTitle(title);
    setDoubleClickReturnValue(true, byDefault);
    textFromValueFunction = [](double db) {
        return db <= leastStripDb ? juce::String{"silent"} : readable::words(db, 1) + " dB";
    };
    setPopupDisplayEnabled(true, true, nullptr);
    setWantsKeyboardFocus(true);
}

void Fader::lieDown() {
    setSliderStyle(LinearHorizontal);
    getProperties().remove(faderProperty);
}

void Fader::resized() {
    juce::Slider::resized();
    const int margins = 2 * getLookAndFeel().getSliderThumbRadius(*this), // that JUCE keeps at the ends
        length = isHorizontal() ? getWidth() : getHeight();
    setMouseDragSensitivity(std::max(1, length - margins)); // the handle follows the pointer
}

PeakMeter::PeakMeter(const juce::String& title) { setTitle(title); }

void PeakMeter::set(float peak, float hold) {
    const float height = meterHeight(peak), held = meterHeight(hold);
    if (std::abs(height - peak_) < 0.004f && std::abs(held - hold_) < 0.004f) return;
    peak_ = height;
    hold_ = held;
    setDescription(peak > 0.001f ? readable::words(juce::Decibels::gainToDecibels(peak), 0) + " dB"
                                 : juce::String{"silent"});
    repaint();
}

void PeakMeter::paint(juce::Graphics& g) {
    const auto bar = getLocalBounds().toFloat();
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(bar, 3.0f);
    const auto green = palette::enchanter(3);
    const auto lit = bar.withTrimmedTop(bar.getHeight() * (1.0f - peak_));
    if (lit.getHeight() > 0.5f) {
        juce::ColourGradient ramp{green.darker(0.7f), bar.getBottomLeft(), palette::limit, bar.getTopLeft(),
                                  false};
        ramp.addColour(0.6, green);
        ramp.addColour(0.85, palette::now);
        g.setGradientFill(ramp);
        g.fillRoundedRectangle(lit, 3.0f);
    }
    if (hold_ <= 0.0f) return;
    g.setColour(shade(*this, Shade::text));
    g.fillRect(bar.getX() - 1.0f, bar.getY() + bar.getHeight() * (1.0f - hold_), bar.getWidth() + 2.0f, 2.0f);
}

static_assert(leastCeilingDb == meterFloorDb, "the handle moves along the whole meter");

CeilingHandle::CeilingHandle(const juce::String& label) {
    setSliderStyle(LinearVertical);
    setTextBoxStyle(NoTextBox, true, 0, 0);
    setRange(leastCeilingDb, 0.0, 0.5);
    setSliderSnapsToMousePosition(false);
    setScrollWheelEnabled(false);
    setDoubleClickReturnValue(false, 0.0);
    setPopupDisplayEnabled(true, true, nullptr);
    setMouseCursor(juce::MouseCursor::UpDownResizeCursor);
    setWantsKeyboardFocus(true);
    setTitle("Ceiling of " + label);
}

void CeilingHandle::placeOver(juce::Rectangle<int> meter) {
    const int thumb = getLookAndFeel().getSliderThumbRadius(*this); // JUCE keeps this margin at both ends
    setMouseDragSensitivity(std::max(1, meter.getHeight()));        // the mark follows the pointer
    setBounds(meter.withLeft(meter.getX() - room).expanded(0, thumb));
}

void CeilingHandle::paint(juce::Graphics& g) {
    const auto y = getPositionOfValue(getValue());
    juce::Path mark;
    mark.addTriangle(0.0f, y - 5.0f, 0.0f, y + 5.0f, static_cast<float>(room) - 2.0f, y);
    g.setColour(shade(*this, Shade::limit));
    g.fillPath(mark);
    g.fillRect(static_cast<float>(room) - 1.0f, y - 0.75f, static_cast<float>(getWidth() - room) + 1.0f,
               1.5f);
}

} // namespace physvib
