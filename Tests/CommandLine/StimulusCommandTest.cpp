// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib stimulus` as researchers and scripts hold on to it.
#include "Calls.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace physvib::stimulus_command_test {

using StimulusCommand = test::CommandLine;

/// The samples of a WAV file, as they follow each other.
std::vector<float> samplesOf(const std::string& wav) {
    const std::size_t at = wav.find("data") + 8;
    std::vector<float> samples((wav.size() - at) / sizeof(float));
    std::memcpy(samples.data(), wav.data() + at, samples.size() * sizeof(float));
    samples.resize(4 * 4410);
    return samples;
}

TEST_F(StimulusCommand, PatternsAndPhantomsBecomeFilesAndTheSameOnesAgain) {
    for (const std::string what : {"pattern ABA-250", "phantom --grid 5x5 --cell 2,4 --law log",
                                   "phantom --at 0.25,0.5 --layout ring4 --seconds 0.3"}) {
        const auto outcome = runs("stimulus " + what + " --out a.wav --picture a.png");
        EXPECT_EQ(outcome.err, "");
        EXPECT_TRUE(has(outcome.out, "4 channels"));
        const std::string first = read("a.wav");
        runs("stimulus " + what + " --out b.wav");
        EXPECT_EQ(read("b.wav"), first);
    }
    EXPECT_TRUE(has(call("stimulus pattern ABA-250 --out a.wav").out, "0.950 s"));
}

TEST_F(StimulusCommand, TheResonanceIsThatOfTheLayoutsActuators) {
    const auto layout = [](const std::string& a, const std::string& b) {
        return R"({"extent_m":[1,1],"enchanters":[{"label":"L","x_m":0,"y_m":0.5,"actuator":")" + a +
               R"("},{"label":"R","x_m":1,"y_m":0.5,"actuator":")" + b + R"("}]})";
    };
    write("same.json", layout("piezo-230", "piezo-230"));
    write("two.json", layout("lra-205", "piezo-230"));
    write("none.json", layout("none", "none"));
    runs("stimulus pattern AB-100 --layout same.json --frequency resonance --out a.wav");
    runs("stimulus pattern AB-100 --layout same.json --frequency 230 --out b.wav");
    EXPECT_EQ(read("a.wav"), read("b.wav"));
    refuses("stimulus pattern AB-100 --layout two.json --frequency resonance --out c.wav", 1,
            "actuator R: expected the resonance of the others, 205 Hz, found 230 Hz", 5);
    refuses("stimulus phantom --at 0,0 --layout none.json --frequency resonance --out c.wav", 1,
            "actuator L: expected an actuator, found none", 5);
    refuses("stimulus phantom --at 0,0 --frequency loud --out c.wav", 2,
            "--frequency: expected 5 to 20000 Hz, or resonance, found \"loud\"", 5);
}

TEST_F(StimulusCommand, EveryPatternIsListed) {
    for (const auto& [enchanters, count] : {std::pair{2, 28}, {3, 78}, {4, 168}}) {
        const auto outcome = call("stimulus list --enchanters " + std::to_string(enchanters));
        EXPECT_EQ(std::ranges::count(outcome.out, '\n'), count);
    }
}

TEST_F(StimulusCommand, ARecordingIsPlacedLikeAPhantom) {
    runs("stimulus phantom --at 0,0 --layout phone1 --seconds 0.1 --level-g 0.5 --out mono.wav "
         "--rate 44100");
    runs("stimulus wav mono.wav --at 0,0 --level-g 0.5 --out placed.wav");
    runs("stimulus phantom --at 0,0 --seconds 0.1 --level-g 0.5 --rate 44100 --out direct.wav");
    const auto placed = samplesOf(read("placed.wav")), direct = samplesOf(read("direct.wav"));
    float worst = 0.0f; // the recording's peak, a sample of the sine, becomes the level
    for (std::size_t i = 0; i < placed.size(); ++i) worst = std::max(worst, std::abs(placed[i] - direct[i]));
    EXPECT_LE(worst, 1e-4f);
    EXPECT_EQ(*std::ranges::max_element(placed), 0.5f);
    refuses("stimulus wav direct.wav --at 0,0 --out x.wav", 1, "direct.wav: expected one channel, found 4",
            3);
    write("no.wav", "RIFF, but not really");
    refuses("stimulus wav no.wav --at 0,0 --out x.wav", 1, "no.wav: expected a WAV, AIFF, FLAC", 4);
}

TEST_F(StimulusCommand, WhatLiesBelow5HzInARecordingIsTakenAwayAndTold) {
    std::vector<float> samples(8000, 0.02f);
    const auto writeWav = [&](const std::string& name) {
        write(name, test::wavBytes(
                        {.format = 3, .rateHz = 8000, .bits = 32},
                        {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(float)}));
    };
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] += 0.02f * std::sin(0.16f * static_cast<float>(n));
    writeWav("offset.wav");
    const auto outcome = runs("stimulus wav offset.wav --at 0,0 --layout phone1 --out a.wav");
    EXPECT_TRUE(
        has(outcome.err, "offset.wav: what lies below 5 Hz is not played: a mean of 0.50, of full scale\n"));
    const auto placed = samplesOf(read("a.wav"));
    EXPECT_NEAR(*std::ranges::min_element(placed), -1.0f, 0.01f);
    EXPECT_NEAR(*std::ranges::max_element(placed), 1.0f, 0.01f);
}

TEST_F(StimulusCommand, LevelsAreInG) {
    write(
        "weak.json",
        R"({"extent_m":[1,1],"enchanters":[{"label":"L","x_m":0,"y_m":0.5,"full_scale_g":0.5},{"label":"R","x_m":1,"y_m":0.5}]})");
    runs("stimulus pattern A-100 --layout weak.json --level-g 0.5 --out a.wav");
    refuses("stimulus pattern A-100 --layout weak.json --out b.wav", 1,
            "actuator L: expected at most its full scale of 0.5 g, found 1.000 g", 2);
    runs("stimulus pattern B-100 --layout weak.json --out a.wav");
}

TEST_F(StimulusCommand, BadCallsAreUsageErrors) {
    refuses("stimulus pattern ABE-250 --out a.wav", 2, "among the 4 of the layout");
    refuses("stimulus pattern ABCD --out a.wav", 2, "expected a pattern like ABA-250");
    refuses("stimulus pattern A-100", 2, "give --out or --picture");
    refuses("stimulus phantom --out a.wav", 2, "give either --at X,Y or --grid");
    refuses("stimulus phantom --at 2,0 --out a.wav", 2, "--at: expected X,Y from 0 to 1");
    refuses("stimulus phantom --grid 5x5 --cell 6,1 --out a.wav", 2, "--cell");
    refuses("stimulus phantom --grid 5 --cell 1,1 --out a.wav", 2, "--grid");
    refuses("stimulus phantom --at 0,0 --law cubic --out a.wav", 2, "--law");
    refuses("stimulus", 2, "");
    refuses("stimulus phantom --at 0,0 --frequency 4000 --rate 8000 --out a.wav", 1, "below half the rate");
}

} // namespace physvib::stimulus_command_test
