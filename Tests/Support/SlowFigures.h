// SPDX-License-Identifier: MIT
// What a coil is warmed by, measured after the fact: the worst mean of 250 ms, and the worst rms below 5 Hz
// of one second.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace physvib::test {

struct SlowFigures {
    double mean = 0.0, rms = 0.0;
    void join(const SlowFigures& other) {
        mean = std::max(mean, other.mean);
        rms = std::max(rms, other.rms);
    }
};

/// Of one channel; before and after it there is silence.
inline SlowFigures slowFigures(std::span<const float> samples, int rate) {
    SlowFigures worst;
    const std::size_t window = static_cast<std::size_t>(rate) / 4, bin = static_cast<std::size_t>(rate) / 100;
    std::vector<double> sums(samples.size() + window + 1);
    for (std::size_t n = 0; n + 1 < sums.size(); ++n)
        sums[n + 1] = sums[n] + (n < samples.size() ? double(samples[n]) : 0.0);
    for (std::size_t n = 1; n < sums.size(); ++n)
        worst.mean = std::max(worst.mean, std::abs(sums[n] - sums[n - std::min(n, window)]) /
                                              static_cast<double>(window));
    // Bins of 10 ms through a windowed sinc of 2 s, cut off at 5 Hz.
    constexpr int taps = 201, half = taps / 2;
    std::vector<double> sinc(taps), bins(2 * half, 0.0);
    double all = 0.0;
    for (int k = 0; k < taps; ++k) {
        const double x = 2.0 * std::numbers::pi * 5.0 * (k - half) / 100.0,
                     w = std::numbers::pi * (k - half) / half;
        all += sinc[static_cast<std::size_t>(k)] =
            (k == half ? 1.0 : std::sin(x) / x) * (0.5 + 0.5 * std::cos(w));
    }
    for (std::size_t n = 0; n < samples.size(); n += bin)
        bins.push_back((sums[std::min(n + bin, samples.size())] - sums[n]) / static_cast<double>(bin));
    bins.resize(bins.size() + 2 * half, 0.0);
    std::vector<double> squares{0.0};
    for (std::size_t n = 0; n + taps <= bins.size(); ++n) {
        double y = 0.0;
        for (std::size_t k = 0; k < taps; ++k) y += sinc[k] * bins[n + k];
        squares.push_back(squares.back() + y * y / (all * all));
    }
    for (std::size_t n = 100; n < squares.size(); ++n)
        worst.rms = std::max(worst.rms, std::sqrt((squares[n] - squares[n - 100]) / 100.0));
    return worst;
}

} // namespace physvib::test
