// SPDX-License-Identifier: MIT
// Files of autoregressive textures: what is in them comes out; what is none of them is told.
#include "Formats/TextureModels.h"
#include "Support/Mutations.h"
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

/// Two models, as the toolkit writes them (the numbers are our own).
const std::string whole = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- a > in a comment -->
<modelSet texture="3">
   <material>Our own &amp; nobody's</material>
   <AccelUnits>m/s^2</AccelUnits><SpeedUnits>mm/s</SpeedUnits><ForceUnits>N</ForceUnits>
   <SampleRate>10000</SampleRate>
   <mu>0.300000</mu>
   <numMod>2</numMod>
   <speedList type="array"><value>50.0</value><value>150.0</value></speedList>
   <tri type="array"><value>1</value><value>2</value><value>2</value></tri>
   <numARCoeff>2</numARCoeff>
   <numMACoeff>0</numMACoeff>
   <model><modNum>1</modNum>
      <ARcoeff><value>1.00000000000000000000</value><value>-1.95000000000000000000</value><value> 0.9800 </value></ARcoeff>
      <ARlsf><value>0.1</value><value>0.2</value></ARlsf><MAcoeff/>
      <var>0.250000</var><speedMod>50.0</speedMod><forceMod>0.5</forceMod></model>
   <model><var>1.5</var><ARcoeff><value>1</value><value>-0.5</value></ARcoeff><speedMod>150</speedMod><forceMod>2</forceMod></model>
</modelSet>
)";

std::string with(std::string_view from, std::string_view to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return text;
}

TEST(TextureModels, AreReadAsTheyAre) {
    const auto read = readTextureModels(whole, "f.xml");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.sampleRateHz, 10000.0);
    ASSERT_EQ(read.value.models.size(), 2U);
    const TextureModel& first = read.value.models[0];
    EXPECT_DOUBLE_EQ(first.metresPerSecond, 0.05);
    EXPECT_EQ(first.newtons, 0.5);
    EXPECT_EQ(first.variance, 0.25);
    EXPECT_EQ(first.coefficients, (std::vector{-1.95, 0.98}));
    EXPECT_EQ(read.value.models[1].coefficients, std::vector{-0.5});
}

TEST(TextureModels, TheNearestIsTaken) {
    const TextureModels models = readTextureModels(whole, "f.xml").value;
    EXPECT_EQ(models.nearest(0.06, 0.6).newtons, 0.5);
    EXPECT_EQ(models.nearest(1.0, 5.0).newtons, 2.0);
    EXPECT_EQ(models.nearest(0.0, 0.0).newtons, 0.5);
}

TEST(TextureModels, AreToldByTheirEnding) {
    EXPECT_TRUE(isTextureModels("Models_Brick.XML"));
    EXPECT_FALSE(isTextureModels("xml"));
    EXPECT_FALSE(isTextureModels("scrape.wav"));
}

TEST(TextureModels, WhatIsNoneIsToldWithItsLine) {
    const auto expectFault = [](const std::string& text, const std::string& words) {
        const auto read = readTextureModels(text, "f.xml");
        EXPECT_NE(read.error.find(words), std::string::npos) << read.error;
        EXPECT_TRUE(read.value.models.empty());
    };
    expectFault("", "f.xml: expected a modelSet with a SampleRate, found none");
    expectFault("<tapSet><numTap>1</numTap></tapSet>",
                "f.xml: line 1: expected a modelSet, found \"tapSet\"");
    expectFault("<modelSet><SampleRate>10000</SampleRate></modelSet>", "expected a model, found none");
    expectFault(with("mm/s", "m/s"), "line 5: SpeedUnits: expected mm/s, found \"m/s\"");
    expectFault(with("<numMACoeff>0", "<numMACoeff>4"),
                "line 12: numMACoeff: expected 0, the models at 10 kHz, found \"4\"");
    expectFault(with("0.250000", "nan"),
                "line 16: var: expected a number from 0 to 1000000000, found \"nan\"");
    expectFault(with("<var>1.5</var>", ""), "line 17: model: expected speedMod, forceMod and var");
    expectFault(with("<value>1</value><value>-0.5</value>", "<value>-0.5</value>"),
                "ARcoeff: expected 1 and at least one coefficient more");
    expectFault(with("</modelSet>", ""), "expected </modelSet>, found the end");
    expectFault(with("</var>", "</vat>"), "line 16: expected </var>, found </vat>");
    expectFault("<!DOCTYPE a [<!ENTITY b \"bb\">]>" + whole,
                "line 1: expected elements and text alone, found \"<!DOCTYPE\"");
    std::string deep;
    for (int i = 0; i < 1000; ++i) deep += "<a>";
    expectFault(deep, "at most 16 elements within each other");
    std::string many = "<modelSet><model><ARcoeff>";
    for (int i = 0; i < 300; ++i) many += "<value>1</value>";
    expectFault(many, "ARcoeff: expected at most 257 values");
}

TEST(TextureModels, AnyMutationIsReadOrToldInOneLine) {
    std::mt19937 random{1};
    for (int i = 0; i < 2000; ++i) {
        const auto read = readTextureModels(mutated(whole, "<>/!?-\"'= \n0123456789e.\xff", random), "f.xml");
        if (read)
            EXPECT_FALSE(read.value.models.empty());
        else
            EXPECT_TRUE(read.error.starts_with("f.xml:") && read.error.size() < 600 &&
                        read.error.find('\n') == std::string::npos)
                << read.error;
    }
}

} // namespace
} // namespace physvib
