// SPDX-License-Identifier: GPL-3.0-or-later
// Places of the window's panels: pure arithmetic, so that every size can be tested without a window.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// Places of the dividers as shares of the width or height that they divide; 0: automatic.
struct Dividers {
    double side = 0.0;   ///< width of the tabs beside the world
    double lower = 0.0;  ///< height of the lower panels
    double strips = 0.0; ///< width of the strips beside the scope
    bool operator==(const Dividers&) const = default;

    juce::String text() const; ///< for the settings
    static Dividers of(const juce::String& text);
};

/// What the panels would like to have.
struct Wanted {
    double fieldAspect = 1.0; ///< width of the world's field by its height
    int leastStrips = 0;      ///< width at which all strips are in sight
    int mostStrips = 0;       ///< width at which they are as wide as they may be
};

/// Places in pixels of the window, below the bar.
struct Arrangement {
    juce::Rectangle<int> world, tabs, scope, strips;
    juce::Rectangle<int> side, lower, between; ///< the dividers' handles

    static constexpr int leastLower = 248, leastWorldHeight = 240, leastSide = 400, leastStrips = 300,
                         leastScope = 360;
};

/// Divides `area`. The world gets what its field can use; the lower panels get the rest, up to a share of the
/// height. Any thread.
Arrangement arrange(juce::Rectangle<int> area, const Wanted& wanted, const Dividers& dividers);

} // namespace physvib
