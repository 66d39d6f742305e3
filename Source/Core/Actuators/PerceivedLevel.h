// SPDX-License-Identifier: MIT
// Frequency weighting of amplitudes towards equal perceived strength.
#pragma once
#include <algorithm>
#include <cmath>

namespace physvib {

/// Weights amplitudes, which are accelerations, towards what feels as strong at 250 Hz. The detection
/// threshold as a displacement is flat to 40 Hz and falls by 12 dB per octave to its minimum at about 250 Hz
/// (Verrillo 1963, large contactors at the thenar, as reported by Gescheider and Verrillo; unverified against
/// the paper, and displacement is assumed). Above that it rises; it is taken as flat here, the smallest
/// possible rise. Acceleration is (2 pi f)^2 times displacement: as an acceleration the threshold rises by 12
/// dB per octave, is flat from 40 to 250 Hz, and rises again. Half of it, in dB, is compensated, at most by a
/// factor of 2. Any thread.
struct PerceivedLevel {
    static constexpr double flatLowHz = 40.0, flatHighHz = 250.0; ///< constant threshold acceleration in
                                                                  ///< between
    static constexpr double greatestWeight = 2.0;                 ///< from 500 Hz on; its inverse up to 20 Hz

    bool isWeighted = false; ///< false: amplitudes stay unchanged

    /// Weight of a frequency > 0: sqrt((f / 40)^2) below 40 Hz, 1, sqrt((f / 250)^2) above 250 Hz; 0.5 to 2.
    static constexpr double weight(double frequencyHz) noexcept {
        const double nearest = std::clamp(frequencyHz, flatLowHz, flatHighHz);
        return std::clamp(frequencyHz / nearest, 1.0 / greatestWeight, greatestWeight);
    }

    /// The weighted amplitude. Weighting raises no amplitude above full scale, and none that already exceeds
    /// it.
    double operator()(double amplitude, double frequencyHz) const noexcept {
        if (!isWeighted) return amplitude;
        const double most = std::max(std::abs(amplitude), 1.0);
        return std::clamp(amplitude * weight(frequencyHz), -most, most);
    }
    bool operator==(const PerceivedLevel&) const = default;
};

/// Approximate detection threshold in g at a frequency, by the same curve: 0.1 um at 250 Hz (20 dB below 1
/// um) is 0.025 g. An assumption: people, places and contactors differ by 10 dB. Any thread.
constexpr double detectionThresholdG(double frequencyHz) noexcept {
    constexpr double lowestG = 0.025;
    const double share =
        frequencyHz / std::clamp(frequencyHz, PerceivedLevel::flatLowHz, PerceivedLevel::flatHighHz);
    return lowestG * share * share;
}

} // namespace physvib
