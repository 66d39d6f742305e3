// SPDX-License-Identifier: MIT
// The weight of a frequency against its closed form, and that nothing is raised above full scale.
#include "Core/EventShaping.h"
#include <gtest/gtest.h>
#include <limits>

namespace physvib {
namespace {

// The threshold of detection as a displacement, relative to 250 Hz, in dB: -12 dB per octave from 40 to 250
// Hz, flat on both sides.
double displacementThresholdDb(double hz) { return -40.0 * std::log10(std::clamp(hz, 40.0, 250.0) / 250.0); }

// The same as an acceleration, of which half is made up for, by at most a factor of 2.
double expectedDb(double hz) {
    const double acceleration = displacementThresholdDb(hz) + 40.0 * std::log10(hz / 250.0);
    const double most = 20.0 * std::log10(2.0);
    return std::clamp(0.5 * acceleration, -most, most);
}

TEST(PerceivedLevel, IsHalfTheThresholdOfAnAccelerationWithinSixDecibels) {
    for (double hz = 1.0; hz <= 20000.0; hz *= 1.01)
        ASSERT_NEAR(20.0 * std::log10(PerceivedLevel::weight(hz)), expectedDb(hz), 1e-9) << hz;
    EXPECT_NEAR(PerceivedLevel::weight(349), 1.396, 1e-12);
    EXPECT_EQ(PerceivedLevel::weight(500), 2.0);
    EXPECT_EQ(PerceivedLevel::weight(20), 0.5);
}

TEST(PerceivedLevel, RisesWithFrequencyAndIsOneWhereThresholdsAreAlike) {
    double last = 0.0;
    for (double hz = 1.0; hz <= 20000.0; hz *= 1.01) {
        const double weight = PerceivedLevel::weight(hz);
        ASSERT_GE(weight, last) << hz;
        if (hz > 20.0 && hz < 40.0) {
            ASSERT_GT(weight, last) << hz;
        }
        if (hz >= 40.0 && hz <= 250.0) {
            ASSERT_EQ(weight, 1.0) << hz;
        }
        last = weight;
    }
}

TEST(PerceivedLevel, RaisesNothingAboveFullScaleAndKeepsTheOrderOfHits) {
    const PerceivedLevel level{true};
    for (const double hz : {10.0, 30.0, 100.0, 349.0, 430.0, 2000.0}) {
        double last = -1.0;
        for (double amplitude = 0.0; amplitude <= 4.0; amplitude += 0.01) {
            const double weighted = level(amplitude, hz);
            ASSERT_LE(weighted, std::max(amplitude, 1.0)) << hz << " Hz, " << amplitude;
            ASSERT_GE(weighted, last) << hz << " Hz, " << amplitude;
            ASSERT_EQ(level(-amplitude, hz), -weighted);
            last = weighted;
        }
    }
    EXPECT_EQ(level(0.4, 1000.0), 0.8);
    EXPECT_EQ(level(0.7, 1000.0), 1.0);
    EXPECT_EQ(level(1.5, 1000.0), 1.5);
    EXPECT_EQ(level(1.5, 10.0), 0.75);
}

const CollisionEvent e{.timeNs = 7,
                       .frequencyHz = 430,
                       .decayPerSecond = 50,
                       .amplitude = 0.3,
                       .x = 1,
                       .y = 2,
                       .source = {1, 2, 3, 4}};

TEST(PerceivedLevel, OffChangesNoBit) {
    for (const double amplitude :
         {0.0, 1e-300, 0.1, 0.3, -0.7, 1.7, std::numeric_limits<double>::denorm_min()})
        EXPECT_EQ(PerceivedLevel{}(amplitude, 430.0), amplitude);
    EXPECT_EQ(EventShaping{}(e), e);
}

TEST(PerceivedLevel, WeighsTheFrequencyThatIsPlayedAfterTheGainAndNothingElse) {
    EventShaping shaping{.perceived = {true}};
    CollisionEvent felt = shaping(e);
    EXPECT_EQ(felt.amplitude, 0.3 * (430.0 / 250.0));
    felt.amplitude = e.amplitude;
    EXPECT_EQ(felt, e);
    shaping.gain = 2.0;
    EXPECT_EQ(shaping(e).amplitude, 1.0) << "0.6 is raised to full scale and no further";
    shaping.gain = 1.0;
    shaping.remap.band = {180, 230};
    EXPECT_EQ(shaping(e).amplitude, e.amplitude) << "in that band thresholds are alike";
    shaping.remap.band = {};
    shaping.method.fixesFrequency = true;
    EXPECT_EQ(shaping(e).amplitude, e.amplitude) << "250 Hz is what all is compared to";
}

} // namespace
} // namespace physvib
