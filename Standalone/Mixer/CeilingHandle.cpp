// SPDX-License-Identifier: GPL-3.0-or-later
// The meter's scale is the handle's way.
#include "Mixer/CeilingHandle.h"
#include "Files/Mix.h"
#include "Host/Views/MeterView.h"

namespace physvib {

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
    const int thumb = getLookAndFeel().getSliderThumbRadius(*this); // JUCE keeps so much free at both ends
    setMouseDragSensitivity(std::max(1, meter.getHeight())); // the mark stays under the hand
    setBounds(meter.withLeft(meter.getX() - room).expanded(0, thumb));
}

void CeilingHandle::paint(juce::Graphics& g) {
    const auto y = getPositionOfValue(getValue());
    juce::Path mark;
    mark.addTriangle(0.0f, y - 5.0f, 0.0f, y + 5.0f, static_cast<float>(room) - 2.0f, y);
    g.setColour(shade(*this, Shade::limit));
    g.fillPath(mark);
    g.fillRect(static_cast<float>(room) - 1.0f, y - 0.75f, static_cast<float>(getWidth() - room) + 1.0f, 1.5f);
}

} // namespace physvib
