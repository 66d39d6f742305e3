// SPDX-License-Identifier: MIT
// Remapping keeps frequencies' order and changes nothing else; gain, weighting and cuts act in their order.
#include "Core/EventShaping.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

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

TEST(FrequencyRemap, WithoutABandNothingMoves) { EXPECT_EQ(FrequencyRemap{}(349.0), 349.0); }

TEST(EventShaping, MovesTheFrequencyOnlyAndAfterTheMethod) {
    CollisionEvent e{.timeNs = 7,
                     .frequencyHz = 349,
                     .decayPerSecond = 107,
                     .amplitude = 0.3,
                     .x = 1,
                     .y = 2,
                     .durationNs = 0,
                     .source = {1, 2, 3, 4}};
    EventShaping shaping;
    EXPECT_EQ(shaping(e), e);
    shaping.remap.band = {180, 230};
    CollisionEvent moved = shaping(e);
    EXPECT_EQ(moved.frequencyHz, shaping.remap(349));
    moved.frequencyHz = 349;
    EXPECT_EQ(moved, e);
    shaping.method.fixesFrequency = true;
    EXPECT_EQ(shaping(e).frequencyHz, shaping.remap(RenderingMethod::fixedFrequencyHz));
}

TEST(EventShaping, CutsADecayWhereItsEnvelopeFallsToGamma) {
    EventShaping shaping;
    shaping.truncation = 0.1; // Eq. 5.5
    CollisionEvent e{.timeNs = 7, .frequencyHz = 349, .decayPerSecond = 107, .amplitude = 0.3};
    const double seconds = 1e-9 * static_cast<double>(shaping(e).durationNs);
    EXPECT_LE(std::exp(-107 * seconds), 0.1);
    EXPECT_GT(std::exp(-107 * (seconds - 2e-9)), 0.1) << "the smallest such time";
    e.durationNs = 5'000'000;
    EXPECT_EQ(shaping(e).durationNs, 5'000'000) << "what ends before stays";
    e.decayPerSecond = 0.0;
    e.durationNs = 900'000'000;
    EXPECT_EQ(shaping(e), e) << "what does not decay stays";
}

/// Gives all impacts one level that is held; false if there is no such method.
bool holdLevel(EventShaping& shaping) {
    shaping.method.holdsLevel = true;
    return renderingMethodNamed("AF-FV-DRV", shaping.method);
}

CollisionEvent hitOf(std::int64_t durationNs) {
    return {.timeNs = 7,
            .frequencyHz = 349,
            .decayPerSecond = 107,
            .amplitude = 0.3,
            .durationNs = durationNs,
            .source = {1, 2, 3, 4}};
}

TEST(EventShaping, AClipStaysAsItIsAloneAndAmongTheHitsOfAWorld) {
    EventShaping shaping{
        .method = {}, .remap = {{180, 230}}, .gain = 0.5, .perceived = {true}, .truncation = 0.1};
    ASSERT_TRUE(holdLevel(shaping));
    const CollisionEvent hit = hitOf(9);
    CollisionEvent clip = hit;
    clip.sound = soundOfClip(mostClips - 1);
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
    CollisionEvent e{.timeNs = 7, .frequencyHz = 349, .decayPerSecond = 107, .amplitude = 0.3};
    const std::int64_t whole = shaping(e).durationNs;
    e.course.sinceNs = 10'000'000;
    EXPECT_EQ(shaping(e).durationNs, whole - 10'000'000);
    e.course.sinceNs = whole + 5;
    EXPECT_EQ(shaping(e).durationNs, 1) << "a duration of 0 would be endless";
}

TEST(EventShaping, DoesNotCutWhatHardlyDecays) {
    EventShaping shaping;
    shaping.truncation = 0.1;
    const CollisionEvent e{.timeNs = 7, .frequencyHz = 349, .decayPerSecond = 1e-12, .amplitude = 0.3};
    EXPECT_EQ(shaping(e), e) << "70,000 years do not fit in nanoseconds";
}

TEST(EventShaper, ForgetsTheImpactsThatStillSound) {
    EventShaping shaping;
    ASSERT_TRUE(holdLevel(shaping));
    const CollisionEvent hit = hitOf(0);
    EventShaper shaper{shaping};
    const double first = shaper(hit).amplitude;
    EXPECT_LT(shaper(hit).amplitude, first) << "only what the first one leaves free";
    shaper.forget();
    EXPECT_EQ(shaper(hit).amplitude, first);
}

} // namespace
} // namespace physvib
