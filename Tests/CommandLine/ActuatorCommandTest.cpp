// SPDX-License-Identifier: GPL-3.0-or-later
// Actuators, as users and scripts see them: `physvib actuators`, render's --actuator, --equalise and --remap.
#include "Calls.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib::test {
namespace {

class ActuatorCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write("mine.json", profile("12", "[180, 230]"));
        writeHits("hits.csv", "0.1,80,34.13,0.05,0,0\n0.5,349,106.99,0.05,0,0\n");
    }
    static std::string profile(const std::string& q, const std::string& band) {
        return R"({"physvib_actuator": 1, "name": "mine", "description": "", "source": "a test", "kind": "linear", "resonance_hz": 205, "q": )" +
               q + R"(, "band_hz": )" + band +
               R"(, "drive_limit_v": null, "rise_time_s": null, "full_scale_g": null, "delay_s": null})";
    }
    static constexpr const char* render =
        "render --from-events hits.csv --layout phone1 --seconds 1 --out a.wav ";
};

TEST_F(ActuatorCommand, ListsWhatIsKnownAndLeavesTheRestEmpty) {
    const auto outcome = runs("actuators");
    EXPECT_TRUE(has(outcome.out, "\nlra-205,205,,,,,,,\"Park"));
    EXPECT_TRUE(has(outcome.out, "\nhaptuator-mark-2,,,90,1000,,,,\"Park"));
}

TEST_F(ActuatorCommand, EqualisesWithAProfileAndSaysUpToWhichLevel) {
    runs(render);
    const auto plain = read("a.wav");
    const auto outcome = runs(std::string{render} + "--actuator mine.json");
    EXPECT_TRUE(has(outcome.err, "equalised from 180 Hz to 230 Hz: flat up to -11."));
    EXPECT_NE(read("a.wav"), plain);
    const auto equalised = read("a.wav");
    runs(std::string{render} + "--actuator mine.json --block 17");
    EXPECT_EQ(read("a.wav"), equalised);
    write(
        "layout.json",
        R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "actuator": "mine.json"}, {"x_m": 0.1, "y_m": 0.1}]})");
    runs("render --from-events hits.csv --layout layout.json --actuator layout --seconds 1 --out two.wav");
}

TEST_F(ActuatorCommand, RemapsEventsInOrderAndWarnsOfMaterialsThatBecomeOne) {
    const auto outcome =
        runs(std::string{render} + "--actuator mine.json --equalise off --remap on --events b.csv");
    EXPECT_TRUE(has(outcome.err, "80 Hz and 349 Hz end at 196 Hz and 215 Hz, nearer than one JND of 18 %"));
    EXPECT_TRUE(has(outcome.err, "mine rings down with 53.7 /s"));
    const auto moved = read("b.csv");
    EXPECT_TRUE(has(moved, "\n0.100000000,196."));
    runs("render --from-events b.csv --layout phone1 --seconds 1 --out b.wav");
    // without the line on its origin
    const auto tail = [](const std::string& wav) { return wav.substr(wav.size() - 100'000); };
    EXPECT_EQ(tail(read("b.wav")), tail(read("a.wav")));
    const auto whole = runs("render --from-events hits.csv --layout phone1 --seconds 1 --out c.wav "
                            "--actuator haptuator-mark-2 --equalise off --remap on");
    EXPECT_FALSE(has(whole.err, "JND")); // there is room
}

TEST_F(ActuatorCommand, AMeasuredFullScaleReachesEveryLevelInG) {
    std::string measured = profile("12", "[180, 230]");
    measured.replace(measured.find("\"full_scale_g\": null"), 20, "\"full_scale_g\": 5");
    write("mine.json", measured);
    const auto own = call(std::string{render} + "--equalise off"),
               calibrated = call(std::string{render} + "--equalise off --actuator mine.json");
    ASSERT_EQ(calibrated.exitCode, 0) << calibrated.err;
    EXPECT_TRUE(has(own.out, "dBFS (0.0464 g)"));
    EXPECT_TRUE(has(calibrated.out, "dBFS (0.23 g)"));
    const std::string drop =
        "render drop --seconds 1 --out c.wav --events c.csv --layout phone1 --equalise off";
    EXPECT_TRUE(has(call(drop).out, "1 collision, 0.15 g to 0.15 g"));
    EXPECT_TRUE(has(call(drop + " --actuator mine.json").out, "1 collision, 0.73 g to 0.73 g"));
    EXPECT_EQ(call(std::string{render} + "--equalise off --actuator mine.json --method AF-FV-DRV").err, "")
        << "1.5 g are within 5 g";
    write("layout.json",
          R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "actuator": "mine.json"}]})");
    const auto other = call("render --from-events hits.csv --layout layout.json --actuator layout --equalise "
                            "off --seconds 1 --out two.wav");
    EXPECT_TRUE(has(other.err,
                    "layout.json: actuator A: levels are printed with full_scale_g 1 of the layout; "
                    "mine.json was measured as 5"));
}

TEST_F(ActuatorCommand, LevelsAreToldInDecibelsAndInG) {
    writeHits("hits.csv", "0.1,200,10,0.5,0,0\n0.8,200,10,0.007,0,0\n");
    write("layout.json",
          R"({"extent_m": [0.1, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "full_scale_g": 1.4}]})");
    const auto outcome =
        call("render --from-events hits.csv --layout layout.json --seconds 1 --out a.wav --events b.csv");
    EXPECT_TRUE(has(outcome.out, "peak -6.1 dBFS (0.69 g)"));
    EXPECT_TRUE(has(outcome.out, "2 collisions, 0.0098 g to 0.70 g, 1 under one step of an 8-bit converter"));
}

