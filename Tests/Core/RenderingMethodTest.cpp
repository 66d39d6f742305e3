// SPDX-License-Identifier: MIT
// RenderingMethod: each of the eight renders the closed form of what it fixes, and leaves the rest alone.
#include "Core/EventShaping.h"
#include "Core/HapticRenderer.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/Sets.h"
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace physvib::rendering_method_test {

constexpr int rate = 48000;

RenderingMethod named(const std::string& name) {
    RenderingMethod method;
    EXPECT_TRUE(parseRenderingMethod(name, method)) << name;
    return method;
}

RendererSettings oneEnchanter() {
    ActuatorLayout layout;
    layoutPreset("phone1", layout);
    return {rate, 1, PhantomPanner{layout, PanningLaw::linear, 1.0, 1.0, 1.0}, false};
}

test::Channels rendered(std::vector<CollisionEvent> events, const RenderingMethod& method,
                        int frames = rate) {
    for (CollisionEvent& e : events) e = method(e);
    return test::renderEvents(events, oneEnchanter(), frames).channels;
}

TEST(RenderingMethod, EachOfTheEightIsItsClosedForm) {
    const auto physics = test::randomEvents(200, 0.9, 5);
    for (const char a : {'V', 'F'})
        for (const char f : {'V', 'F'})
            for (const char d : {'V', 'F'}) {
                const std::string name = std::string{"A"} + a + "-F" + f + "-DR" + d;
                auto wanted = physics; // by hand, from the letters
                for (auto& e : wanted) {
                    if (a == 'F') e.amplitude = 1.5;
                    if (f == 'F') e.frequencyHz = 250.0;
                    if (d == 'F') e.decayPerSecond = 0.0;
                    if (d == 'F') e.durationNs = 20'000'000;
                }
                const auto sum =
                    test::closedForm(wanted, rate, 1, rate, [](double, double, double* g) { g[0] = 1.0; });
                EXPECT_LE(test::relativeError(sum, rendered(physics, named(name))), 1e-6) << name;
            }
}

TEST(RenderingMethod, AllVariedIsTheDefaultAndChangesNothing) {
    EXPECT_EQ(named("AV-FV-DRV"), RenderingMethod{});
    for (const CollisionEvent& e : test::randomEvents(500, 0.9, 6)) EXPECT_EQ(RenderingMethod{}(e), e);
}

TEST(RenderingMethod, TheFixedPulseLastsExactlyTwentyMilliseconds) {
    for (const std::int64_t onset : {10'000'000, 10'007'301}) { // on a frame, and between two
        const CollisionEvent hit{
            .timeNs = onset, .frequencyHz = 430, .decayPerSecond = 12, .amplitude = 0.01};
        const auto samples = rendered({hit}, named("AF-FF-DRF"), 4800).front();
        // the first frame not before it
        const auto first = static_cast<std::size_t>((onset * rate + 999'999'999) / 1'000'000'000);
        for (std::size_t n = 0; n < samples.size(); ++n)
            if (n < first || n >= first + 960) ASSERT_EQ(samples[n], 0.0f) << n;
        EXPECT_NE(samples[first + 959], 0.0f) << "20 ms are 960 frames";
        EXPECT_NEAR(*std::max_element(samples.begin(), samples.end()), 1.5, 1e-3);
        EXPECT_NEAR(samples[first + 959 - 48 * 4], samples[first + 959], 1e-5)
            << "rectangular: the last period is the one before";
    }
}

TEST(RenderingMethod, OtherNamesAreNone) {
    RenderingMethod method{true, true, true, 7.0};
    const RenderingMethod before = method;
    for (const char* name : {"", "AV", "AV-FV-DR", "AV-FV-DRX", "AX-FV-DRV", "av-fv-drv", "AVFFVFDRV",
                             "AV-FV-DRVV", "FV-AV-DRV", "AV-FF-DFV", "SV"})
        EXPECT_FALSE(parseRenderingMethod(name, method)) << name;
    EXPECT_EQ(method, before);
}

// Complex drives in a render: the closed form with a phase per channel, with and without a duration.

using test::gridLayout;

constexpr int frames = 24000;

struct Drives {
    std::vector<double> frequenciesHz;
    std::vector<Complex<double>> entries;
    DriveMatrices view() const { return {frequenciesHz, entries, 2}; }
};

/// Two channels that mix with phases, at one frequency.
const Drives mixing{{200.0}, {{1.0, 0.1}, {-0.3, 0.4}, {0.2, -0.5}, {0.9, 0.0}}};
const Drives identity{{200.0}, {{1.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}}};

RendererSettings settingsWith(const DriveMatrices& drives, InstructionSet set = InstructionSet::best) {
    RendererSettings s{rate, 2, PhantomPanner{gridLayout(2, 1), PanningLaw::linear, 1.0, 1.0, 1.0}, false};
    s.drives = drives;
    s.instructions = set;
    return s;
}

/// Im of the drive times exp((2 pi i f - tau) t), by hand.
test::Signal expected(const std::vector<CollisionEvent>& events, const Drives& drives) {
    test::Signal sum(2, std::vector<double>(frames));
    const PhantomPanner panner{gridLayout(2, 1), PanningLaw::linear, 1.0, 1.0, 1.0};
    for (const auto& e : events) {
        PhantomPanner::Gains g{};
        panner.gainsAt(e.x, e.y, g);
        for (std::size_t i = 0; i < 2; ++i) {
            std::complex<double> drive;
            for (std::size_t j = 0; j < 2; ++j)
                drive += g[j] * std::complex{drives.entries[2 * i + j].re, drives.entries[2 * i + j].im};
            for (int n = 0; n < frames; ++n) {
                const double t = static_cast<double>(n) / rate - static_cast<double>(e.timeNs) * 1e-9;
                if (t < 0.0 || (e.durationNs > 0 && t >= static_cast<double>(e.durationNs) * 1e-9) ||
                    e.decayPerSecond * t > 16.2)
                    continue;
                sum[i][static_cast<std::size_t>(n)] +=
                    e.amplitude * std::imag(drive * std::polar(std::exp(-e.decayPerSecond * t),
                                                               2.0 * std::numbers::pi * e.frequencyHz * t));
            }
        }
    }
    return sum;
}

TEST(CoupledRenderer, EqualsTheClosedFormWithAPhasePerChannel) {
    const auto events = test::randomEvents(60, 0.4, 1);
    for (const auto set : test::runnableSets()) {
        const auto rendered = test::renderEvents(events, settingsWith(mixing.view(), set), frames);
        EXPECT_EQ(rendered.status.played, 60u);
        EXPECT_EQ(rendered.status.rejected, 0u);
        EXPECT_LE(test::relativeError(expected(events, mixing), rendered.channels), 2e-6) << nameOf(set);
    }
}

TEST(CoupledRenderer, OneModePerMaterialAndSilenceWhenTheDurationIsOver) {
    const CollisionEvent e{10'000'000, 200.0, 0.0, 0.5, 0.3, 0.0, 100'000'000};
    const auto rendered = test::renderEvents({e}, settingsWith(mixing.view()), 5000);
    EXPECT_EQ(rendered.status.liveModes, 1);
    const auto whole = test::renderEvents({e}, settingsWith(mixing.view()), frames);
    for (const auto& channel : whole.channels)
        for (std::size_t n = 5280; n < channel.size(); ++n) ASSERT_EQ(channel[n], 0.0f) << n;
}

TEST(CoupledRenderer, AToneThatGoesNowhereIsTheStillStrike) {
    CollisionEvent e{.frequencyHz = 200.0, .amplitude = 0.5, .x = 0.3, .durationNs = 400'000'000};
    const auto still = expected({e}, mixing);
    e.course = {.toX = e.x, .toY = e.y, .travelNs = e.durationNs};
    EXPECT_LE(
        test::relativeError(still, test::renderEvents({e}, settingsWith(mixing.view()), frames).channels),
        1e-5);
}

TEST(CoupledRenderer, AnyBlockSizeGivesTheSameBits) {
    const auto events = test::randomEvents(100, 0.4, 2);
    const auto reference = test::renderEvents(events, settingsWith(mixing.view()), frames, {8192});
    for (const int block : {1, 17, 441})
        EXPECT_EQ(test::renderEvents(events, settingsWith(mixing.view()), frames, {block}).channels,
                  reference.channels)
            << block;
}

TEST(CoupledRenderer, DrivesThatChangeNothingChangeNoBit) {
    const auto events = test::randomEvents(100, 0.4, 3);
    const auto plain = test::renderEvents(events, settingsWith({}), frames);
    EXPECT_EQ(test::renderEvents(events, settingsWith(identity.view()), frames).channels, plain.channels);
}

TEST(CoupledRenderer, DrivesOfAnotherNumberOfEnchantersAreNotUsed) {
    const auto events = test::randomEvents(20, 0.4, 4);
    DriveMatrices other = mixing.view();
    other.channels = 1;
    EXPECT_EQ(test::renderEvents(events, settingsWith(other), frames).channels,
              test::renderEvents(events, settingsWith({}), frames).channels);
}

// A fixed level: lone hits peak at it, crowds never above it.

EventShaping heldAt(double level, const char* name) {
    EventShaping shaping;
    EXPECT_TRUE(parseRenderingMethod(name, shaping.method));
    shaping.method.fixedAmplitude = level;
    shaping.method.holdsLevel = true;
    return shaping;
}

CollisionEvent hitAt(double seconds, double hz, double decay) {
    CollisionEvent e{
        .timeNs = std::llround(seconds * 1e9), .frequencyHz = hz, .decayPerSecond = decay, .amplitude = 0.01};
    e.source.fixture = 0;
    return e;
}

double peakOf(const std::vector<CollisionEvent>& events, double seconds) {
    double peak = 0.0;
    for (double t = 0.0; t < seconds; t += 1.0 / 48000.0) {
        double sum = 0.0;
        for (const CollisionEvent& e : events) {
            const double since = t - 1e-9 * static_cast<double>(e.timeNs);
            if (since >= 0.0 && (e.durationNs == 0 || since < 1e-9 * static_cast<double>(e.durationNs)))
                sum += e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * since) *
                       std::exp(-e.decayPerSecond * since);
        }
        peak = std::max(peak, std::abs(sum));
    }
    return peak;
}

TEST(FixedLevel, ALoneHitPeaksAtItWhateverItsDecay) {
    for (const auto& [hz, decay] :
         {std::pair{80.0, 34.13}, {349.0, 106.99}, {430.0, 11.97}, {250.0, 1000.0}}) {
        EventShaper shaper{heldAt(0.75, "AF-FV-DRV")};
        EXPECT_NEAR(peakOf({shaper(hitAt(0.01, hz, decay))}, 0.1), 0.75, 0.0075) << hz;
    }
}

TEST(FixedLevel, ACrowdOfHitsIsNeverAboveItAndReachesIt) {
    for (const char* method : {"AF-FV-DRV", "AF-FV-DRF", "AF-FF-DRV", "AF-FF-DRF"}) {
        std::mt19937 random{7};
        std::exponential_distribution<double> gap{60.0};
        EventShaper shaper{heldAt(1.0, method)};
        std::vector<CollisionEvent> events;
        double t = 0.0;
        for (int n = 0; n < 60; ++n) {
            const bool isWood = random() % 2 == 0; // two materials that ring together
            events.push_back(shaper(hitAt(t, isWood ? 349.0 : 430.0, isWood ? 106.99 : 11.97)));
            if (n % 5 != 0) t += gap(random); // some at the same moment
        }
        const double peak = peakOf(events, t + 0.1);
        EXPECT_LE(peak, 1.0 + 1e-3) << method;
        EXPECT_GE(peak, 0.99) << method;
    }
}

TEST(FixedLevel, OfEachHitHasNoMeanWhereTheGuardWouldAct) {
    for (const char* method : {"AF-FV-DRV", "AF-FV-DRF"}) {
        EventShaping each = heldAt(0.75, method);
        each.method.holdsLevel = false;
        each.truncation = 0.1;
        const CollisionEvent rubber = hitAt(0.1, 80.0, 34.13);
        std::vector<CollisionEvent> hits{rubber, hitAt(0.0, 349.0, 106.99), rubber, hitAt(0.2, 430.0, 11.97)};
        EventShaper{each}.shape(hits, 1);
        ASSERT_EQ(hits.size(), 5U) << "rubber alone, and not before `first`";
        EXPECT_EQ(hits[2], each(rubber)) << "the hit itself stays";
        EXPECT_TRUE(isMeanCompensation(hits[3]) && hits[3].timeNs == rubber.timeNs);
        double area = 0.0;
        for (double t = 0.0; t < 1e-9 * static_cast<double>(hits[2].durationNs); t += 1e-6)
            for (const CollisionEvent& e : {hits[2], hits[3]})
                area += 1e-6 * e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * t) *
                        std::exp(-e.decayPerSecond * t);
        EXPECT_NEAR(area, 0.0, 1e-5) << method << ", of 0.0016 and 0.0027";
        EventShaper{heldAt(0.75, method)}.shape(hits);
        EXPECT_EQ(hits.size(), 5U) << "what is held is as it was";
    }
}

TEST(FixedLevel, StrikesAndVariedLevelsAreLeftAlone) {
    EventShaper shaper{heldAt(1.0, "AF-FV-DRV")}, varied{heldAt(1.0, "AV-FV-DRV")};
    CollisionEvent strike = hitAt(0.0, 200.0, 50.0);
    EXPECT_EQ(varied(strike), strike);
    strike.source.fixture = -1;
    EXPECT_EQ(shaper(strike).amplitude, 1.0) << "its A, as without a level that is held";
    shaper(hitAt(0.0, 200.0, 50.0));
    EXPECT_LT(shaper(hitAt(0.0, 200.0, 50.0)).amplitude, 1e-12);
    shaper.reset();
    EXPECT_GT(shaper(hitAt(0.0, 200.0, 50.0)).amplitude, 1.0) << "so that its first peak is 1";
}

} // namespace physvib::rendering_method_test
