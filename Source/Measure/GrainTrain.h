// SPDX-License-Identifier: MIT
// Counts the grains in the recording of a scrape: rate, regularity and strength.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace physvib {
/// Estimates from the pulses of a scrape.
struct GrainTrain {
    double perSecond = 0.0;
    double strength = 0.0;   ///< mean; 1 = full scale
    double unevenness = 0.0; ///< standard deviation of the spacings, in spacings: ridges 0, at random 0.37
    double lostShare = 0.0;  ///< estimated share of grains that were missed, too weak for the noise or too
                             ///< close to another. perSecond and strength are corrected for them
    std::size_t counted = 0;
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of the material's vibration

    /// Any thread. A value in between is neither, and unreliable.
    bool isEven() const noexcept { return unevenness <= 0.15; }
    bool isRandom() const noexcept { return unevenness >= 0.3; }
};

/// Uses the pulse width at which fewest grains are lost. None if fewer than 20 stand out, or more than 30 %
/// are lost. Message thread (M) only.
std::optional<GrainTrain> grainTrain(std::span<const double> samples, double rateHz);

// Removes the material's resonance from the recording of a scrape, so that one pulse per grain remains.

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
