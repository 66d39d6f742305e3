// SPDX-License-Identifier: GPL-3.0-or-later
#include "Host/Pictures/PictureCanvas.h"
#include <gtest/gtest.h>

namespace physvib::picture {
namespace {

const juce::String minus = juce::String::charToString(0x2212);

TEST(PictureCanvas, NumbersAreGroupedAndSigned) {
    EXPECT_EQ(number(1234567.0, 0), "1,234,567");
    EXPECT_EQ(number(-48000.25, 1), minus + "48,000.2");
    EXPECT_EQ(number(999.0, 2), "999.00");
    EXPECT_EQ(number(-0.001, 1), "0.0"); // no minus zero
}

TEST(PictureCanvas, ShortNumbersDropWhatSaysNothing) {
    EXPECT_EQ(shortNumber(349.2), "349");
    EXPECT_EQ(shortNumber(11.97), "12");
    EXPECT_EQ(shortNumber(6.4), "6.4");
    EXPECT_EQ(shortNumber(0.07), "0.07");
    EXPECT_EQ(shortNumber(80.0), "80");
    EXPECT_EQ(shortNumber(0.0), "0");
    EXPECT_EQ(shortNumber(1000.0), "1,000");
}

TEST(PictureCanvas, WhatHasFallenBy140dBIsSilent) {
    EXPECT_EQ(decibelText(0.5), minus + "6.0 dBFS");
    EXPECT_EQ(decibelText(-1.0), "0.0 dBFS");
    EXPECT_EQ(decibelText(0.99e-7), "silent");
    EXPECT_EQ(decibelText(0.0), "silent");
}

TEST(PictureCanvas, TicksAreRoundAndFew) {
    EXPECT_EQ(ticks(0.0, 10.0, 12), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(ticks(-10.0, 90.0, 5), (std::vector<double>{0, 20, 40, 60, 80}));
    EXPECT_EQ(ticks(-9.999, 90.001, 10).front(), -10.0); // an edge between two frames keeps its tick
    for (const double to : {0.03, 0.9, 7.0, 61.0, 3600.0, 1e6})
        EXPECT_LE(ticks(0.0, to, 12).size(), 13u) << to;
    EXPECT_EQ(ticks(0.0, 0.0, 12).size(), 1u);
}

} // namespace
} // namespace physvib::picture
