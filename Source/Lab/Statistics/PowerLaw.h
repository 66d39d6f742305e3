// SPDX-License-Identifier: MIT
// Stevens' power law, magnitude = factor * level^exponent, fitted by least squares of logarithms.
#pragma once
#include <span>
#include <string>

namespace physvib {

struct MagnitudeTrial {
    double level = 0.0, magnitude = 0.0; ///< both > 0; the level is linear (g, not dB)
};

struct PowerLaw {
    std::string fault; ///< error in one line; if set, the rest is invalid
    double exponent = 0.0, factor = 1.0;
    double determination = 0.0; ///< r squared of the regression of logarithms
};

/// Fits one participant's trials. Average exponents over participants, but not factors, since each
/// participant chooses the scale. Any thread.
PowerLaw fitPowerLaw(std::span<const MagnitudeTrial> trials);

} // namespace physvib
