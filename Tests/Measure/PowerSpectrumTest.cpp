// SPDX-License-Identifier: MIT
// Where energy lies among frequencies, of samples that come in blocks.
#include "Measure/PowerSpectrum.h"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace physvib {
namespace {

std::vector<float> sine(double hz, int rateHz, double amplitude, int frames) {
    std::vector<float> x(static_cast<std::size_t>(frames));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = static_cast<float>(amplitude *
                                  std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(n) / rateHz));
    return x;
}

std::vector<double> sharesOf(PowerSpectrum& spectrum, const std::vector<std::vector<float>>& channels,
                             int block) {
    for (std::size_t at = 0; at < channels.front().size(); at += static_cast<std::size_t>(block)) {
        std::vector<const float*> from;
        for (const auto& channel : channels) from.push_back(channel.data() + at);
        spectrum.add(from.data(), static_cast<int>(std::min(static_cast<std::size_t>(block),
                                                            channels.front().size() - at)));
    }
    return spectrum.finish();
}

double shareAround(const std::vector<double>& shares, double hz, double binHz) {
    double sum = 0.0;
    for (std::size_t k = 0; k < shares.size(); ++k)
        if (std::abs(static_cast<double>(k) * binHz - hz) <= 2.0 * binHz) sum += shares[k];
    return sum;
}

TEST(PowerSpectrum, TellsTheEnergiesOfChannelsApartByTheirFrequencies) {
    for (const int rateHz : {5000, 8000, 44100, 48000, 192000}) {
        PowerSpectrum spectrum{rateHz, 3};
        const auto shares = sharesOf(spectrum,
                                     {sine(100.0, rateHz, 0.3, rateHz), sine(250.0, rateHz, 0.4, rateHz),
                                      sine(600.0, rateHz, 0.5, rateHz)},
                                     1000);
        EXPECT_GE(spectrum.binHz(), 7.9);
        EXPECT_LE(spectrum.binHz(), 16.0);
        EXPECT_NEAR(shareAround(shares, 100.0, spectrum.binHz()), 0.18, 0.01) << rateHz;
        EXPECT_NEAR(shareAround(shares, 250.0, spectrum.binHz()), 0.32, 0.01) << rateHz;
        EXPECT_NEAR(shareAround(shares, 600.0, spectrum.binHz()), 0.50, 0.01) << rateHz;
        EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-9);
    }
}

TEST(PowerSpectrum, IsTheSameInBlocksOfAnySize) {
    const std::vector<std::vector<float>> channels{sine(80.0, 48000, 0.3, 20'000),
                                                   sine(160.0, 48000, 0.2, 20'000)};
    PowerSpectrum whole{48000, 2}, parts{48000, 2};
    EXPECT_EQ(sharesOf(whole, channels, 20'000), sharesOf(parts, channels, 7));
}

TEST(PowerSpectrum, HasNoSharesOfSilenceAndHearsAClickAtTheVeryEnd) {
    PowerSpectrum silent{48000, 2}, click{48000, 1};
    EXPECT_EQ(sharesOf(silent, {std::vector<float>(9000), std::vector<float>(9000)}, 256).front(), 0.0);
    std::vector<float> last(9000);
    last.back() = 1.0f;
    EXPECT_GT(sharesOf(click, {last}, 256)[100], 0.0);
}

} // namespace
} // namespace physvib
