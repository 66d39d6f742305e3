// SPDX-License-Identifier: MIT
// The equaliser against the analogue resonator and the simulated actuator, as hard as both allow.
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Support/SimulatedActuator.h"
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace physvib::actuator_equaliser_test {

/// The actuators of the profiles, whose Q nobody printed, with some likely ones, and bands to ask of them.
using Case = EqualisedActuator;
constexpr Case cases[] = {{{205, 8}, {180, 230}}, {{205, 20}, {150, 300}}, {{230, 15}, {180, 300}},
                          {{110, 2}, {90, 1000}}, {{110, 3}, {60, 800}},   {{60, 0.3}, {40, 500}}};

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

template <class F>
void alongBand(const FrequencyBand& band, int steps, F f) {
    for (int i = 0; i <= steps; ++i)
        f(band.lowHz * std::pow(band.highHz / band.lowHz, static_cast<double>(i) / steps));
}

/// Amplitude of what `stage` makes of a sine, after it has settled: stage(sample, is it settled).
template <class Stage>
double amplitudeOf(Stage stage, double frequencyHz, int rate) {
    const int settle = rate, frames = rate; // whole periods at whole frequencies
    double re = 0.0, im = 0.0;
    for (int n = 0; n < settle + frames; ++n) {
        const double angle = 2.0 * std::numbers::pi * frequencyHz * n / rate,
                     y = stage(std::sin(angle), n >= settle);
        if (n >= settle) re += y * std::cos(angle), im += y * std::sin(angle);
    }
    return 2.0 * std::hypot(re, im) / frames;
}

TEST(SimulatedActuator, IsTheAnalogueResonator) {
    for (const Case& c : cases) {
        SimulatedActuator actuator{c.resonator, 48000};
        alongBand({20, 1000}, 40, [&](double hz) {
            EXPECT_NEAR(decibels(std::abs(actuator.at(hz, 48000) / c.resonator.at(hz))), 0.0, 0.02) << hz;
        });
    }
    EXPECT_NEAR(std::abs((Resonator{205, 20}.at(205))), 1.0, 1e-12);
    EXPECT_NEAR(std::abs((Resonator{205, 20}.at(1e6))), 0.05, 1e-4); // the plateau
}

TEST(SimulatedActuator, CutsItsDriveAtTheLimit) {
    SimulatedActuator strong{{205, 8}, 48000, 0.5}, weak{{205, 8}, 48000, 0.5};
    for (int n = 0; n < 1000; ++n)
        EXPECT_EQ(strong.process(n % 2 == 0 ? 9.0 : -9.0), weak.process(n % 2 == 0 ? 0.5 : -0.5));
}

TEST(ActuatorEqualiser, IsFlatInTheBandAtEveryRate) {
    for (const Case& c : cases)
        for (const int rate : {5000, 8000, 44100, 48000, 192000}) {
            const ActuatorEqualiser equaliser{c, rate};
            ASSERT_TRUE(equaliser.isOn());
            alongBand(c.band, 200, [&](double hz) {
                ASSERT_NEAR(decibels(std::abs(equaliser.at(hz) * c.resonator.at(hz))), 0.0, 0.35)
                    << hz << " at " << rate;
            });
        }
}

TEST(ActuatorEqualiser, TheSimulatedActuatorPlaysTheBandAtTheHighestLevelThatFits) {
    const int rate = 48000;
    for (const Case& c : cases) {
        ActuatorEqualiser equaliser{c, rate};
        const double level = equaliser.flatLevel();
        double worst = 0.0, unequalised = 0.0, peak = 0.0;
        alongBand(c.band, 12, [&](double exactHz) {
            const double hz = std::round(exactHz);
            SimulatedActuator actuator{c.resonator, rate}, plain{c.resonator, rate};
            ActuatorEqualiser one = equaliser;
            const double felt = amplitudeOf(
                [&](double x, bool isSettled) {
                    float drive = static_cast<float>(level * x);
                    one.process(&drive, 1, false);
                    if (isSettled) peak = std::max(peak, std::abs(static_cast<double>(drive)));
                    return actuator.process(static_cast<double>(drive));
                },
                hz, rate);
            worst = std::max(worst, std::abs(decibels(felt / level)));
            unequalised =
                std::max(unequalised,
                         std::abs(decibels(
                             amplitudeOf([&](double x, bool) { return plain.process(level * x); }, hz, rate) /
                             level)));
        });
        const std::string name =
            std::to_string(c.resonator.resonanceHz) + "_" + std::to_string(c.resonator.q);
        ::testing::Test::RecordProperty("equalised_dB_" + name, std::to_string(worst));
        ::testing::Test::RecordProperty("unequalised_dB_" + name, std::to_string(unequalised));
        ::testing::Test::RecordProperty("level_dB_" + name, std::to_string(decibels(level)));
        EXPECT_LT(worst, 1.0) << name;
        EXPECT_GT(unequalised, 2.0) << name;
        EXPECT_NEAR(peak, 1.0, 0.01) << name; // the drive is used up
    }
}

TEST(ActuatorEqualiser, DoesNotBoostWhatLiesBeyondTheBand) {
    for (const Case& c : cases) {
        const ActuatorEqualiser equaliser{c, 48000};
        const double most = 1.0 / equaliser.flatLevel();
        for (const double hz : {0.2 * c.band.lowHz, 0.01 * c.band.lowHz, 4.0 * c.band.highHz, 20000.0})
            EXPECT_LT(std::abs(equaliser.at(hz)), most) << hz;
        EXPECT_LT(std::abs(equaliser.at(1e-3)), 1e-6);
    }
}

TEST(ActuatorEqualiser, DoesNotDependOnBlocksAndComesToRest) {
    std::vector<float> whole(48000), parts;
    whole[10] = 0.7f;
    whole[40] = -0.2f;
    parts = whole;
    ActuatorEqualiser a{{{205, 8}, {180, 230}}, 48000}, b = a;
    EXPECT_FALSE(a.process(whole.data(), 48000, false));
    for (int done = 0, block = 1; done < 48000; done += block, block = block % 97 + 1) {
        block = std::min(block, 48000 - done);
        b.process(parts.data() + done, block, false);
    }
    EXPECT_EQ(whole, parts);
    EXPECT_LT(std::abs(whole.back()), 1e-12f); // stable
}

TEST(ActuatorEqualiser, WithoutFiguresItPassesEverything) {
    for (ActuatorEqualiser off :
         {ActuatorEqualiser{}, ActuatorEqualiser{{{205, 0}, {180, 230}}, 48000},
          ActuatorEqualiser{{{205, 8}, {}}, 48000}, ActuatorEqualiser{{{205, 8}, {180, 2600}}, 5000}}) {
        float x[] = {0.1f, -3.0f};
        EXPECT_FALSE(off.isOn());
        EXPECT_TRUE(off.process(x, 2, true));
        EXPECT_FALSE(off.process(x, 2, false));
        EXPECT_EQ(x[0], 0.1f);
        EXPECT_EQ(x[1], -3.0f);
        EXPECT_EQ(off.flatLevel(), 0.0);
    }
}

} // namespace physvib::actuator_equaliser_test
