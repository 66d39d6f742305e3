// SPDX-License-Identifier: MIT
// Remapping keeps frequencies' order and changes nothing else; gain, weighting and cuts act in their order.
#include "Core/EventShaping.h"
#include "Core/CollisionEvent.h"
#include "Core/Samples.h"
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace physvib::event_shaping_test {

TEST(FrequencyRemap, KeepsTheOrderAndFillsTheBand) {
    const FrequencyRemap remap{{180, 230}};
    double last = 0.0;
    for (double hz = 20.0; hz <= 1000.0; hz *= 1.01) {
        const double moved = remap(hz);
        EXPECT_GT(moved, last);
        EXPECT_GE(moved, 180.0 - 1e-9);
        EXPECT_LE(moved, 230.0 + 1e-9);
        last = moved;
    }
    EXPECT_NEAR(remap(20), 180, 1e-9);
    EXPECT_NEAR(remap(1000), 230, 1e-9);
    EXPECT_NEAR(remap(5), 180, 1e-9);
    EXPECT_NEAR(remap(9000), 230, 1e-9);
}

TEST(FrequencyRemap, EqualIntervalsStayEqual) {
    const FrequencyRemap remap{{90, 1000}};
    EXPECT_NEAR(remap(80) / remap(40), remap(640) / remap(320), 1e-12);
}

const CollisionEvent collision{.timeNs = 7,
                               .frequencyHz = 349,
                               .decayPerSecond = 107,
                               .amplitude = 0.3,
                               .x = 1,
                               .y = 2,
                               .source = {1, 2, 3, 4}};

TEST(EventShaping, MovesTheFrequencyOnlyAndAfterTheMethod) {
    EventShaping shaping;
    EXPECT_EQ(shaping(collision), collision);
    shaping.remap.band = {180, 230};
    CollisionEvent moved = shaping(collision);
    EXPECT_EQ(moved.frequencyHz, shaping.remap(349));
    moved.frequencyHz = 349;
    EXPECT_EQ(moved, collision);
    shaping.method.fixesFrequency = true;
    EXPECT_EQ(shaping(collision).frequencyHz, shaping.remap(RenderingMethod::fixedFrequencyHz));
}

TEST(EventShaping, CutsADecayWhereItsEnvelopeFallsToGamma) {
    EventShaping shaping;
    shaping.truncation = 0.1; // Eq. 5.5
    CollisionEvent e = collision;
    const double seconds = 1e-9 * static_cast<double>(shaping(e).durationNs);
    EXPECT_LE(std::exp(-107 * seconds), 0.1);
    EXPECT_GT(std::exp(-107 * (seconds - 2e-9)), 0.1) << "the smallest such time";
    e.durationNs = 5'000'000;
    EXPECT_EQ(shaping(e).durationNs, 5'000'000) << "what ends before stays";
    e.decayPerSecond = 0.0;
    e.durationNs = 900'000'000;
    EXPECT_EQ(shaping(e), e) << "what does not decay stays";
}

TEST(EventShaping, AClipStaysAsItIsAloneAndAmongTheHitsOfAWorld) {
    EventShaping shaping{
        .method = {}, .remap = {{180, 230}}, .gain = 0.5, .perceived = {true}, .truncation = 0.1};
    ASSERT_TRUE(parseRenderingMethod("AF-FV-DRV", shaping.method));
    shaping.method.holdsLevel = true;
    CollisionEvent hit = collision, clip = hit;
    hit.durationNs = clip.durationNs = 9;
    clip.sound = soundOfClip(maxClips - 1);
    EventShaper shaper{shaping};
    EXPECT_EQ(shaping(clip), clip);
    EXPECT_EQ(shaper(clip), clip);
    EXPECT_NE(shaping(hit), hit);
    EXPECT_NE(shaper(hit), shaping(hit)) << "whose level is held";
}

TEST(EventShaping, WeightsTheAmplitudeThatTheGainHasMade) {
    const EventShaping shaping{.method = {}, .remap = {}, .gain = 0.5, .perceived = {true}};
    const CollisionEvent loud{.frequencyHz = 500, .decayPerSecond = 40, .amplitude = 0.8};
    EXPECT_DOUBLE_EQ(shaping(loud).amplitude, 0.8) << "weighted first, it would stop at full scale";
}

TEST(EventShaping, CutsALaterSegmentWhereItsToneEnds) {
    EventShaping shaping;
    shaping.truncation = 0.1;
    CollisionEvent e = collision;
    const std::int64_t whole = shaping(e).durationNs;
    e.course.toneAgeNs = 10'000'000;
    EXPECT_EQ(shaping(e).durationNs, whole - 10'000'000);
    e.course.toneAgeNs = whole + 5;
    EXPECT_EQ(shaping(e).durationNs, 1) << "a duration of 0 would be endless";
}

TEST(EventShaping, DoesNotCutWhatHardlyDecays) {
    EventShaping shaping;
    shaping.truncation = 0.1;
    CollisionEvent e = collision;
    e.decayPerSecond = 1e-12;
    EXPECT_EQ(shaping(e), e) << "70,000 years do not fit in nanoseconds";
}

// Where a tone is cut.

TEST(ToneEnd, IsACrossingAQuarterPeriodAwayAtMost) {
    std::mt19937 random{1};
    for (int i = 0; i < 100'000; ++i) {
        const double hz = std::uniform_real_distribution{5.0, 2000.0}(random);
        const auto wanted = std::uniform_int_distribution<std::int64_t>{1'000'000, 3'600'000'000'000}(random);
        const std::int64_t end = toneEndNs(hz, wanted);
        const double halfNs = 0.5e9 / hz;
        ASSERT_GE(end, 1);
        if (static_cast<double>(wanted) >= halfNs)
            ASSERT_LE(std::abs(static_cast<double>(end - wanted)), 0.5 * halfNs + 1.0) << hz << ' ' << wanted;
        else
            ASSERT_NEAR(static_cast<double>(end), halfNs, 1.0) << hz << ' ' << wanted;
        const double halves = static_cast<double>(end) / halfNs;
        ASSERT_NEAR(halves, std::round(halves), 1.0 / halfNs + 1e-9 * halves) << hz << ' ' << wanted;
    }
}

TEST(ToneEnd, StaysWhereItIsACrossing) {
    for (const std::int64_t ms : {2, 20, 250, 1000})
        EXPECT_EQ(toneEndNs(250.0, ms * 1'000'000), ms * 1'000'000);
    EXPECT_EQ(toneEndNs(205.0, 250'000'000), 251'219'512) << "ABA-250: 103 half periods";
    EXPECT_EQ(nearestCrossingNs(205.0, 1'000'000), 0);
}

// Which events can be played at all.

TEST(CollisionEvent, NoDecayNeedsADuration) {
    CollisionEvent e = collision;
    e.decayPerSecond = 0;
    EXPECT_FALSE(isPlayable(e));
    e.durationNs = 100'000'000;
    EXPECT_TRUE(isPlayable(e));
}

TEST(CollisionEvent, WhatIsSlowerThan5HzDecays) {
    CollisionEvent e = collision;
    e.durationNs = 10'000'000'000;
    const auto isTaken = [&](double frequencyHz, double decayPerSecond, std::int64_t travelNs = 0) {
        e.frequencyHz = frequencyHz;
        e.decayPerSecond = decayPerSecond;
        e.course.travelNs = travelNs;
        return isPlayable(e);
    };
    EXPECT_TRUE(isTaken(5.0, 0.0));
    EXPECT_FALSE(isTaken(4.999, 0.0));
    EXPECT_FALSE(isTaken(0.5, 1e-9)) << "a decay that is none";
    EXPECT_TRUE(isTaken(0.5, 1.0));
    EXPECT_FALSE(isTaken(2.0, 0.0, 10'000'000'000)) << "wherever it goes";
    e.sound = soundOfClip(3);
    EXPECT_TRUE(isTaken(clipFrequencyHz, 0.0)) << "a clip";
    EXPECT_FALSE(isTaken(clipFrequencyHz, 0.0, 10'000'000'000)) << "no clip moves";
    e.sound = soundOfMaterial("wood");
    EXPECT_TRUE(isTaken(80.0, 0.0, 10'000'000'000)) << "materials do";
    e.sound = -1;
    EXPECT_FALSE(isTaken(80.0, 0.0)) << "no sound has this number";
}

TEST(SoundNumber, AMaterialKeepsItsNumberInFilesOfAllVersions) {
    EXPECT_EQ(soundOfMaterial("wood"), 923368111);
    EXPECT_EQ(soundOfMaterial("steel"), 2095187368);
    EXPECT_FALSE(isClip(soundOfMaterial("wood")));
    EXPECT_FALSE(isClip(0));
    for (int k = 0; k < maxClips; ++k) EXPECT_TRUE(isClip(soundOfClip(k))) << k;
    EXPECT_FALSE(isClip(soundOfClip(maxClips)));
}

TEST(CollisionEvent, NothingThatIsNotANumberIsPlayable) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()})
        for (double CollisionEvent::*field :
             {&CollisionEvent::frequencyHz, &CollisionEvent::decayPerSecond, &CollisionEvent::amplitude,
              &CollisionEvent::x, &CollisionEvent::y}) {
            CollisionEvent e = collision;
            e.*field = bad;
            EXPECT_FALSE(isPlayable(e));
        }
}

TEST(CollisionEvent, LimitsAreKept) {
    const auto with = [](auto change) {
        CollisionEvent e = collision;
        change(e);
        return isPlayable(e);
    };
    EXPECT_FALSE(with([](auto& e) { e.timeNs = -1; }));
    EXPECT_FALSE(with([](auto& e) { e.timeNs = limits::maxTimeNs + 1; }));
    EXPECT_FALSE(with([](auto& e) { e.frequencyHz = 0; }));
    EXPECT_FALSE(with([](auto& e) { e.decayPerSecond = -1; }));
    EXPECT_FALSE(with([](auto& e) { e.decayPerSecond = limits::maxDecayPerSecond * 1.01; }));
    EXPECT_FALSE(with([](auto& e) { e.amplitude = -2 * limits::maxAmplitude; }));
    EXPECT_FALSE(with([](auto& e) { e.durationNs = -1; }));
}

// The weight of a frequency against its closed form, and that nothing is raised above full scale.

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

TEST(PerceivedLevel, OffChangesNoBit) {
    for (const double amplitude :
         {0.0, 1e-300, 0.1, 0.3, -0.7, 1.7, std::numeric_limits<double>::denorm_min()})
        EXPECT_EQ(PerceivedLevel{}(amplitude, 430.0), amplitude);
}

TEST(PerceivedLevel, WeighsTheFrequencyThatIsPlayedAfterTheGainAndNothingElse) {
    EventShaping shaping{.perceived = {true}};
    CollisionEvent e = collision;
    e.frequencyHz = 430;
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

} // namespace physvib::event_shaping_test
