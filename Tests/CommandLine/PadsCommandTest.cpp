// SPDX-License-Identifier: GPL-3.0-or-later
// Game controllers as users and scripts hold on to them: `render --pad`, `play --pad`, `physvib pads`.
#include "Calls.h"
#include <algorithm>
#include <sstream>

namespace physvib {
namespace {

class PadsCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write("hits.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.1,60,30,0.05,0.02,0.03\n0.5,"
                          "349,106.99,0.5,0.1,0.03\n");
    }
};

TEST_F(PadsCommand, RenderWritesWhatMotorsWouldGetInsteadOfSamples) {
    const auto outcome = call("render --from-events hits.csv --seconds 1 --pad pad-xbox --out motors.csv");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("motors.csv  what two motors of pad-xbox would get: "), std::string::npos)
        << outcome.out;
    std::istringstream file{read("motors.csv")};
    std::string line;
    std::getline(file, line);
    EXPECT_NE(line.find("pad=pad-xbox"), std::string::npos) << line;
    std::getline(file, line);
    EXPECT_EQ(line, "time_s,low,high");
    double before = -1.0, lowMost = 0.0, highMost = 0.0;
    std::string last;
    while (std::getline(file, line)) {
        double time = 0.0, low = 0.0, high = 0.0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &low, &high), 3) << line;
        EXPECT_GT(time, before);
        before = time;
        if (time < 0.4)
            lowMost = std::max(lowMost, low);
        else
            highMost = std::max(highMost, high);
        last = line;
    }
    EXPECT_GE(lowMost, 0.3) << "a hit of 60 Hz";
    EXPECT_GE(highMost, 0.3) << "a hit of 349 Hz";
    EXPECT_NE(last.find(",0.00,0.00"), std::string::npos);
    const auto all = read("motors.csv");
    ASSERT_EQ(
        call("render --from-events hits.csv --seconds 1 --pad pad-xbox --out motors.csv --block 17").exitCode,
        0);
    EXPECT_EQ(read("motors.csv"), all);
}

TEST_F(PadsCommand, AWrongPadIsOneLineAndLeavesNothing) {
    refuses("render --from-events hits.csv --pad pad-atari --out m.csv", 1,
            "--pad: no controller profile \"pad-atari\": expected pad-generic, pad-xbox, pad-dualshock or a "
            "file NAME.json",
            1);
    refuses("render --from-events hits.csv --pad pad-xbox --events e.csv", 2,
            "--pad: expected --out MOTORS.csv", 1);
    refuses("play shake-the-box --pad nobody-has-this-one", 1,
            "no game controller with motors is called \"nobody-has-this-one\": plug it in, or choose another",
            1);
    refuses("play shake-the-box --pad auto@pad-atari", 1, "no controller profile \"pad-atari\"", 1);
    refuses("pads calibrate", 2, "pads calibrate: expected --out FILE.json", 1);
    refuses("pads --out a.json", 2, "--out, --name: expected pads calibrate", 1);
    refuses("play shake-the-box --device dualsense", 2,
            "--device dualsense: it has two coils, this layout 4; try --layout dualsense, or --map", 1);
    refuses("play shake-the-box --device dualsense --layout dualsense", 1,
            "--device dualsense: no sound device of a DualSense is there", 1);
}

TEST_F(PadsCommand, TheCoilsOfADualSenseAreALayoutOfTwoGrips) {
    const auto outcome = call("render --from-events hits.csv --seconds 1 --layout dualsense --out coils.wav");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("2 channels"), std::string::npos) << outcome.out;
}

} // namespace
} // namespace physvib
