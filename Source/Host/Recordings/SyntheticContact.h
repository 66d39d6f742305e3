// SPDX-License-Identifier: GPL-3.0-or-later
// A contact that nobody recorded, to rehearse what needs recordings: partials of a struck body and a noise of the impact.
#pragma once
#include "Study/SeededRandom.h"
#include <cmath>
#include <numbers>
#include <vector>

namespace physvib {

/// Six partials above `frequencyHz`, inharmonic as those of a struck bar (assumed: about the square roots of 1, 2, 4, 6, 9, 13; the
/// seed moves them), higher ones weaker and shorter, and 3 ms of noise. At most a second; the same for the same
/// arguments. Any thread.
inline std::vector<float> syntheticContact(double frequencyHz, double decayPerSecond, std::uint32_t seed, int sampleRateHz) {
    constexpr double ratios[] = {1.0, 1.41, 2.0, 2.45, 3.0, 3.61}, noiseSeconds = 0.003;
    SeededRandom random{seed, "contact"};
    std::vector<float> samples(static_cast<std::size_t>(sampleRateHz * std::min(1.0, 7.0 / decayPerSecond))); // to -60 dB
    double weight = 1.0, decay = decayPerSecond;
    for (const double ratio : ratios) {
        const double f = frequencyHz * ratio * (ratio > 1.0 ? 0.96 + 0.08 * random.uniform() : 1.0), a = weight * (0.7 + 0.6 * random.uniform());
        if (f < 0.45 * sampleRateHz)
            for (std::size_t n = 0; n < samples.size(); ++n) {
                const double t = static_cast<double>(n) / sampleRateHz;
                samples[n] += static_cast<float>(a * std::sin(2.0 * std::numbers::pi * f * t) * std::exp(-decay * t));
            }
        weight *= 0.6;
        decay *= 1.4;
    }
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] += static_cast<float>(0.3 * random.normal() * std::exp(-static_cast<double>(n) / (noiseSeconds * sampleRateHz)));
    return samples;
}

} // namespace physvib
