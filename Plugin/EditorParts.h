// SPDX-License-Identifier: GPL-3.0-or-later
// Labels, backgrounds and distances common to the parts of the editor.
#pragma once
#include "Host/Views/Look.h"
#include <string_view>

namespace physvib {

constexpr int panelInset = 12, panelGap = 8;
constexpr auto number = readable::words;

inline juce::String words(std::string_view utf8) {
    return juce::String::fromUTF8(utf8.data(), static_cast<int>(utf8.size()));
}

/// A rounded ground. M.
inline void fillPanel(juce::Graphics& g, const juce::Component& component, juce::Rectangle<int> area) {
    g.setColour(shade(component, Shade::panel));
    g.fillRoundedRectangle(area.toFloat(), 8.0f);
}

} // namespace physvib
