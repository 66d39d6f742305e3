// SPDX-License-Identifier: GPL-3.0-or-later
// Physical size of the display, to convert mouse movements from pixels to metres.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

constexpr double leastDisplayMetres = 0.03, mostDisplayMetres = 30.0; // a watch, a wall

constexpr bool isDisplayWidth(double metres) noexcept {
    return metres >= leastDisplayMetres && metres <= mostDisplayMetres;
}

/// The display that shows most of `component`; without a display, the component's window. M.
inline juce::Rectangle<int> displayOf(const juce::Component& component) {
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return display != nullptr ? display->totalArea : component.getTopLevelComponent()->getLocalBounds();
}

/// Pixels of `component` per metre on its display, which is `displayMetres` wide; 0: use the resolution that
/// the system reports. M.
inline double screenPixelsPerMetre(const juce::Component& component, double displayMetres) {
    if (displayMetres > 0.0) return displayOf(component).getWidth() / displayMetres;
    constexpr double usualDpi = 96.0, metresPerInch = 0.0254; // if the system reports none
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return (display != nullptr && display->dpi > 0.0 ? display->dpi / display->scale : usualDpi) /
           metresPerInch;
}

} // namespace physvib
