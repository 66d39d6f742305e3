// SPDX-License-Identifier: MIT
// OutputGuard against what is worst for a coil: what left is measured by another law than its own.
#include "Core/Actuators/OutputGuard.h"
#include "Core/Actuators/Exposure.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/SlowFigures.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace physvib::output_guard_test {

constexpr double most = limits::guardShare, turn = 2.0 * std::numbers::pi;
using Samples = std::vector<float>;
using Signal = std::function<double(double seconds)>;

Samples samplesOf(const Signal& signal, int rate, double seconds) {
    Samples all(static_cast<std::size_t>(seconds * rate));
    for (std::size_t n = 0; n < all.size(); ++n)
        all[n] = static_cast<float>(std::clamp(signal(static_cast<double>(n) / rate), -1.0, 1.0));
    return all;
}

/// What leaves, block by block.
Samples guarded(Samples samples, int rate, GuardPlace place = GuardPlace::rendered, int block = 100,
                InstructionSet set = InstructionSet::best) {
    const auto guard = std::make_unique<OutputGuard>();
    guard->prepare(rate, 1, place, set);
    for (std::size_t done = 0; done < samples.size(); done += static_cast<std::size_t>(block)) {
        float* at = samples.data() + done;
        guard->process(&at,
                       static_cast<int>(std::min(samples.size() - done, static_cast<std::size_t>(block))));
    }
    return samples;
}

Signal tone(double hz) {
    return [hz](double t) { return std::sin(turn * hz * t); };
}
Signal square(double hz) {
    return [hz](double t) { return std::sin(turn * hz * t) < 0.0 ? -1.0 : 1.0; };
}

std::vector<std::pair<std::string, Signal>> hazards() {
    std::vector<std::pair<std::string, Signal>> all;
    for (const double hz : {0.1, 0.5, 1.0, 2.0, 3.0, 4.0, 4.9, 6.0, 10.0, 14.0, 20.0, 25.0}) {
        all.emplace_back("tone of " + std::to_string(hz), tone(hz));
        all.emplace_back("square of " + std::to_string(hz), square(hz));
    }
    all.emplace_back("full scale", [](double) { return 1.0; });
    all.emplace_back("a little more than allowed", [](double) { return 0.055; });
    all.emplace_back("rectified 200 Hz", [](double t) { return std::abs(std::sin(turn * 200.0 * t)); });
    all.emplace_back("200 Hz, one side, 3 Hz", [](double t) {
        return std::max(0.0, std::sin(turn * 200.0 * t)) * std::sin(turn * 3.0 * t);
    });
    all.emplace_back("a pulse of 50 ms a second",
                     [](double t) { return std::fmod(t, 1.0) < 0.05 ? 1.0 : 0.0; });
    all.emplace_back("3 s of 4.5 Hz, 3 s of nothing",
                     [](double t) { return std::fmod(t, 6.0) < 3.0 ? std::sin(turn * 4.5 * t) : 0.0; });
    all.emplace_back("9 s of nothing, 1 s of 4 Hz",
                     [](double t) { return std::fmod(t, 10.0) < 9.0 ? 0.0 : std::sin(turn * 4.0 * t); });
    return all;
}

void expectWithin(const test::SlowFigures& figures, const std::string& name) {
    EXPECT_LE(figures.mean, most) << name;
    EXPECT_LE(figures.rms, most) << name;
}

TEST(OutputGuard, KeepsMeanAndWhatIsSlowWithinItsShareAtEveryRate) {
    for (const int rate : {5000, 8000, 44100, 48000, 192000})
        for (const auto& [name, signal] : hazards()) {
            if (rate == 192000 && name.starts_with("square")) continue;
            for (const auto place : {GuardPlace::rendered, GuardPlace::last})
                expectWithin(test::slowFigures(guarded(samplesOf(signal, rate, 12.0), rate, place), rate),
                             name + " at " + std::to_string(rate));
        }
}

/// One of many kinds of noise: sums of tones, pulses, random telegraphs, sweeps that decay.
Signal randomSignal(test::Random& random) {
    const double a = random.uniform(0, 2), b = random.uniform(0, 2), c = random.uniform(-0.5, 0.5),
                 d = random.uniform(0.1, 3.0), slow = random.uniform(0.1, 10),
                 fast = 0.1 + 30 * std::pow(random.uniform(0, 1), 2.0);
    const auto seed = static_cast<std::uint32_t>(random.uniform(1, 1e9));
    switch (static_cast<int>(random.uniform(0, 4))) {
    case 0:
        return [=](double t) { return a * std::sin(turn * fast * t) + b * std::sin(turn * slow * t) + c; };
    case 1:
        return [=](double t) { return std::fmod(t, d) < 0.5 * d * b ? a * std::sin(turn * fast * t) : c; };
    case 2:
        return [=, noise = std::make_shared<test::Random>(seed), value = 0.0, until = 0.0](double t) mutable {
            if (t >= until) until = t + 0.1 * noise->uniform(0, d), value = 3.0 * noise->uniform(-1, 1);
            return value;
        };
    default:
        return [=](double t) {
            return a * std::sin(turn * (fast + slow * std::sin(t)) * t) *
                   std::exp(-d * std::fmod(t, 1.0 + c));
        };
    }
}

