// SPDX-License-Identifier: MIT
// Lanes are lines between points, bounded as faders are; groups act on their strips, and nothing that a file
// brings is louder.
#include "Live/Documents/Mix.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace physvib::gain_lane_test {

Mix four() {
    Mix mix;
    mix.layout = presetLayout("phone4");
    mix.resizeStrips();
    return mix;
}

TEST(GainLane, IsALineBetweenItsPointsAndHoldsAtItsEnds) {
    const GainLane lane{{1.0, 0.0}, {3.0, -20.0}, {4.0, -60.0}};
    EXPECT_EQ(laneDbAt(lane, 0.0), 0.0);
    EXPECT_EQ(laneDbAt(lane, 2.0), -10.0);
    EXPECT_EQ(laneDbAt(lane, 2.001), -10.0) << "in steps of a fader";
    EXPECT_EQ(laneDbAt(lane, 9.0), -60.0);
    EXPECT_EQ(laneDbAt({{1.0, -12.0}, {3.0, 0.0}}, 0.0), -12.0) << "before its first point, too";
    EXPECT_EQ(laneDbAt({}, 9.0), 0.0);
    EXPECT_EQ(sumDb({-60.0, 6.0}), minStripDb) << "silence stays silence";
    EXPECT_EQ(sumDb({5.0, 5.0}), maxStripDb);
}

TEST(GainLane, SparesPointsThatNobodyFeels) {
    GainLane drawn;
    for (int i = 0; i <= 3000; ++i) drawn.push_back({0.01 * i, -10.0 + 10.0 * std::sin(0.002 * i)});
    const GainLane kept = simplified(drawn);
    EXPECT_LT(kept.size(), 60u);
    for (const GainPoint& point : drawn) EXPECT_NEAR(laneDbAt(kept, point.seconds), point.db, 0.31);
    std::mt19937 random{1};
    GainLane noise;
    for (int i = 0; i < 9000; ++i) noise.push_back({0.01 * i, -static_cast<double>(random() % 60)});
    EXPECT_LE(simplified(noise).size(), maxGainPoints);
    EXPECT_EQ(simplified({{1.0, -3.0}, {2.0, -3.0}}).size(), 1u);
}

TEST(StripGroups, AFaderAndAMuteActOnTheirStripsAlone) {
    Mix mix = four();
    mix.strips[1].group = mix.strips[2].group = addGroup(mix, "Left hand");
    mix.groups[0].gainDb = -6.0;
    mix.strips[2].gainDb = -3.0;
    EXPECT_EQ(effectiveStrips(mix)[0].gainDb, 0.0);
    EXPECT_EQ(effectiveStrips(mix)[1].gainDb, -6.0);
    EXPECT_EQ(effectiveStrips(mix)[2].gainDb, -9.0);
    mix.groups[0].isMuted = true;
    EXPECT_FALSE(mix.isSilent(0));
    EXPECT_TRUE(mix.isSilent(1));
    EXPECT_TRUE(isSilent(effectiveStrips(mix), 2));
    mix.groups[0].isMuted = false;
    mix.groups[0].lane = {{0.0, 0.0}, {1.0, -10.0}};
    mix.strips[2].lane = {{0.0, -1.0}};
    EXPECT_EQ(gainDbAt(mix, 2, 1.0), -20.0);
    EXPECT_EQ(gainDbAt(mix, 0, 1.0), 0.0);
    EXPECT_TRUE(hasLane(mix, 1));
    EXPECT_FALSE(hasLane(mix, 0));
    for (const Strip& felt : effectiveStrips(mix)) {
        EXPECT_EQ(felt.group, -1) << "its gain has the group's already";
        EXPECT_TRUE(felt.lane.empty());
    }
}

TEST(StripGroups, WhoLeavesAGroupIsFeltAsBefore) {
    Mix mix = four();
    const int other = addGroup(mix, freeGroupName(mix)), group = addGroup(mix, freeGroupName(mix));
    EXPECT_EQ(mix.groups[0].name, "Left hand");
    EXPECT_EQ(mix.groups[1].name, "Right hand");
    mix.strips[0].group = other;
    mix.strips[3].group = group;
    mix.strips[3].lane = {{0.0, -2.0}, {2.0, -4.0}};
    mix.groups[1] = {"Right hand", -6.0, true, {{1.0, 0.0}, {3.0, -8.0}}};
    const Mix before = mix;
    removeGroup(mix, 1);
    EXPECT_EQ(mix.strips[3].group, -1);
    EXPECT_EQ(mix.strips[0].group, 0);
    EXPECT_TRUE(mix.strips[3].isMuted);
    for (double t = 0.0; t < 4.0; t += 0.1)
        EXPECT_NEAR(gainDbAt(mix, 3, t), gainDbAt(before, 3, t), 0.35) << t;
    const int last = addGroup(mix, "Back");
    mix.strips[2].group = last;
    removeGroup(mix, 0);
    EXPECT_EQ(mix.strips[0].group, -1);
    EXPECT_EQ(mix.strips[2].group, 0) << "those behind it move up";
}

