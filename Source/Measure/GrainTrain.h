// SPDX-License-Identifier: MIT
// Counts the grains in the recording of a scrape: rate, regularity and strength.
#pragma once
#include <cstddef>
#include <optional>
#include <span>

namespace physvib {

/// Estimates from the pulses of a scrape (ScrapePulses.h).
struct GrainTrain {
    double perSecond = 0.0;
    double strength = 0.0;   ///< mean; 1 = full scale
    double unevenness = 0.0; ///< standard deviation of the spacings, in spacings: 0 for ridges, 0.37 for
                             ///< random grains
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

} // namespace physvib
