// SPDX-License-Identifier: MIT
// Greedy approximation of an exponential: each chord is as long as its error allows, so chords become longer
// as the exponential falls.
#include "Formats/DecayCurve.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

/// The largest distance of exp(-s) from its chord over [0, u]; it lies where the slopes are equal.
double chordError(double u) {
    const double slope = -std::expm1(-u) / u;
    return 1.0 - slope * (1.0 - std::log(slope));
}

/// The longest u whose chord stays within `error`; the error grows with u.
double longestChord(double error) {
    double low = 0.0, high = 1.0;
    while (chordError(high) < error) high *= 2.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (chordError(middle) < error ? low : high) = middle;
    }
    return low;
}

constexpr double lastChord = 6.0; // from so many errors to 0, a line that meets the exponential at one error
                                  // stays within one

} // namespace

std::vector<ClipPoint> decayCurve(double amplitude, double decayPerSecond, std::int64_t endTick, double error,
                                  int ticksPerSecond) {
    const auto at = [=](std::int64_t tick, double value) {
        return ClipPoint{static_cast<double>(tick) / ticksPerSecond, value};
    };
    std::vector<ClipPoint> curve{at(0, amplitude)};
    const double decayPerTick = decayPerSecond / ticksPerSecond;
    const auto ticksOf = [=](double u) {
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(u / decayPerTick, 9e15)));
    };
    for (std::int64_t tick = 0; tick < endTick;) {
        const double left = std::exp(-decayPerTick * static_cast<double>(tick));
        if (decayPerTick > 0.0 && left <= lastChord * error) {
            const std::int64_t last = tick + ticksOf(std::log(std::max(1.0, left / error)));
            if (last <= endTick) {
                curve.push_back(at(last, 0.0));
                return curve;
            }
        }
        tick = decayPerTick > 0.0
                   ? std::min(endTick, tick + ticksOf(longestChord(std::min(error / left, 0.5))))
                   : endTick;
        curve.push_back(at(tick, amplitude * std::exp(-decayPerTick * static_cast<double>(tick))));
    }
    return curve;
}

} // namespace physvib