TEST(StripGroups, NothingThatAGroupOrALaneAddsIsLouderThanTheDesk) {
    Mix own = four(), asked = four();
    own.strips[0].gainDb = own.strips[1].gainDb = -10.0;
    asked.strips[0].group = addGroup(asked, "loud");
    asked.groups[0].gainDb = 6.0;
    asked.strips[0].gainDb = 6.0;
    asked.strips[1].lane = {{0.0, -40.0}, {9.0, 5.0}};
    asked.strips[2].lane = {{0.0, -40.0}};
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(own), asked),
              "A gain 6.0 to -16.0 dB; B gain 0.0 to -15.0 dB");
    EXPECT_EQ(maxGainDb(asked, 0), -10.0);
    EXPECT_EQ(maxGainDb(asked, 1), -10.0);
    Mix again = asked;
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(asked), again), "") << "a desk allows what it plays";
    EXPECT_EQ(MixerLimits::fromMix(asked).strips[2].gainDb, -40.0);
    Mix lane = four();
    lane.strips[3].group = addGroup(lane, "lane");
    lane.groups[0].lane = {{0.0, -40.0}, {9.0, 5.0}};
    EXPECT_EQ(maxGainDb(lane, 3), 5.0) << "a group's lane counts as a strip's";
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(four()), lane), "D gain 0.0 to -5.0 dB");
}

TEST(StripGroups, NewNamesAreTheUsualOnesThenNumbers) {
    Mix mix = four();
    for (int i = 0; i < 5; ++i) addGroup(mix, freeGroupName(mix));
    std::vector<std::string> names;
    for (const StripGroup& group : mix.groups) names.push_back(group.name);
    EXPECT_EQ(names, (std::vector<std::string>{"Left hand", "Right hand", "Back", "Group 4", "Group 5"}));
    removeGroup(mix, 1);
    EXPECT_EQ(freeGroupName(mix), "Right hand") << "a name that is free again";
}

// A file's mix on a desk that allows less: nothing gets louder, and all that was lowered is told.

Mix mixOn(const char* preset) {
    Mix mix;
    ActuatorLayout layout;
    EXPECT_TRUE(layoutPreset(preset, layout));
    mix.layout = describeLayout(preset, layout);
    mix.resizeStrips();
    return mix;
}

TEST(DeskLimits, NothingGetsLouder) {
    Mix own = mixOn("phone3"), asked = mixOn("phone4");
    own.levelDb = -20.0;
    own.strips[0].gainDb = -6.0;
    own.strips[1].ceilingDb = -12.0;
    own.strips[2].isMuted = true;
    asked.levelDb = -3.0;
    for (Strip& strip : asked.strips) strip.gainDb = 3.0;
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(own), asked),
              "master -3.0 to -20.0 dB; A gain 3.0 to -6.0 dB; B gain 3.0 to 0.0 dB; B ceiling 0.0 to -12.0 "
              "dB; C gain 3.0 to 0.0 dB; C muted; D without output 4");
    EXPECT_EQ(asked.levelDb, -20.0);
    EXPECT_EQ(asked.strips[0].gainDb, -6.0);
    EXPECT_EQ(asked.strips[1].gainDb, 0.0);
    EXPECT_EQ(asked.strips[1].ceilingDb, -12.0);
    EXPECT_TRUE(asked.strips[2].isMuted);
    EXPECT_EQ(asked.strips[3].output, -1);
}

TEST(DeskLimits, WhatIsQuieterStays) {
    Mix own = mixOn("phone4"), asked = mixOn("phone4");
    asked.levelDb = -30.0;
    asked.strips[0] = {-10.0, true, false, true, 3.0, -20.0, 1};
    asked.strips[1].output = -1;
    const Mix before = asked;
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(own), asked), "");
    EXPECT_EQ(asked.levelDb, before.levelDb);
    EXPECT_EQ(asked.strips, before.strips);
}

TEST(DeskLimits, LimitsBelongToOutputsNotToNumbers) {
    Mix own = mixOn("phone2"), asked = mixOn("phone2");
    own.strips[1].ceilingDb = -40.0; // what hangs there is delicate
    std::swap(asked.strips[0].output, asked.strips[1].output);
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(own), asked), "A ceiling 0.0 to -40.0 dB");
    EXPECT_EQ(asked.strips[0].ceilingDb, -40.0);
    EXPECT_EQ(asked.strips[1].ceilingDb, 0.0);
}

TEST(DeskLimits, OthersThatAreSoloMakeAStripSilent) {
    Mix own = mixOn("phone2"), asked = mixOn("phone2");
    own.strips[0].isSolo = true;
    EXPECT_EQ(lowerToLimits(MixerLimits::fromMix(own), asked), "B muted");
    EXPECT_TRUE(asked.strips[1].isMuted);
}

TEST(DeskLimits, TheLoudestOutputCountsAndOneThatIsNotInUseDoesNot) {
    Mix own = mixOn("phone3");
    own.levelDb = -12.0;
    own.strips[0].gainDb = -27.7;
    own.strips[1].gainDb = -6.0;
    own.strips[2].output = -1;
    EXPECT_EQ(MixerLimits::fromMix(own).loudestOutputDb(), -18.0);
    own.strips[1].ceilingDb = -20.0;
    EXPECT_EQ(MixerLimits::fromMix(own).loudestOutputDb(), -32.0);
    for (Strip& strip : own.strips) strip.output = -1;
    EXPECT_EQ(MixerLimits::fromMix(own).loudestOutputDb(), -12.0);
    own.strips[0] = {.gainDb = minStripDb, .output = 0};
    EXPECT_EQ(MixerLimits::fromMix(own).loudestOutputDb(), minStripDb) << "silent";
}

TEST(DeskLimits, AreKeptAsText) {
    Mix own = mixOn("ring3");
    own.levelDb = -17.5;
    own.strips[2] = {-1.5, true, false, false, 2.0, -3.25, 7};
    const auto again = readMixerLimits(mixerLimitsText(MixerLimits::fromMix(own)));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->levelDb, own.levelDb);
    EXPECT_EQ(again->strips, own.strips);
    for (const char* const text :
         {"", "{}", R"({"level_db": 3, "strips": []})", R"({"level_db": -3, "strips": [{}]})"})
        EXPECT_FALSE(readMixerLimits(text)) << text;
}

} // namespace physvib::gain_lane_test
