// SPDX-License-Identifier: MIT
// Onsets of a live session, fitted one by one: all lie L after their collision, to a fiftieth of a frame,
// although the driver is delayed at random up to 50 ms and blocks vary from 1 to 2048 frames.
#include "FakeHost.h"
#include "Live/Session/Session.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib {
namespace {

using namespace test;
constexpr int seconds = 60;

double hit(const CollisionEvent& e, double t) {
    return t < 0 ? 0
                 : e.amplitude * std::sin(2 * std::numbers::pi * e.frequencyHz * t) *
                       std::exp(-e.decayPerSecond * t);
}

// The sum of all channels: each gain of Eq. 6.2 sums to 1 over the four corners, so the panning drops out.
std::vector<double> summed(const Interleaved& signal, std::int64_t delayFrames) {
    std::vector<double> sum;
    for (std::size_t at = static_cast<std::size_t>(delayFrames) * hostChannels;
         at + hostChannels <= signal.size(); at += hostChannels)
        sum.push_back(double(signal[at]) + signal[at + 1] + signal[at + 2] + signal[at + 3]);
    return sum;
}

// Least squares: how many frames later than expected must this event come to explain what the others leave.
double lateness(const CollisionEvent& e, const std::vector<double>& recorded,
                const std::vector<double>& expected) {
    const double onset = static_cast<double>(e.timeNs) * 1e-9, frame = 1.0 / hostRate;
    double product = 0, square = 0;
    const auto first = static_cast<std::size_t>(onset * hostRate) + 1;
    for (std::size_t n = first; n < first + 480 && n < recorded.size(); ++n) { // 10 ms
        const double t = static_cast<double>(n) / hostRate - onset;
        const double slope = hit(e, t - frame / 2) - hit(e, t + frame / 2); // per frame of lateness
        product += (recorded[n] - expected[n]) * slope;
        square += slope * slope;
    }
    return square > 0 ? product / square : 0;
}

double worstLateness(double longestGapSeconds, std::size_t& onsets) {
    auto setup = shakeTheBoxSetup(longestGapSeconds);
    setup.limiterEnabled = false;
    Session session{setup};
    std::vector<CollisionEvent> played;
    const auto signal = playLive(session, seconds * hostRate, 2048, 0.05, 7, played);
    const auto made =
        runScene(setup.scene, {setup.seed, setup.stepsPerSecond}, (seconds - 1) * 1'000'000'000LL).events;
    const auto recorded = summed(signal, session.timeline().outputLatencyFrames());
    const auto expected =
        closedForm(made, hostRate, 1, static_cast<int>(recorded.size()), [&](double x, double y, double* g) {
            const auto outside = [](double v, double extent) {
                return std::max({0.0, -v / extent, v / extent - 1});
            };
            // clamped factors
            g[0] = (1 - outside(x, setup.scene.fieldWidthMetres)) *
                   (1 - outside(y, setup.scene.fieldHeightMetres));
        });
    double worst = 0;
    onsets = made.size();
    for (const auto& e : made) worst = std::max(worst, std::abs(lateness(e, recorded, expected[0])));
    return worst;
}

TEST(Onsets, OfOverlappingHitsLieOneConstantAfterTheirCollisions) {
    std::size_t onsets = 0;
    const double worst = worstLateness(0.05, onsets);
    EXPECT_GE(onsets, 1000u);
    EXPECT_LE(worst, 0.02) << "frames";
    RecordProperty("worst_lateness_frames", std::to_string(worst));
    RecordProperty("onsets", std::to_string(onsets));
}

TEST(Onsets, WithoutAPlayOutDelayTheyWouldNot) {
    std::size_t onsets = 0;
    EXPECT_GT(worstLateness(-0.02, onsets), 0.02); // as if L did not cover gap and steps
}

} // namespace
} // namespace physvib
