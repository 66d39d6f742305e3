// SPDX-License-Identifier: MIT
// A scrape without its material's ringing: what is left is a pulse for each grain.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace physvib {

/// A grain that strikes A exp(-tau t) sin(omega t) is a pulse of height A, of the smoothing's shape.
struct ScrapePulses {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of what rings
    std::vector<double> heights;                    ///< upwards, 0 between grains
    double heightsPerSecond = 0.0;
    double skewness = 0.0; ///< of the heights: noise has none
};

/// `samples` are smoothed over halfWidthSeconds to both sides; x'' + 2 tau x' + (omega^2 + tau^2) x, which is
/// nothing but the blows, then has the tau and omega that leave most of the time as nothing. None if no
/// decaying sinusoid does, or where the width is less than a few samples. M only.
std::optional<ScrapePulses> scrapePulses(std::span<const double> samples, double rateHz,
                                         double halfWidthSeconds);

/// x', smoothed over halfWidthSeconds to both sides: one value for each sample that has so many on both. M
/// only.
std::vector<double> smoothSlope(std::span<const double> samples, double rateHz, double halfWidthSeconds);

} // namespace physvib
