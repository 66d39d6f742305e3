// SPDX-License-Identifier: MIT
// A file's mix on a desk that allows less: nothing gets louder, and all that was lowered is told.
#include "Live/Documents/Mix.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Mix mixOn(const char* preset) {
    Mix mix;
    EnchanterLayout layout;
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
    EXPECT_EQ(lowerTo(DeskLimits::of(own), asked),
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
    EXPECT_EQ(lowerTo(DeskLimits::of(own), asked), "");
    EXPECT_EQ(asked.levelDb, before.levelDb);
    EXPECT_EQ(asked.strips, before.strips);
}

TEST(DeskLimits, LimitsBelongToOutputsNotToNumbers) {
    Mix own = mixOn("phone2"), asked = mixOn("phone2");
    own.strips[1].ceilingDb = -40.0; // what hangs there is delicate
    std::swap(asked.strips[0].output, asked.strips[1].output);
    EXPECT_EQ(lowerTo(DeskLimits::of(own), asked), "A ceiling 0.0 to -40.0 dB");
    EXPECT_EQ(asked.strips[0].ceilingDb, -40.0);
    EXPECT_EQ(asked.strips[1].ceilingDb, 0.0);
}

TEST(DeskLimits, OthersThatAreSoloMakeAStripSilent) {
    Mix own = mixOn("phone2"), asked = mixOn("phone2");
    own.strips[0].isSolo = true;
    EXPECT_EQ(lowerTo(DeskLimits::of(own), asked), "B muted");
    EXPECT_TRUE(asked.strips[1].isMuted);
}

TEST(DeskLimits, TheLoudestOutputCountsAndOneThatIsNotInUseDoesNot) {
    Mix own = mixOn("phone3");
    own.levelDb = -12.0;
    own.strips[0].gainDb = -27.7;
    own.strips[1].gainDb = -6.0;
    own.strips[2].output = -1;
    EXPECT_EQ(DeskLimits::of(own).loudestOutputDb(), -18.0);
    own.strips[1].ceilingDb = -20.0;
    EXPECT_EQ(DeskLimits::of(own).loudestOutputDb(), -32.0);
    for (Strip& strip : own.strips) strip.output = -1;
    EXPECT_EQ(DeskLimits::of(own).loudestOutputDb(), -12.0);
    own.strips[0] = {.gainDb = leastStripDb, .output = 0};
    EXPECT_EQ(DeskLimits::of(own).loudestOutputDb(), leastStripDb) << "silent";
}

TEST(DeskLimits, AreKeptAsText) {
    Mix own = mixOn("ring3");
    own.levelDb = -17.5;
    own.strips[2] = {-1.5, true, false, false, 2.0, -3.25, 7};
    const auto again = readDeskLimits(deskLimitsText(DeskLimits::of(own)));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->levelDb, own.levelDb);
    EXPECT_EQ(again->strips, own.strips);
    for (const char* const text :
         {"", "{}", R"({"level_db": 3, "strips": []})", R"({"level_db": -3, "strips": [{}]})"})
        EXPECT_FALSE(readDeskLimits(text)) << text;
}

} // namespace
} // namespace physvib
