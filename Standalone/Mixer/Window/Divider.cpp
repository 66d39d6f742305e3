// SPDX-License-Identifier: GPL-3.0-or-later
// Movements of a divider by mouse and keys.
#include "Mixer/Window/Divider.h"

namespace physvib {

Divider::Divider(const juce::String& title, bool isUpright)
    : isUpright_{isUpright} {
    setTitle(title);
    setTooltip(title + ": drag it; double click: automatic");
    setWantsKeyboardFocus(true);
    setMouseClickGrabsKeyboardFocus(false); // the world keeps its keys
    setHasFocusOutline(true);
    setMouseCursor(isUpright ? juce::MouseCursor::LeftRightResizeCursor
                             : juce::MouseCursor::UpDownResizeCursor);
}

bool Divider::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    constexpr int step = 16;
    const auto back = isUpright_ ? KeyPress::leftKey : KeyPress::upKey,
               forth = isUpright_ ? KeyPress::rightKey : KeyPress::downKey;
    if (key == back || key == forth) return onMove(key == forth ? step : -step), true;
    if (key == KeyPress::backspaceKey) return onReset(), true;
    return false;
}

void Divider::paint(juce::Graphics& g) {
    g.setColour(shade(*this, isMouseOverOrDragging() ? Shade::accent : Shade::muted));
    constexpr float length = 36.0f, thickness = 3.0f;
    const auto handle = getLocalBounds().toFloat().withSizeKeepingCentre(isUpright_ ? thickness : length,
                                                                         isUpright_ ? length : thickness);
    g.fillRoundedRectangle(handle, 1.5f);
}

// It moves under the mouse, so each distance from the middle is a new one.
void Divider::mouseDrag(const juce::MouseEvent& e) {
    const auto from = e.position - e.mouseDownPosition;
    onMove(juce::roundToInt(isUpright_ ? from.x : from.y));
}

void Divider::mouseDoubleClick(const juce::MouseEvent&) { onReset(); }

} // namespace physvib
