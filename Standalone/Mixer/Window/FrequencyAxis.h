// SPDX-License-Identifier: GPL-3.0-or-later
// The axis of every spectrum that is shown: what is felt, each octave as wide as the next.
#pragma once
#include "Host/Views/Look.h"
#include <array>
#include <span>
#include <vector>

namespace physvib {

struct FrequencyAxis {
    static constexpr double lowHz = 20.0, highHz = 1000.0;
    static constexpr int points = 160;
    static constexpr float floorDb = -80.0f; ///< what is lower is not shown

    /// 0 to 1 from the left; outside for what is not felt.
    static double shareOf(double hz);
    static double hzAt(double share);
    static double hzOf(int point) { return hzAt(static_cast<double>(point) / (points - 1)); }
};

/// A level per point of the axis, in dB, not below the floor.
using SpectrumLevels = std::array<float, FrequencyAxis::points>;

/// From magnitudes of bins of `binHz`, the first at 0 Hz: the highest bin of those that a point stands for;
/// `fullScale` is 0 dB.
SpectrumLevels spectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale);

/// Lines and figures of the axis at the foot of `area`; what is left of it is for the curves.
juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area);

/// Heights of 0 to 1 per point, on a ground of the same colour.
void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::points> heights,
                  juce::Rectangle<float> area, juce::Colour colour);

} // namespace physvib
