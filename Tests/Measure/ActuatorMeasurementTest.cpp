// SPDX-License-Identifier: MIT
// A sweep through the simulated actuator gives back what it was made of, under noise and delay; nothing else
// passes.
#include "Measure/ActuatorMeasurement.h"
#include "Support/SimulatedActuator.h"
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace physvib::actuator_measurement_test {

constexpr int rate = 48000;
const std::vector<float> sweep = makeSweep({.seconds = 2.0}, rate);

std::vector<float> recordingOf(const Resonator& r, double gain, int delayFrames, double noise,
                               unsigned seed = 1) {
    SimulatedActuator actuator{r, rate};
    std::mt19937 random{seed};
    std::normal_distribution<float> hiss;
    std::vector<float> out(sweep.size());
    for (std::size_t n = 0; n < out.size(); ++n) {
        const std::size_t from = n - static_cast<std::size_t>(delayFrames);
        out[n] = static_cast<float>(gain *
                                    actuator.process(from < n + 1 ? static_cast<double>(sweep[from]) : 0.0)) +
                 static_cast<float>(noise) * hiss(random);
    }
    return out;
}

TEST(ActuatorMeasurement, RecoversTheSimulatedActuators) {
    double worstHz = 0.0, worstQ = 0.0;
    for (const Resonator& r : {Resonator{205, 8}, {205, 25}, {230, 15}, {110, 2}, {60, 0.8}, {440, 5}})
        for (const double noise : {0.0, 0.005}) // 34 dB under the sweep
            for (const int delay : {517, 24000}) {
                const auto found = fitActuator(sweep, recordingOf(r, -0.3, delay, noise), rate);
                ASSERT_TRUE(found) << found.error;
                const auto& m = found.value;
                const double hz = std::abs(m.resonator.resonanceHz / r.resonanceHz - 1.0),
                             q = std::abs(m.resonator.q / r.q - 1.0);
                worstHz = std::max(worstHz, hz);
                worstQ = std::max(worstQ, q);
                EXPECT_LT(hz, 0.005) << r.resonanceHz << ' ' << r.q << ' ' << noise << ' ' << delay;
                EXPECT_LT(q, 0.05) << r.resonanceHz << ' ' << r.q << ' ' << noise << ' ' << delay;
                EXPECT_NEAR(m.gain, -0.3, 0.015);
                EXPECT_NEAR(m.delaySeconds, static_cast<double>(delay) / rate, 2e-4)
                    << r.resonanceHz << ' ' << r.q;
            }
    ::testing::Test::RecordProperty("worst_f0_percent", std::to_string(100.0 * worstHz));
    ::testing::Test::RecordProperty("worst_q_percent", std::to_string(100.0 * worstQ));
}

TEST(ActuatorMeasurement, TheBandIsWhereItIsLoud) {
    const MeasuredActuator m{{205, 8}, 1.0, 0.0, 0.0, rate};
    const auto band = m.bandWithin(10.0, {20, 1000});
    EXPECT_NEAR(std::abs(m.resonator.at(band.lowHz)), 0.316, 0.02);
    EXPECT_NEAR(std::abs(m.resonator.at(band.highHz)), 0.316, 0.02);
}

TEST(ActuatorMeasurement, WhatIsNoMeasurementIsRefused) {
    const auto good = recordingOf({205, 8}, 0.3, 10, 0.0);
    const auto errorOf = [&](std::vector<float> recorded) {
        return fitActuator(sweep, recorded, rate).error;
    };
    EXPECT_EQ(errorOf(good), "");
    EXPECT_EQ(errorOf({0.1f}), "what was recorded: expected at least 0.1 s, found 1 sample");
    EXPECT_EQ(errorOf(std::vector<float>(good.size(), 0.0f)),
              "what was recorded: expected the sweep, found silence");
    auto bad = good;
    bad[4800] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(errorOf(bad), "what was recorded: expected finite samples, found NaN at 0.1000 s");
    bad = good;
    for (float& x : bad) x = std::clamp(x, -0.05f, 0.05f);
    EXPECT_NE(errorOf(bad).find("what was recorded: expected a recording that is not clipped"),
              std::string::npos)
        << errorOf(bad);
    std::mt19937 random{2};
    for (float& x : bad) x = 0.1f * std::normal_distribution<float>{}(random);
    EXPECT_NE(errorOf(bad).find("expected the response of a resonant actuator"), std::string::npos)
        << errorOf(bad);
    EXPECT_EQ(fitActuator(std::vector<float>(48000, 0.0f), good, rate).error,
              "what was played: expected a sweep, found silence");
}

TEST(ActuatorMeasurement, ACableTellsTheLatencyOfTheLoop) {
    std::mt19937 random{3};
    std::normal_distribution<float> hiss;
    for (const int delay : {0, 1, 517, 24000}) {
        std::vector<float> recorded(sweep.size());
        for (std::size_t n = 0; n < recorded.size(); ++n)
            recorded[n] =
                (n < static_cast<std::size_t>(delay) ? 0.0f
                                                     : -0.5f * sweep[n - static_cast<std::size_t>(delay)]) +
                0.005f * hiss(random);
        const auto found = fitLoopback(sweep, recorded, rate);
        ASSERT_TRUE(found) << found.error;
        EXPECT_NEAR(found.value.delaySeconds * rate, delay, 0.05);
        EXPECT_NEAR(found.value.gain, -0.5, 0.005);
        EXPECT_LT(found.value.residualShare, 0.02);
    }
    EXPECT_NE(fitLoopback(sweep, recordingOf({205, 8}, 0.3, 10, 0.0), rate)
                  .error.find("expected a cable from the output to the input"),
              std::string::npos);
    EXPECT_EQ(fitLoopback(sweep, std::vector<float>(sweep.size(), 0.0f), rate).error,
              "what was recorded: expected the sweep, found silence");
}

} // namespace physvib::actuator_measurement_test
