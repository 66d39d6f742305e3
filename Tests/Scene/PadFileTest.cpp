// SPDX-License-Identifier: MIT
// Profiles of game controllers survive writing and reading, and a bad one is named by its field; a render's
// commands as a table.
#include "Scene/PadFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::string errorOf(const std::string& what, const std::string& with) {
    std::string text = padJson(builtInPads().front());
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto read = readPad(text.replace(at, what.size(), with), "my.json");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(read.value == PadProfile{});
    return read.error;
}

TEST(PadFile, WrittenAndReadItIsTheSame) {
    ASSERT_EQ(builtInPads().size(), 3u);
    for (const PadProfile& p : builtInPads()) {
        EXPECT_TRUE(readPad(padJson(p), "a").value == p) << p.name;
        EXPECT_FALSE(p.source.empty()) << p.name;
        EXPECT_TRUE(findPad(p.name).value == p);
    }
    PadProfile mine = builtInPads()[1];
    mine.law.low.threshold = 0.1 + 0.2;
    mine.law.leadSeconds = 0.0;
    EXPECT_TRUE(readPad(padJson(mine), "a").value == mine);
}

TEST(PadFile, TheXboxProfileHasTheMeasuredFigures) {
    const PadLaw law = findPad("pad-xbox").value.law;
    for (const PadMotor& motor : {law.low, law.high}) {
        EXPECT_EQ(motor.threshold, 0.3);
        EXPECT_EQ(motor.half, 0.5);
        EXPECT_EQ(motor.full, 0.86);
    }
    EXPECT_EQ(law.low.riseSeconds, 0.19);
    EXPECT_EQ(law.high.riseSeconds, 0.11);
}

TEST(PadFile, ABadProfileIsNamedByItsField) {
    EXPECT_EQ(errorOf("\"half\": 0.5", "\"half\": 0.3"),
              "my.json: low.half: expected more than threshold, 0.3");
    EXPECT_EQ(errorOf("\"full\": 0.86", "\"full\": 0.4"), "my.json: low.full: expected more than half, 0.5");
    PadProfile high = builtInPads().front(); // its low motor is right
    high.law.high.half = high.law.high.full;
    EXPECT_EQ(readPad(padJson(high), "my.json").error.rfind("my.json: high.full: expected more than half", 0),
              0u);
    EXPECT_EQ(errorOf("\"commands_per_s\": 30", "\"commands_per_s\": 0")
                  .rfind("my.json: commands_per_s: expected", 0),
              0u);
    EXPECT_EQ(errorOf("\"rise_s\"", "\"rise_ms\"").rfind("my.json: low", 0), 0u);
    EXPECT_EQ(errorOf("pad-generic", ""), "my.json: name: expected a name, found an empty string");
    EXPECT_EQ(findPad("pad-atari").error, "no controller profile \"pad-atari\": expected pad-generic, "
                                          "pad-xbox, pad-dualshock or a file NAME.json");
}

TEST(PadCommands, ATableBeginsAndEndsAtRestAndHoldsWhatDiffers) {
    EnchanterLayout phone;
    layoutPreset("phone4", phone);
    const PhantomPanner panner{phone, PanningLaw::linear, 1.0, 1.0, 1.0};
    CollisionEvent hit;
    hit.timeNs = 500'000'000;
    hit.frequencyHz = 60.0;
    hit.decayPerSecond = 1.0;
    hit.amplitude = 1.0;
    hit.x = hit.y = 0.5;
    const PadLaw law = builtInPads().front().law;
    const auto rings = padCommands(law, {&hit, 1}, {}, panner, 900'000'000);
    ASSERT_GE(rings.size(), 3u);
    EXPECT_TRUE(rings.front().isSame({}));
    EXPECT_EQ(rings[1].timeNs, 470'000'000) << "the lead";
    EXPECT_TRUE(rings.back().isSame({}));
    EXPECT_EQ(rings.back().timeNs, 900'000'000) << "it still rings, and is ended";
    for (std::size_t i = 1; i < rings.size(); ++i) EXPECT_FALSE(rings[i].isSame(rings[i - 1]));

    RenderControl stop;
    stop.timeNs = 600'000'000;
    const auto stopped = padCommands(law, {&hit, 1}, {&stop, 1}, panner, 900'000'000);
    EXPECT_GE(stopped.back().timeNs, 600'000'000);
    EXPECT_LT(stopped.back().timeNs, 640'000'000);
    EXPECT_EQ(motorsCsv({{}, {470'000'000, 1.0, 0.55}}, {"1", {}}),
              "# physvib 1\ntime_s,low,high\n0.000000000,0.00,0.00\n0.470000000,1.00,0.55\n");
}

} // namespace
} // namespace physvib
