// SPDX-License-Identifier: MIT
// Implementation: two channels are transformed as one complex signal z = a + ib, because |Z(k)|^2 + |Z(-k)|^2
// = 2 (|A(k)|^2 + |B(k)|^2).
#include "Measure/PowerSpectrum.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace physvib {

struct PowerSpectrum::State {
    using Bins = std::vector<std::complex<float>>;
    struct Pair {
        Bins window;            // its second half is being filled
        float sums[2] = {0, 0}; // sums of the frames that are averaged to the next sample
    };

    State(int sampleRateHz, int count)
        : framesPerSample{std::max(1, sampleRateHz / keptRateHz)}
        , rateHz{static_cast<double>(sampleRateHz) / framesPerSample}
        , hop{std::bit_floor(static_cast<unsigned>(rateHz)) / 16}
        , channels{count}
        , pairs(static_cast<std::size_t>(count + 1) / 2, Pair{Bins(2 * hop), {}})
        , power(hop + 1) {
        for (std::size_t i = 0; i < 2 * hop; ++i)
            hann.push_back(static_cast<float>(
                0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(hop))));
    }

    /// All sums are complete: appends a sample at `kept` of the second half.
    void next() {
        for (Pair& pair : pairs) {
            pair.window[hop + kept] =
                std::complex{pair.sums[0], pair.sums[1]} / static_cast<float>(framesPerSample);
            pair.sums[0] = pair.sums[1] = 0.0f;
        }
        summed = 0;
        if (++kept < hop) return;
        for (Pair& pair : pairs) transform(pair.window);
        kept = 0;
    }

    void transform(Bins& window) {
        if (std::ranges::any_of(window, [](const auto& z) { return z != std::complex<float>{}; })) {
            for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i] = hann[i] * window[i];
            fft.fwd(bins, weighted);
            for (std::size_t k = 0; k < hop; ++k)
                power[k] +=
                    static_cast<double>(std::norm(bins[k]) + std::norm(bins[(2 * hop - k) % (2 * hop)])) *
                    (k == 0 ? 0.5 : 1.0);
            power[hop] += static_cast<double>(std::norm(bins[hop])); // like 0 Hz, its own mirror
        }
        std::copy(window.begin() + static_cast<std::ptrdiff_t>(hop), window.end(), window.begin());
    }

    int framesPerSample;
    double rateHz;
    std::size_t hop;
    int channels;
    std::vector<Pair> pairs;
    std::vector<double> power;
    std::vector<float> hann;
    Bins weighted = Bins(2 * hop), bins;
    Eigen::FFT<float> fft;
    int summed = 0;
    std::size_t kept = 0;
};

PowerSpectrum::PowerSpectrum(int sampleRateHz, int channels)
    : state_{std::make_unique<State>(sampleRateHz, channels)} {}
PowerSpectrum::~PowerSpectrum() = default;
PowerSpectrum::PowerSpectrum(PowerSpectrum&&) noexcept = default;

double PowerSpectrum::binHz() const noexcept { return state_->rateHz / static_cast<double>(2 * state_->hop); }

void PowerSpectrum::add(const float* const* channels, int frames) {
    State& s = *state_;
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, s.framesPerSample - s.summed);
        for (int j = 0; j < s.channels; ++j) {
            float& sum = s.pairs[static_cast<std::size_t>(j) / 2].sums[j % 2];
            for (int k = done; k < done + part; ++k) sum += channels[j][k];
        }
        done += part;
        s.summed += part;
        if (s.summed == s.framesPerSample) s.next();
    }
}

std::vector<double> PowerSpectrum::finish() {
    // zeros, until the last sample has been in two windows
    for (std::size_t rest = 2 * state_->hop - state_->kept; rest > 0; --rest) state_->next();
    std::vector<double> shares = std::move(state_->power);
    double whole = 0.0;
    for (const double power : shares) whole += power;
    if (whole > 0.0)
        for (double& share : shares) share /= whole;
    return shares;
}

} // namespace physvib