TEST(OutputGuard, RandomSignalsDoNotPassIt) {
    test::Random random{50};
    test::SlowFigures worst;
    for (int i = 0; i < 400; ++i)
        worst.join(test::slowFigures(
            guarded(samplesOf(randomSignal(random), 8000, 5.0), 8000, GuardPlace::last), 8000));
    expectWithin(worst, "the worst");
    EXPECT_GT(worst.mean, 0.8 * most) << "it would turn down more than it must";
}

// It sees the gain, and pushes to one side for as long as it is open.
TEST(OutputGuard, AnAdversaryThatSeesTheGainDoesNotPassIt) {
    constexpr int rate = 8000;
    for (const float shut : {0.02f, 0.3f, 0.9f})
        for (const double holdSeconds : {0.0, 0.05, 0.12, 0.3}) {
            const auto guard = std::make_unique<OutputGuard>();
            guard->prepare(rate, 1, GuardPlace::last);
            Samples left(20 * rate);
            float side = 1.0f;
            int held = 0;
            for (float& x : left) {
                if (guard->gain() < shut && ++held > holdSeconds * rate) side = -side, held = 0;
                x = side;
                float* const at = &x;
                guard->process(&at, 1);
            }
            expectWithin(test::slowFigures(left, rate),
                         std::to_string(shut) + ' ' + std::to_string(holdSeconds));
        }
}

// What stops in the middle of a period has a mean as well.
TEST(OutputGuard, NoShorterStretchHoldsMore) {
    constexpr int rate = 8000;
    for (const auto& [name, signal] : hazards()) {
        const Samples left = guarded(samplesOf(signal, rate, 3.0), rate);
        std::vector<double> sums(left.size() + 1);
        for (std::size_t n = 0; n < left.size(); ++n) sums[n + 1] = sums[n] + double(left[n]) / rate;
        for (std::size_t n = 0; n + 2000 < sums.size(); n += 50) {
            const auto [low, high] =
                std::minmax_element(sums.begin() + static_cast<std::ptrdiff_t>(n),
                                    sums.begin() + static_cast<std::ptrdiff_t>(n + 2001));
            ASSERT_LE(*high - *low, most * limits::guardSeconds) << name;
        }
    }
}

TEST(OutputGuard, WhatIsFeltStaysAsItIs) {
    for (const int rate : {8000, 48000})
        for (const double hz : {40.0, 48.0, 80.0, 250.0, 1000.0}) {
            const Samples steady = samplesOf(tone(hz), rate, 3.0);
            EXPECT_TRUE(guarded(steady, rate) == steady) << hz << " Hz at " << rate;
            const auto hit = [hz](double t) {
                return std::sin(turn * hz * std::fmod(t, 0.5)) * std::exp(-12.0 * std::fmod(t, 0.5));
            };
            const Samples hits = samplesOf(hit, rate, 3.0);
            EXPECT_TRUE(guarded(hits, rate) == hits) << hz << " Hz at " << rate;
        }
    const Samples offset =
        samplesOf([](double t) { return 0.02 + 0.9 * std::sin(turn * 200.0 * t); }, 48000, 3.0);
    EXPECT_EQ(guarded(offset, 48000), offset);
}

// Turned down, and no more than it must: after three seconds one gain, so a sine stays a sine.
TEST(OutputGuard, ASlowToneIsWeakerAndKeepsItsShape) {
    constexpr int rate = 48000;
    for (const auto& [hz, share] : std::vector<std::pair<double, double>>{
             {1.0, 0.035}, {5.0, 0.04}, {10.0, 0.13}, {16.0, 0.4}, {20.0, 0.6}, {25.0, 0.78}, {30.0, 0.93}}) {
        const Samples in = samplesOf(tone(hz), rate, 6.0), out = guarded(in, rate);
        double inIn = 0.0, inOut = 0.0, outOut = 0.0;
        for (std::size_t n = 3 * rate; n < in.size(); ++n) {
            inIn += double(in[n]) * in[n];
            inOut += double(in[n]) * out[n];
            outOut += double(out[n]) * out[n];
        }
        const double gain = inOut / inIn;
        EXPECT_GT(gain, share) << hz;
        EXPECT_LT(std::sqrt(std::max(0.0, outOut / inIn - gain * gain)), 0.02)
            << hz << " Hz: what is no such tone";
    }
}

TEST(OutputGuard, NeitherBlocksNorInstructionSetsMatter) {
    for (const int rate : {44100, 48000}) { // tiles of 15 and of 16 frames
        Samples in = samplesOf(
            [](double t) { return std::sin(turn * 2.0 * t) + 0.3 * std::sin(turn * 90.0 * t); }, rate, 3.0);
        in[300] = 9.5f, in[7000] = -30.0f; // count as 8 times full scale
        const Samples out = guarded(in, rate);
        EXPECT_NE(in, out);
        for (const auto set : {InstructionSet::scalar, InstructionSet::sse4, InstructionSet::avx2})
            for (const int block : {1, 7, 64, 333, 8192})
                EXPECT_EQ(guarded(in, rate, GuardPlace::rendered, block, set), out)
                    << rate << block << nameOf(set);
    }
}

