// SPDX-License-Identifier: GPL-3.0-or-later
// Common frequency axis of all spectra: the range of vibration perception, in octaves of equal width.
#pragma once
#include "Host/Views/Look.h"
#include <array>
#include <span>
#include <vector>

namespace physvib {

struct FrequencyAxis {
    static constexpr double lowHz = 20.0, highHz = 1000.0;
    static constexpr int points = 160;
    static constexpr float floorDb = -80.0f; ///< lower levels are not drawn

    /// 0 to 1 from the left; outside that for frequencies out of range.
    static double shareOf(double hz);
    static double hzAt(double share);
    static double hzOf(int point) { return hzAt(static_cast<double>(point) / (points - 1)); }
};

/// Level in dB for each point of the axis, at least the floor.
using SpectrumLevels = std::array<float, FrequencyAxis::points>;

/// Converts magnitudes of bins with a spacing of `binHz`, the first at 0 Hz. Each point gets the highest bin
/// of its range; `fullScale` is 0 dB.
SpectrumLevels spectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale);

/// Draws lines and labels of the axis at the bottom of `area`, and returns the area left for curves.
juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area);

/// Draws heights of 0 to 1 per point as a filled curve.
void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::points> heights,
                  juce::Rectangle<float> area, juce::Colour colour);

} // namespace physvib
