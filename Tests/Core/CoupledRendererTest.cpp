// SPDX-License-Identifier: MIT
// Complex drives in a render: the closed form with a phase per channel, with and without a duration.
#include "Core/HapticRenderer.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "Support/Sets.h"
#include <complex>
#include <gtest/gtest.h>

namespace physvib {
namespace {

using test::gridLayout;

constexpr int rate = 48000, frames = 24000;

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
    const CollisionEvent e{.timeNs = 10'000'000,
                           .frequencyHz = 200.0,
                           .decayPerSecond = 0.0,
                           .amplitude = 0.5,
                           .x = 0.3,
                           .y = 0.0,
                           .durationNs = 100'000'000};
    const auto rendered = test::renderEvents({e}, settingsWith(mixing.view()), 5000);
    EXPECT_EQ(rendered.status.liveModes, 1);
    const auto whole = test::renderEvents({e}, settingsWith(mixing.view()), frames);
    for (const auto& channel : whole.channels)
        for (std::size_t n = 5280; n < channel.size(); ++n) ASSERT_EQ(channel[n], 0.0f) << n;
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

} // namespace
} // namespace physvib