TEST_F(ActuatorCommand, WritesWhenAMotorWouldBeOn) {
    write("hits.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m,duration_s\n0.1,200,0,0.5,0,0,0."
                      "03\n0.5,200,0,0.05,0,0,0.03\n0.9,200,0,0.5,0,0,1\n");
    runs("render --from-events hits.csv --layout phone1 --seconds 1 --pattern p.csv");
    const std::string text = read("p.csv");
    EXPECT_EQ(text.substr(text.find('\n') + 1), "channel,on_s,off_s\n1,0.10,0.13\n1,0.90,1.00\n");
    runs("render --from-events hits.csv --layout phone1 --seconds 1 --pattern p.csv --threshold "
         "0.01 --block 7");
    EXPECT_TRUE(has(read("p.csv"), "1,0.50,0.53\n"));
}

TEST_F(ActuatorCommand, ScalesTheFileToTheVoltageOfTheActuator) {
    const std::string with = std::string{render} + "--actuator haptuator-2 --equalise off ";
    const auto peakOf = [&](const std::string& options) {
        runs(with + options);
        const auto channels = channelsOf("a.wav");
        float most = 0.0f;
        for (const float sample : channels.at(0)) most = std::max(most, std::abs(sample));
        return most;
    };
    EXPECT_NEAR(peakOf("--interface-volts 6") / peakOf(""), 0.5f, 1e-6f); // the input range is 3 V
    refuses(with + "--interface-volts 2", 1,
            "haptuator-2: expected an interface of at least 3 V, found --interface-volts 2", 3);
    refuses(std::string{render} + "--actuator lra-205 --equalise off --interface-volts 2", 1,
            "lra-205: drive_limit_v is not known", 3);
    refuses(std::string{render} + "--interface-volts 2", 2, "--interface-volts: expected an --actuator", 3);
}

TEST_F(ActuatorCommand, WhatIsNotKnownIsRefusedInOneLine) {
    const auto refusesIt = [&](const std::string& options, const std::string& words) {
        refuses(render + options, 1, words, 2);
    };
    refusesIt("--actuator lra-205",
              "--actuator lra-205: lra-205: q is not known (measure it with physvib calibrate)");
    refusesIt("--actuator erm-coin", "a rotating mass has the frequency of its speed");
    refusesIt("--actuator tapper", "--actuator: no actuator \"tapper\" (see physvib actuators)");
    refusesIt("--actuator none.json", "none.json: cannot be read");
    refusesIt("--actuator lra-205 --equalise off --remap on",
              "lra-205: band_hz is not known: nothing to remap into");
    refuses(std::string{render} + "--remap on", 2, "--remap: expected an --actuator", 2);
    refuses(std::string{render} + "--actuator mine.json --equalise maybe", 2, "--equalise", 2);
    write("mine.json", profile("12", "[230, 180]"));
    refusesIt("--actuator mine.json", "mine.json: band_hz: expected a highest frequency above the lowest");
    write("mine.json", profile("12", "[180, 2600]"));
    refusesIt("--actuator mine.json --rate 5000", "mine: expected a band below half of the sample rate");
}

// A file for an interface of so many volts: each channel by its own actuator's limit.

class Voltages : public CommandLine {
protected:
    std::string actuator(const std::string& name, double volts) const {
        return R"({"physvib_actuator": 1, "name": ")" + name +
               R"(", "description": "of a test", "source": "made up", "kind": "linear", "resonance_hz": 200, "q": 10, "band_hz": [100, 400], "drive_limit_v": )" +
               std::to_string(volts) + R"(, "rise_time_s": null, "full_scale_g": null, "delay_s": null})";
    }
    std::array<float, 3> peaksOf(const std::string& options) const {
        runs("render --from-events hits.csv --layout layout.json --actuator layout --equalise off "
             "--limiter off --rate 8000 --seconds 0.5 --out a.wav " +
             options);
        const auto channels = channelsOf("a.wav");
        std::array<float, 3> peaks{};
        for (std::size_t j = 0; j < peaks.size(); ++j)
            for (const float sample : channels.at(j)) peaks[j] = std::max(peaks[j], std::abs(sample));
        return peaks;
    }
};

TEST_F(Voltages, ScaleEachChannelByItsOwnActuator) {
    write("a.json", actuator("mine-a", 2.0));
    write("b.json", actuator("mine-b", 4.0));
    write("c.json", actuator("mine-c", 1.0));
    write("layout.json",
          R"({"extent_m": [0.2, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "actuator": "a.json"}, )"
          R"({"x_m": 0.1, "y_m": 0, "actuator": "b.json"}, {"x_m": 0.2, "y_m": 0, "actuator": "c.json"}]})");
    writeHits("hits.csv", "0.01,200,10,0.5,0,0\n0.02,200,10,0.5,0.1,0\n0.03,200,10,0.5,0.2,0\n");
    const auto plain = peaksOf("");
    for (const double volts : {4.0, 8.0, 20.0}) {
        const auto scaled = peaksOf("--interface-volts " + std::to_string(volts));
        const std::array limits{2.0, 4.0, 1.0};
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_GT(plain[j], 0.1f);
            EXPECT_NEAR(scaled[j] / plain[j], limits[j] / volts, 1e-4)
                << "channel " << j << ", " << volts << " V";
        }
    }
    refuses("render --from-events hits.csv --layout layout.json --actuator layout --equalise off --out b.wav "
            "--interface-volts 3.99",
            1, "mine-b: expected an interface of at least 4 V", 6);
}

} // namespace
} // namespace physvib::test
