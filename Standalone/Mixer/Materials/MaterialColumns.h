// SPDX-License-Identifier: GPL-3.0-or-later
// Columns in a row of the list of materials, and formatting of its numbers.
#pragma once
#include "Mixer/Window/TabPanel.h"

namespace physvib {

struct MaterialColumns {
    juce::Rectangle<int> dot, name, frequency, decay, length, sign;
    explicit MaterialColumns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        dot = row.removeFromLeft(22);
        sign = row.removeFromRight(34);
        const int number = std::min(92, row.getWidth() * 22 / 100);
        length = row.removeFromRight(number);
        decay = row.removeFromRight(number);
        frequency = row.removeFromRight(number);
        name = row;
    }
};

inline juce::String frequencyText(double hz) { return number(hz, 1); }
inline juce::String decayText(double perSecond) { return number(perSecond, 2); }

} // namespace physvib
