// SPDX-License-Identifier: GPL-3.0-or-later
// A bar per enchanter, in its colour, with its level in dB; what is not connected is a hatched place.
#pragma once
#include "PluginProcessor.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

class MeterView final : public juce::Component {
public:
    MeterView() { setOpaque(true); }

    /// M.
    void update(const PluginMeters& meters, const LayoutDescription& layout);
    void paint(juce::Graphics& g) override;

private:
    PluginMeters meters_;
    std::vector<juce::String> labels_;
};

} // namespace physvib
