// SPDX-License-Identifier: MIT
// Stevens' power law: magnitude = factor * level^exponent, by least squares of logarithms.
#pragma once
#include <span>
#include <string>

namespace physvib {

struct MagnitudeTrial {
    double level = 0.0, magnitude = 0.0; ///< both > 0; the level linear (g, not dB)
};

struct PowerLaw {
    std::string fault; ///< one line; then nothing else holds
    double exponent = 0.0, factor = 1.0;
    double determination = 0.0; ///< r squared of the logarithms
};

/// Of one participant's trials; exponents are averaged over participants, whose factors are their own choice.
/// Any thread.
PowerLaw fitPowerLaw(std::span<const MagnitudeTrial> trials);

} // namespace physvib
