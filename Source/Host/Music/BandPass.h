// SPDX-License-Identifier: GPL-3.0-or-later
// Band-pass filter that keeps the band an actuator can render: two Butterworth slopes of fourth order.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include <algorithm>
#include <array>
#include <span>

namespace physvib {

/// Causal; its group delay at 200 Hz is 2 ms with the default band. One thread at a time.
class BandPass {
public:
    static constexpr FrequencyBand usual{50.0, 500.0};

    /// The upper cut-off is at most 45 % of the sample rate.
    BandPass(FrequencyBand band, int sampleRateHz) noexcept {
        const double highHz = std::min(band.highHz, 0.45 * sampleRateHz),
                     lowHz = std::min(band.lowHz, 0.5 * highHz);
        for (std::size_t i = 0; i < qs.size(); ++i) {
            // low-pass: zeros at half the sample rate; high-pass: zeros at 0 Hz
            sections_[2 * i] = section(highHz, qs[i], {2.0, 1.0}, 1.0, sampleRateHz);
            sections_[2 * i + 1] = section(lowHz, qs[i], {-2.0, 1.0}, -1.0, sampleRateHz);
        }
    }

    void process(std::span<float> samples) noexcept {
        for (float& sample : samples) {
            double y = sample;
            for (Biquad& section : sections_) y = section.process(y);
            sample = static_cast<float>(y);
        }
    }

private:
    static constexpr std::array qs{0.54119610014619698, 1.3065629648763766};

    /// A biquad with these zeros and a gain of 1 where z is `unity`.
    static Biquad section(double hz, double q, RootPair zeros, double unity, double rateHz) noexcept {
        const RootPair poles = RootPair::bilinear(hz, q, rateHz);
        return {(poles.at(unity) / zeros.at(unity)).real(), zeros, poles};
    }

    std::array<Biquad, 4> sections_;
};

} // namespace physvib
