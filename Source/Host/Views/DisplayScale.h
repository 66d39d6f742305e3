// SPDX-License-Identifier: GPL-3.0-or-later
// How large the display is in metres: what a hand drags on it is measured by that.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

constexpr double leastDisplayMetres = 0.03, mostDisplayMetres = 30.0; // a watch, a wall

constexpr bool isDisplayWidth(double metres) noexcept {
    return metres >= leastDisplayMetres && metres <= mostDisplayMetres;
}

/// The display that most of `component` is on; without one, a picture of the component's own size. M.
inline juce::Rectangle<int> displayOf(const juce::Component& component) {
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return display != nullptr ? display->totalArea : component.getTopLevelComponent()->getLocalBounds();
}

/// Pixels of `component` per metre of the display that it is on, which is `displayMetres` wide; 0: as the
/// system says. M.
inline double screenPixelsPerMetre(const juce::Component& component, double displayMetres) {
    if (displayMetres > 0.0) return displayOf(component).getWidth() / displayMetres;
    constexpr double usualDpi = 96.0, metresPerInch = 0.0254; // where the system does not say
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return (display != nullptr && display->dpi > 0.0 ? display->dpi / display->scale : usualDpi) /
           metresPerInch;
}

} // namespace physvib
