// SPDX-License-Identifier: MIT
// W_h against the standard's formula and table at every rate, and A(8) against its closed form.
#include "Core/Actuators/Exposure.h"
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

namespace physvib {
namespace {

constexpr double thirdOctaves[] = {8,   10,  12.5, 16,  20,  25,  31.5, 40,  50,  63,  80,
                                   100, 125, 160,  200, 250, 315, 400,  500, 630, 800, 1000};

double exactHz(double nominal) { return std::pow(10.0, std::round(10.0 * std::log10(nominal)) / 10.0); }

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

TEST(HandWeighting, IsWithinATenthOfADecibelOfTheFormulaAtEveryRate) {
    for (const int rate : {5000, 8000, 11025, 16000, 22050, 44100, 48000, 96000, 192000}) {
        const HandWeighting weighting{rate};
        double worst = 0.0;
        for (const double hz : thirdOctaves)
            for (const double at : {hz, exactHz(hz)})
                worst = std::max(worst, std::abs(decibels(weighting.gainAt(at) / handWeighting::gain(at))));
        EXPECT_LT(worst, 0.1) << rate << " Hz";
        std::cout << rate << " Hz: " << worst << " dB at most\n";
    }
}

TEST(HandWeighting, IsTheStandardsTable) { // ISO 5349-1, table A.2
    constexpr std::pair<double, double> table[] = {
        {6.3, 0.727}, {8, 0.873},    {10, 0.951},   {12.5, 0.958}, {16, 0.896},  {20, 0.782},
        {25, 0.647},  {31.5, 0.519}, {40, 0.411},   {63, 0.256},   {100, 0.160}, {125, 0.127},
        {160, 0.101}, {250, 0.0634}, {500, 0.0314}, {1000, 0.0135}};
    for (const auto& [hz, gain] : table)
        EXPECT_NEAR(decibels(handWeighting::gain(exactHz(hz)) / gain), 0.0, 0.1) << hz;
}

/// Squares of a sine of 1 full scale for so long, in blocks as a device asks for them.
double weightedSquare(int rate, double hz, double seconds, int block) {
    ExposureMeter meter;
    meter.prepare(rate);
    std::vector<float> samples(static_cast<std::size_t>(block));
    const auto frames = static_cast<std::int64_t>(seconds * rate);
    for (std::int64_t done = 0; done < frames; done += block) {
        for (int n = 0; n < block; ++n)
            samples[static_cast<std::size_t>(n)] = static_cast<float>(
                std::sin(2.0 * std::numbers::pi * hz * static_cast<double>((done + n) % rate) / rate));
        meter.take(0, samples.data(), static_cast<int>(std::min<std::int64_t>(block, frames - done)));
    }
    meter.publish();
    return meter.read().weighted[0];
}

TEST(ExposureMeter, AnHourOfOneGAt205HzIsTheClosedFormsDailyExposure) {
    constexpr double hourShare = 1.0 / 360.0; // ten seconds, as an hour is long in a test
    const double wanted =
        standardGravity / std::sqrt(2.0) * handWeighting::gain(205.0) * std::sqrt(1.0 / 8.0);
    for (const auto& [rate, block] : {std::pair{48000, 256}, {5000, 64}, {192000, 8192}}) {
        const double found =
            dailyExposure(weightedSquare(rate, 205.0, 3600.0 * hourShare, block) / hourShare);
        EXPECT_NEAR(found, wanted, 0.01 * wanted) << rate;
        if (rate == 48000)
            std::cout << "1 g at 205 Hz for an hour: A(8) " << found << " m/s^2, closed form " << wanted
                      << '\n';
    }
    EXPECT_NEAR(squareGSecondsOf(dailyExposure(123.0)), 123.0, 1e-9);
}

TEST(ExposureMeter, AddsNothingToSilence) {
    ExposureMeter meter;
    meter.prepare(48000);
    const std::vector<float> click{1.0f}, none(4800, 0.0f);
    meter.take(0, click.data(), 1);
    for (int i = 0; i < 100; ++i) meter.take(0, none.data(), 4800);
    meter.publish();
    const double weighted = meter.read().weighted[0];
    EXPECT_GT(weighted, 0.0);
    for (int i = 0; i < 100; ++i) meter.take(0, none.data(), 4800);
    meter.publish();
    EXPECT_EQ(meter.read().weighted[0], weighted);
}

} // namespace
} // namespace physvib
