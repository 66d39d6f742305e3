// SPDX-License-Identifier: GPL-3.0-or-later
// Slider ranges that emphasise the perceivable values of a parameter.
#pragma once
#include <cmath>
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

/// Logarithmic range: the middle 90 % of the slider cover the perceivable values from `low` to `high`, and
/// its ends the rest of the possible ones.
inline juce::NormalisableRange<double> feltRange(double least, double low, double high, double most) {
    constexpr double end = 0.05;
    const auto part = [](double from, double to, double share) { return from * std::pow(to / from, share); };
    const auto shareOf = [](double from, double to, double value) {
        return std::log(value / from) / std::log(to / from);
    };
    return {least, most,
            [=](double, double, double s) {
                return s < end         ? part(least, low, s / end)
                       : s > 1.0 - end ? part(high, most, (s - 1.0 + end) / end)
                                       : part(low, high, (s - end) / (1.0 - 2.0 * end));
            },
            [=](double, double, double v) {
                return v < low    ? end * shareOf(least, low, v)
                       : v > high ? 1.0 - end + end * shareOf(high, most, v)
                                  : end + (1.0 - 2.0 * end) * shareOf(low, high, v);
            }};
}

/// The same, with 0 at the left end.
inline juce::NormalisableRange<double> feltRangeWithZero(double least, double low, double high, double most) {
    const auto felt = feltRange(least, low, high, most);
    return {0.0, most, [=](double, double, double s) { return s <= 0.0 ? 0.0 : felt.convertFrom0to1(s); },
            [=](double, double, double v) { return v < least ? 0.0 : felt.convertTo0to1(v); }};
}

} // namespace physvib