// From where it was to where it goes, of each channel by itself: else each tile begins with a step, and those
// of all tiles are a tone.
TEST(OutputGuard, TheGainGoesInALineThroughEachTileOfEachChannel) {
    for (const int rate : {8000, 44100, 48000, 192000}) {
        const int tile = static_cast<int>(std::lround(rate / 3000.0)), frames = rate / tile * tile;
        std::vector<Samples> together, alone;
        for (const double hz : {8.0, 0.5, 20.0}) {
            const auto guard = std::make_unique<OutputGuard>();
            guard->prepare(rate, 1, GuardPlace::last);
            const Samples& in = together.emplace_back(samplesOf(square(hz), rate, 1.0));
            float* at = alone.emplace_back(in).data();
            float start = 1.0f, end = 1.0f;
            for (int n = 0; n < frames; ++n) {
                if (float* const next = at + n; n % tile == 0) guard->process(&next, tile);
                const float share = static_cast<float>(n % tile + 1) / static_cast<float>(tile);
                ASSERT_NEAR(at[n], in[static_cast<std::size_t>(n)] * std::lerp(start, end, share), 1e-6)
                    << hz << " Hz at " << rate << ", frame " << n;
                if (n % tile == tile - 1) start = std::exchange(end, guard->gain());
            }
            EXPECT_LT(end, 0.9f) << hz << " Hz at " << rate;
        }
        const auto guard = std::make_unique<OutputGuard>();
        guard->prepare(rate, 3, GuardPlace::last);
        guard->process(std::array{together[0].data(), together[1].data(), together[2].data()}.data(), frames);
        EXPECT_TRUE(together == alone) << rate;
    }
}

TEST(OutputGuard, OpensAgainAndCountsHowOftenItActed) {
    constexpr int rate = 48000;
    const auto guard = std::make_unique<OutputGuard>();
    guard->prepare(rate, 2, GuardPlace::rendered);
    EXPECT_EQ(guard->gain(), 1.0f);
    for (int times = 1; times <= 2; ++times) {
        Samples slow(rate, 0.5f), felt = samplesOf(tone(200.0), rate, 1.0), silence(rate, 0.0f);
        const Samples before = felt;
        std::array<float*, 2> at{slow.data(), felt.data()};
        guard->process(at.data(), rate);
        EXPECT_LT(guard->gain(), 0.2f);
        EXPECT_EQ(felt, before) << "the other channel plays on";
        for (int second = 0; second < 2; ++second)
            at = {silence.data(), silence.data()}, guard->process(at.data(), rate, true);
        EXPECT_EQ(guard->gain(), 1.0f);
        EXPECT_EQ(guard->episodes(), static_cast<std::uint32_t>(times));
        Samples hit = samplesOf(tone(100.0), rate, 1.0);
        const Samples whole = hit;
        at = {hit.data(), hit.data()};
        guard->process(at.data(), rate);
        EXPECT_EQ(hit, whole);
    }
}

CollisionEvent slowAt(double seconds) { return {std::llround(seconds * 1e9), 1.0, 1.0, 1.0, 0.5, 0.5}; }

RendererSettings settingsFor(int channels) {
    return {.channels = channels,
            .panner = {test::gridLayout(channels, 1), PanningLaw::linear, 1.0, 1.0, 1.0}};
}

// Each of them may be played.
TEST(OutputGuard, StrikesThatAreSlowTogetherDoNotAddUp) {
    constexpr int rate = 48000, frames = 11 * rate;
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 44; ++i) events.push_back(slowAt(0.25 * i));
    const auto out = test::renderEvents(events, settingsFor(2), frames);
    for (const auto& channel : out.channels) expectWithin(test::slowFigures(channel, rate), "a channel");
    EXPECT_GT(out.status.guarded, 0U);
    EXPECT_EQ(test::renderEvents(events, settingsFor(2), frames, {1, 700, 64, 3}).channels, out.channels)
        << "blocks do not matter";
}

TEST(OutputGuard, ARenderWithoutTheLimiterIsRaw) {
    auto settings = settingsFor(1);
    settings.limiterEnabled = false;
    EXPECT_GT(test::slowFigures(test::renderEvents({slowAt(0.0)}, settings, 48000).channels[0], 48000).mean,
              0.3);
}

// W_h against the standard's formula and table at every rate, and A(8) against its closed form.

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
        meter.add(0, samples.data(), static_cast<int>(std::min<std::int64_t>(block, frames - done)));
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
    meter.add(0, click.data(), 1);
    for (int i = 0; i < 100; ++i) meter.add(0, none.data(), 4800);
    meter.publish();
    const double weighted = meter.read().weighted[0];
    EXPECT_GT(weighted, 0.0);
    for (int i = 0; i < 100; ++i) meter.add(0, none.data(), 4800);
    meter.publish();
    EXPECT_EQ(meter.read().weighted[0], weighted);
}

} // namespace physvib::output_guard_test
