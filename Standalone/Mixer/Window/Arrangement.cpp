// SPDX-License-Identifier: GPL-3.0-or-later
// Divides the window between world, tabs, scope and strips.
#include "Mixer/Window/Arrangement.h"
#include "Mixer/Window/Parts.h"
#include "Mixer/World/WorldPanel.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr double least = 0.05, most = 0.95;

int between(int lowest, int value, int highest) {
    return std::max(lowest, std::min(value, highest)); // a small window keeps the lowest
}

int shareOr(double share, int whole, int automatic) {
    return share > 0.0 ? juce::roundToInt(share * whole) : automatic;
}

} // namespace

juce::String Dividers::text() const {
    return juce::String{side, 4} + " " + juce::String{lower, 4} + " " + juce::String{strips, 4};
}

Dividers Dividers::of(const juce::String& text) {
    const auto words = juce::StringArray::fromTokens(text, " ", {});
    const auto share = [&](int k) {
        const double value = words[k].getDoubleValue();
        return value >= least && value <= most ? value : 0.0;
    };
    return {share(0), share(1), share(2)};
}

Arrangement arrange(juce::Rectangle<int> area, const Wanted& wanted, const Dividers& dividers) {
    using A = Arrangement;
    Arrangement a;
    const int width = area.getWidth(), height = area.getHeight();
    const int side = between(A::leastSide, shareOr(dividers.side, width, std::min(640, width * 39 / 100)),
                             width - A::leastSide - gap);
    // more height than this leaves bars above and below the field
    const auto useful =
        juce::roundToInt((width - side - gap - WorldPanel::besideField) / wanted.fieldAspect) +
        WorldPanel::aboveAndBelowField;
    const int automatic = between(std::min(292, height * 42 / 100), height - gap - useful, height * 42 / 100);
    const int lower = between(A::leastLower, shareOr(dividers.lower, height, automatic),
                              height - A::leastWorldHeight - gap);
    const int fair = std::min(std::max(wanted.leastStrips, width * 45 / 100), wanted.mostStrips);
    const int strips =
        between(A::leastStrips, shareOr(dividers.strips, width, std::min(fair, width * 70 / 100)),
                width - A::leastScope - gap);
    auto bottom = area.removeFromBottom(lower);
    a.lower = area.removeFromBottom(gap);
    a.tabs = area.removeFromRight(side);
    a.side = area.removeFromRight(gap);
    a.world = area;
    a.strips = bottom.removeFromRight(strips);
    a.between = bottom.removeFromRight(gap);
    a.scope = bottom;
    return a;
}

} // namespace physvib
