// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the Fourier transform of the stored samples on demand.
#include "Measure/Spectrum.h"
#include "Mixer/Strips/SpectrumTrace.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

/// Hann window (Oppenheim and Schafer 7.2); its sum is half its length.
const std::vector<double>& hann() {
    static const std::vector<double> weights = [] {
        std::vector<double> w(SpectrumTrace::window);
        for (std::size_t i = 0; i < w.size(); ++i)
            w[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                        static_cast<double>(w.size()));
        return w;
    }();
    return weights;
}

} // namespace

SpectrumLevels SpectrumTrace::levels(int channel) const {
    const auto& kept = lanes_[static_cast<std::size_t>(channel)].kept;
    SpectrumLevels none;
    none.fill(FrequencyAxis::floorDb);
    if (std::ranges::all_of(kept, [](float x) { return std::abs(x) < 1e-4f; })) return none;
    std::vector<double> x(window);
    for (int i = 0; i < window; ++i)
        x[static_cast<std::size_t>(i)] =
            hann()[static_cast<std::size_t>(i)] *
            static_cast<double>(kept[static_cast<std::size_t>((newest_ + i) % window)]);
    const auto heights = magnitudes(x);
    // half of the weights' sum
    return spectrumLevels(heights, 0.5 * keptRateHz_ / static_cast<double>(heights.size() - 1),
                          0.25 * window);
}

} // namespace physvib
