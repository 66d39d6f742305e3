// SPDX-License-Identifier: MIT
// Grains of a scrape, counted: how many pass in a second, how evenly, and how strong they are.
#pragma once
#include <cstddef>
#include <optional>
#include <span>

namespace physvib {

/// What the pulses of a scrape tell (ScrapePulses.h).
struct GrainTrain {
    double perSecond = 0.0;
    double strength = 0.0;   ///< mean; 1 = full scale
    double unevenness = 0.0; ///< standard deviation of the spacings, in spacings: 0 for ridges, 0.37 for
                             ///< random grains
    double lostShare = 0.0;  ///< of the grains: too weak for the noise, or too near another. They are counted
                             ///< in, by what chance makes of grains
    std::size_t counted = 0;
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of what rings

    /// Any thread. Between the two it is neither, and not to be believed.
    bool isEven() const noexcept { return unevenness <= 0.15; }
    bool isRandom() const noexcept { return unevenness >= 0.3; }
};

/// By the width of pulses at which fewest are lost. None if fewer than 20 stand out, or more than 30 % are
/// lost. M only.
std::optional<GrainTrain> grainTrain(std::span<const double> samples, double rateHz);

} // namespace physvib
