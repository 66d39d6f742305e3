// SPDX-License-Identifier: GPL-3.0-or-later
// What a strip may drive its actuator with at most: a mark on the strip's meter that is dragged.
#pragma once
#include "Host/Views/Look.h"

namespace physvib {

/// Its value is in dB of full scale. It has to be dragged: a click, a double click or the wheel move nothing, since hands
/// are attached to what it bounds.
class CeilingHandle final : public juce::Slider {
public:
    explicit CeilingHandle(const juce::String& label);
    /// Over a meter of that place. M.
    void placeOver(juce::Rectangle<int> meter);
    void paint(juce::Graphics& g) override;

private:
    static constexpr int room = 10; // left of the meter, for the mark
};

} // namespace physvib
