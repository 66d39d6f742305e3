// SPDX-License-Identifier: GPL-3.0-or-later
// Means of a few frames each; a transform when somebody looks.
#include "Mixer/Strips/SpectrumTrace.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {

namespace {

/// Hann, Oppenheim and Schafer 7.2; its sum is half its length.
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

void SpectrumTrace::setRate(int sampleRateHz) {
    framesPerSample_ = std::max(1, sampleRateHz / keptRateHz);
    keptRateHz_ = static_cast<double>(std::max(1, sampleRateHz)) / framesPerSample_;
    lanes_.assign(limits::maxEnchanters, {std::vector<float>(window), 0.0f});
    newest_ = summed_ = 0;
}

void SpectrumTrace::add(const float* const* channels, int heard, int frames) {
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, framesPerSample_ - summed_);
        const bool isFull = summed_ + part == framesPerSample_;
        for (std::size_t j = 0; j < static_cast<std::size_t>(heard); ++j) {
            Lane& lane = lanes_[j];
            for (int k = done; k < done + part; ++k) lane.sum += channels[j][k];
            if (isFull)
                lane.kept[static_cast<std::size_t>(newest_)] =
                    std::exchange(lane.sum, 0.0f) / static_cast<float>(framesPerSample_);
        }
        done += part;
        summed_ = isFull ? 0 : summed_ + part;
        if (isFull) newest_ = (newest_ + 1) % window;
    }
}

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
