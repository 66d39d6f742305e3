// SPDX-License-Identifier: MIT
// Pulses for machines: where they begin and end, and that they stand at the sample of what is felt, live and
// offline.
#include "Live/Session/OnsetMarks.h"
#include "FakeHost.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/Session.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::onset_marks_test {

using namespace test;

CollisionEvent hitAt(std::int64_t timeNs) {
    CollisionEvent e{.timeNs = timeNs, .frequencyHz = 205.0, .decayPerSecond = 60.0, .amplitude = 0.5};
    e.source.fixture = 3;
    return e;
}

/// Frames at which the signal rises.
std::vector<std::int64_t> edgesOf(const std::vector<float>& x) {
    std::vector<std::int64_t> edges;
    for (std::size_t n = 0; n < x.size(); ++n)
        if (x[n] > 0.5f && (n == 0 || x[n - 1] < 0.5f)) edges.push_back(static_cast<std::int64_t>(n));
    return edges;
}

std::vector<float> marked(OnsetMarks& marks, int frames, int block) {
    std::vector<float> out(static_cast<std::size_t>(frames));
    for (int done = 0; done < frames; done += block)
        marks.render(out.data() + done, std::min(block, frames - done));
    return out;
}

TEST(OnsetMarks, APulseLastsTwoMillisecondsOrRestsBeforeTheNext) {
    OnsetMarks marks{MarkedOnsets::all};
    marks.prepare(48000, 0);
    for (const std::int64_t frame : {100, 1000, 1030, 2000, 2024, 2100}) marks.addOnset(hitAt(0), frame);
    const auto out = marked(marks, 4800, 64);
    EXPECT_EQ(edgesOf(out), (std::vector<std::int64_t>{100, 1000, 1030, 2000, 2100}));
    EXPECT_EQ(marks.pulses(), 5u);
    EXPECT_EQ(marks.sharedOnsets(), 1u) << "24 frames are half a millisecond";
    for (int n = 100; n < 196; ++n) EXPECT_EQ(out[static_cast<std::size_t>(n)], 1.0f) << n;
    EXPECT_EQ(out[196], 0.0f);
    EXPECT_EQ(out[1017], 1.0f);
    for (int n = 1018; n < 1030; ++n)
        EXPECT_EQ(out[static_cast<std::size_t>(n)], 0.0f) << n << ": a quarter of a millisecond";
}

TEST(OnsetMarks, OnlyTheWantedOnesAndNoSegmentOfALongerTone) {
    CollisionEvent hit = hitAt(0), grain = hit, message = hit, segment = hit;
    grain.source.kind = ContactKind::roll;
    message.source = {};
    segment.source = {};
    segment.course.toneAgeNs = 1;
    const auto made = [&](MarkedOnsets which) {
        OnsetMarks marks{which};
        marks.prepare(48000, 0);
        for (std::int64_t frame = 0; const CollisionEvent& e : {hit, grain, message, segment})
            marks.addOnset(e, frame += 1000);
        return edgesOf(marked(marks, 4800, 4800));
    };
    EXPECT_EQ(made(MarkedOnsets::all), (std::vector<std::int64_t>{1000, 2000, 3000}));
    EXPECT_EQ(made(MarkedOnsets::hits), (std::vector<std::int64_t>{1000}));
    EXPECT_EQ(made(MarkedOnsets::messages), (std::vector<std::int64_t>{3000}));
}

TEST(OnsetMarks, ABlockOfTheMostOnsetsKeepsThemAll) {
    OnsetMarks marks{MarkedOnsets::all};
    marks.prepare(limits::minSampleRateHz, -4);
    for (std::int64_t frame = 0; frame < limits::maxBlockFrames; ++frame) marks.addOnset(hitAt(0), frame);
    EXPECT_EQ(marks.pulses(), 2048u);
    EXPECT_EQ(edgesOf(marked(marks, limits::maxBlockFrames, limits::maxBlockFrames)).size(), 2047u);
}

