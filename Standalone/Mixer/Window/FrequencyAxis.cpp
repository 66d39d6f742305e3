// SPDX-License-Identifier: GPL-3.0-or-later
// Maps frequencies and levels to logarithmic axes, and draws spectra.
#include "Mixer/Window/FrequencyAxis.h"
#include "Core/Units.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <cmath>

namespace physvib {

double FrequencyAxis::shareOf(double hz) {
    return std::log(std::max(hz, 1e-3) / lowHz) / std::log(highHz / lowHz);
}
double FrequencyAxis::hzAt(double share) { return lowHz * std::pow(highHz / lowHz, share); }

SpectrumLevels spectrumLevels(std::span<const double> magnitudes, double binHz, double fullScale) {
    SpectrumLevels levels;
    const double half = 0.5 / (FrequencyAxis::points - 1),
                 last = static_cast<double>(magnitudes.size()) - 1.0;
    for (int k = 0; k < FrequencyAxis::points; ++k) {
        const double share = static_cast<double>(k) / (FrequencyAxis::points - 1);
        const double from = FrequencyAxis::hzAt(share - half) / binHz,
                     to = std::min(last, FrequencyAxis::hzAt(share + half) / binHz);
        const auto between = [&](double bin) { // at low frequencies the points are denser than the bins
            const auto i = static_cast<std::size_t>(bin);
            return i + 1 < magnitudes.size()
                       ? std::lerp(magnitudes[i], magnitudes[i + 1], bin - static_cast<double>(i))
                       : 0.0;
        };
        double highest = std::max(between(from), between(to));
        for (auto i = static_cast<std::size_t>(std::ceil(from)); i <= static_cast<std::size_t>(to); ++i)
            highest = std::max(highest, magnitudes[i]);
        const double db = toDecibels(std::max(highest / fullScale, 1e-9));
        levels[static_cast<std::size_t>(k)] = std::max(FrequencyAxis::floorDb, static_cast<float>(db));
    }
    return levels;
}

juce::Rectangle<int> drawFrequencyAxis(juce::Graphics& g, const juce::Component& component,
                                       juce::Rectangle<int> area) {
    const auto foot = area.removeFromBottom(16);
    g.setFont(juce::Font{text::small});
    for (const int hz : {20, 50, 100, 200, 500, 1000}) {
        const int x = area.getX() + juce::roundToInt(FrequencyAxis::shareOf(hz) * (area.getWidth() - 1));
        g.setColour(shade(component, Shade::line).withMultipliedAlpha(0.7f));
        g.drawVerticalLine(x, static_cast<float>(area.getY()), static_cast<float>(area.getBottom()));
        g.setColour(shade(component, Shade::muted));
        const auto words = hz == 1000 ? juce::String{"1k"} : juce::String{hz};
        const auto where = hz == 20     ? juce::Justification::centredLeft
                           : hz == 1000 ? juce::Justification::centredRight
                                        : juce::Justification::centred;
        g.drawText(words,
                   juce::Rectangle<int>{40, foot.getHeight()}
                       .withCentre({x, foot.getCentreY()})
                       .constrainedWithin(foot),
                   where, false);
    }
    return area;
}

void drawSpectrum(juce::Graphics& g, std::span<const float, FrequencyAxis::points> heights,
                  juce::Rectangle<float> area, juce::Colour colour) {
    juce::Path curve, ground;
    ground.startNewSubPath(area.getBottomLeft());
    for (std::size_t k = 0; k < heights.size(); ++k) {
        const juce::Point<float> p{area.getX() + area.getWidth() * static_cast<float>(k) /
                                                     static_cast<float>(heights.size() - 1),
                                   area.getBottom() - area.getHeight() * heights[k]};
        k == 0 ? curve.startNewSubPath(p) : curve.lineTo(p);
        ground.lineTo(p);
    }
    ground.lineTo(area.getBottomRight());
    ground.closeSubPath();
    g.setColour(colour.withAlpha(0.14f));
    g.fillPath(ground);
    g.setColour(colour);
    g.strokePath(curve, juce::PathStrokeType{1.5f});
}

} // namespace physvib
