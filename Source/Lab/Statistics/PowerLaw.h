// SPDX-License-Identifier: MIT
// Stevens' power law, magnitude = factor * level^exponent, fitted by least squares of logarithms.
#pragma once
#include <cmath>
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
inline PowerLaw fitPowerLaw(std::span<const MagnitudeTrial> trials) {
    const auto n = static_cast<double>(trials.size());
    double meanX = 0.0, meanY = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (const auto& trial : trials) {
        if (!(trial.level > 0.0) || !(trial.magnitude > 0.0)) return {"expected levels and magnitudes > 0"};
        meanX += std::log(trial.level) / n;
        meanY += std::log(trial.magnitude) / n;
    }
    for (const auto& trial : trials) {
        const double x = std::log(trial.level) - meanX, y = std::log(trial.magnitude) - meanY;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    if (!(xx > 1e-18)) return {"expected magnitudes of two or more levels"};
    const double exponent = xy / xx;
    return {{}, exponent, std::exp(meanY - exponent * meanX), yy > 0.0 ? xy * xy / (xx * yy) : 1.0};
}

} // namespace physvib