SessionSetup quietSetup() {
    auto setup = emptyBoxSetup(0.02);
    ActuatorLayout one;
    layoutPreset("phone1", one);
    setup.panner = {one, PanningLaw::linear, 1, setup.scene.fieldWidthMetres, setup.scene.fieldHeightMetres};
    setup.channels = 1;
    setup.marks = MarkedOnsets::all;
    return setup;
}

/// What a live session plays of these strikes: the enchanter's samples, and the marks.
std::array<std::vector<float>, 2> playedLive(const std::vector<CollisionEvent>& strikes, int block,
                                             int rate) {
    Session session{quietSetup()};
    session.prepare(rate, block);
    EXPECT_TRUE(session.submit({Strikes{strikes}, 0}));
    std::array<std::vector<float>, 2> all;
    for (auto& x : all) x.resize(static_cast<std::size_t>(rate / block * block));
    for (int done = 0; done + block <= rate; done += block) {
        session.advance();
        float* const at[] = {all[0].data() + done, all[1].data() + done};
        session.render(at, block, RenderMode::realtime);
    }
    for (auto& x : all) x.erase(x.begin(), x.begin() + session.timeline().outputLatencyFrames());
    return all;
}

TEST(OnsetMarks, AMarkAndItsOnsetAreOnTheSameSampleWhateverTheBlockAndOffline) {
    for (const int rate : {44100, 48000}) {
        // on a frame, and between two
        const std::int64_t atNs[] = {100'000'000, 300'000'007, 500'010'000, 700'123'457};
        std::vector<CollisionEvent> strikes;
        for (const auto at : atNs) strikes.push_back(hitAt(at));
        std::vector<float> offline, offlineMarks;
        OnsetMarks marks{MarkedOnsets::all};
        OfflineSettings settings{
            {.sampleRateHz = rate, .channels = 1, .panner = quietSetup().panner}, rate, 333};
        settings.marks = &marks;
        renderOffline(strikes, settings, [&](const float* const* at, int n) {
            offline.insert(offline.end(), at[0], at[0] + n);
            offlineMarks.insert(offlineMarks.end(), at[1], at[1] + n);
            return true;
        });
        const FrameClock clock{rate};
        const auto edges = edgesOf(offlineMarks);
        ASSERT_EQ(edges.size(), std::size(atNs));
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const FramePosition onset = clock.at(atNs[k]);
            EXPECT_EQ(edges[k], onset.frame) << "the first frame at or after it";
            // a sine begins with 0
            const auto frame = static_cast<std::size_t>(onset.frame) + (onset.leadFrames > 0.0 ? 0 : 1);
            EXPECT_GT(std::abs(offline[frame]), 1e-9f) << k;
            if (k == 0) EXPECT_LT(std::abs(offline[frame - 1]), 1e-9f);
        }
        for (const int block : {1, 64, 1000, 8192}) {
            const auto live = playedLive(strikes, block, rate);
            for (std::size_t n = 0; n < live[0].size(); ++n) {
                ASSERT_EQ(live[0][n], offline[n]) << block << ", frame " << n;
                ASSERT_EQ(live[1][n], offlineMarks[n]) << block << ", frame " << n;
            }
        }
    }
}

TEST(OnsetMarks, WhatIsNotPlayedIsNotMarked) {
    CollisionEvent tooHigh = hitAt(100'000'000);
    tooHigh.frequencyHz = 19'000.0; // of 32 kHz
    const auto live = playedLive({tooHigh, hitAt(200'000'000)}, 64, 32000);
    EXPECT_EQ(edgesOf(live[1]), (std::vector<std::int64_t>{6400}));
}

// Onsets of a live session, fitted one by one: all lie L after their collision, to a fiftieth of a frame,
// although the driver is delayed at random up to 50 ms and blocks vary from 1 to 2048 frames.

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
        simulateScene(setup.scene, {setup.seed, setup.stepsPerSecond}, (seconds - 1) * 1'000'000'000LL)
            .events;
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

} // namespace physvib::onset_marks_test
