// SPDX-License-Identifier: MIT
// Removes the material's resonance from the recording of a scrape, so that one pulse per grain remains.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace physvib {

/// A grain that excites A exp(-tau t) sin(omega t) gives a pulse of height A, with the shape of the smoothing
/// kernel.
struct ScrapePulses {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of the resonance
    std::vector<double> heights;                    ///< positive at grains, 0 between them
    double heightsPerSecond = 0.0;
    double skewness = 0.0; ///< of the heights: that of noise is 0
};

/// Smooths `samples` over halfWidthSeconds to both sides. x'' + 2 tau x' + (omega^2 + tau^2) x is the
/// excitation by grains alone; tau and omega are chosen so that it is 0 most of the time. None if no decaying
/// sinusoid fits, or if the width is only a few samples. Message thread (M) only.
std::optional<ScrapePulses> scrapePulses(std::span<const double> samples, double rateHz,
                                         double halfWidthSeconds);

/// x', smoothed over halfWidthSeconds to both sides: one value for each sample where the kernel fits. M only.
std::vector<double> smoothSlope(std::span<const double> samples, double rateHz, double halfWidthSeconds);

} // namespace physvib
