// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play` where there is no device: what it refuses before hands could feel it.
#include "Calls.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace physvib::play_command_test {

using PlayCommand = test::CommandLine;

TEST_F(PlayCommand, ADeviceThatIsNotThereIsAFailureAndNothingElseIsPlayedOn) {
    refuses("play drop --device Nowhere --record a.wav", 1,
            "Nowhere: no such device (see physvib devices); nothing else is played on");
}

TEST_F(PlayCommand, WithoutADeviceItSaysWhatThereIsAndWhatToType) {
    const auto left = call("play drop"), listed = call("devices");
    EXPECT_EQ(left.exitCode, 2);
    EXPECT_EQ(left.err, "physvib: play: expected --device, --board or --pad\n");
    const auto begin = left.out.find("physvib play drop --device \"");
    ASSERT_NE(begin, std::string::npos) << left.out;
    EXPECT_EQ(listed.out.rfind(left.out.substr(0, left.out.rfind('\n', begin) + 1), 0), 0u)
        << "the devices as `devices` lists them: " << left.out;
    const std::string typed = left.out.substr(begin + 8, left.out.find('\n', begin) - begin - 8);
    // it is a call, whether or not the device can be opened
    EXPECT_NE(call(typed + " --seconds 0.1").exitCode, 2) << typed;
}

TEST_F(PlayCommand, ThereHasToBeSomethingToPlayOn) {
    refuses("play drop --device Nowhere --board /dev/nowhere", 1, "/dev/nowhere: no such serial port");
    std::string five = R"({"name": "five", "extent_m": [1, 1], "enchanters": [)";
    for (int j = 0; j < 5; ++j)
        five += std::string{j > 0 ? ", " : ""} + R"({"label": ")" +
                std::string(1, static_cast<char>('A' + j)) + R"(", "x_m": 0.)" + std::to_string(j) +
                R"(, "y_m": 0})";
    write("five.json", five + "]}");
    refuses("play drop --device Nowhere --board /dev/nowhere --layout five.json", 2,
            "--board: the board has four channels, this layout 5", 1);
}

TEST_F(PlayCommand, CeilingsAreOneForAllOrOneForEach) {
    const std::string found =
        "--ceiling: expected one number of dB from -60 to 0, or one per actuator (4), found ";
    for (const char* ceilings :
         {"3", "-61", "-6,-6,-6", "-6,-6,-6,-6,-6", "-6,,-6,-6", "-6dB", "-6,-6,-6,", "nan", "-inf"})
        refuses(std::string{"play drop --device Nowhere --ceiling="} + ceilings, 2,
                found + "\"" + ceilings + "\"");
    for (const char* ceilings : {"-6", "-6,-12,0,-60", "-0.5"})
        refuses(std::string{"play drop --device Nowhere --ceiling "} + ceilings, 1, "no such device");
}

// The number of ceilings tells the layout before any device is opened.
TEST_F(PlayCommand, ANamedPicoBringsItsLayoutUnlessOneIsGiven) {
    const auto play = [&](const char* device, const char* layout, const char* actuators) {
        refuses("play drop --device '" + std::string{device} + "'" + layout + " --ceiling=-1,-2,-3", 2,
                std::string{"one per actuator ("} + actuators + ")");
    };
    play("ALSA:PhysVib pico8, USB Audio; Direct hardware device", "", "8");
    play("PhysVib pico4", "", "4");
    play("PhysVib pico8", " --layout phone2", "2");
    play("speakers", "", "4");
}

TEST_F(PlayCommand, AMapNamesEachOutputOnce) {
    for (const char* map : {"0,1", "1,2,", "1:2", "a"})
        refuses(std::string{"play drop --device Nowhere --map "} + map, 2,
                "--map: expected outputs like 1,2,3,4");
    refuses("play drop --device Nowhere --map 1,2,2", 1,
            "output 2 is given to two actuators; expected one each");
}

// `physvib play FILE.wav`: what leaves is what is in the file, each channel for its actuator.

class SoundPlay : public test::CommandLine {
protected:
    static constexpr const char* nobody = " --device 'None:no device' --level 0";

    /// A tenth of a second, of which the last 5 ms have a peak of their own.
    static std::string tone(float peak, float lastPeak) {
        std::string samples;
        for (int n = 0; n < 4800; ++n)
            samples +=
                test::numberBytes(std::bit_cast<std::uint32_t>((n < 4560 ? peak : lastPeak) *
                                                               static_cast<float>(std::sin(0.026 * n))),
                                  4);
        return test::wavBytes({.format = 3, .bits = 32}, samples);
    }

    /// Of a WAV of floats that render or play wrote, from the first frame that is not silent to the last.
    std::vector<float> felt(const std::string& name, std::size_t channels) const {
        const std::string bytes = read(name);
        const std::size_t begin = bytes.find("data") + 8, frame = channels * sizeof(float);
        if (begin > bytes.size()) return {};
        std::vector<float> samples((bytes.size() - begin) / frame * channels);
        std::memcpy(samples.data(), bytes.data() + begin, samples.size() * sizeof(float));
        const auto sounds = [](float sample) { return sample != 0.0f; };
        auto first = std::ranges::find_if(samples, sounds) - samples.begin();
        first -= first % static_cast<std::ptrdiff_t>(channels);
        samples.erase(samples.begin(), samples.begin() + first);
        while (!samples.empty() && samples.back() == 0.0f) samples.pop_back();
        return samples;
    }
};

TEST_F(SoundPlay, WhatLeavesIsTheFileToTheBit) {
    runs("render shake-the-box --seconds 1.5 --out box.wav");
    const auto played = runs(std::string{"play box.wav --record own.wav --save own.json"} + nobody);
    const auto file = felt("box.wav", 4), own = felt("own.wav", 4);
    ASSERT_GT(file.size(), 40'000u);
    EXPECT_TRUE(own == file) << own.size() << " samples of " << file.size();
    EXPECT_TRUE(has(played.out, "; 4 events left, 0 late, 0 dropped"));
    std::istringstream told{played.out.substr(played.out.find("peaks ") + 6)};
    for (std::size_t j = 0; j < 4; ++j) {
        double peak = 0.0, most = 0.0;
        told >> peak;
        for (std::size_t n = j; n < file.size(); n += 4)
            most = std::max(most, std::abs(static_cast<double>(file[n])));
        EXPECT_NEAR(peak, most, 0.001) << "what left at actuator " << j << ": " << played.out;
    }
    runs("render own.json --out again.wav");
    EXPECT_TRUE(felt("again.wav", 4) == file) << "saved, it is rendered again";
}

// A recording is taken before the fade at the end; the peaks are of what left after it.
TEST_F(SoundPlay, AFileIsFeltToItsEnd) {
    write("end.wav", tone(0.1f, 0.5f));
    const auto told = runs("play end.wav --layout phone1" + std::string{nobody}).out;
    EXPECT_TRUE(has(told, "peaks 0.500")) << told;
}

TEST_F(SoundPlay, TwoChannelsAreTwoActuatorsAndTheLevelIsLowUnlessAskedFor) {
    runs("render drop --seconds 1.2 --layout phone2 --out two.wav");
    runs("play two.wav --device 'None:no device' --record own.wav");
    EXPECT_TRUE(felt("own.wav", 2) == felt("two.wav", 2)) << "the recording is before the master level";
    refuses("play two.wav --layout phone4" + std::string{nobody}, 2,
            "two.wav: expected a channel for each of 4 actuators (--layout), or one channel, found 2", 2);
}

TEST_F(SoundPlay, WhatFitsNothingIsOneLine) {
    refuses("play nothing.wav" + std::string{nobody}, 1, "nothing.wav: cannot be read");
    refuses("play nothing.wav --board /dev/nowhere", 2, "boards and controllers play no recordings");
    write("text.wav", "no sound");
    refuses("play text.wav" + std::string{nobody}, 1,
            "text.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 1);
    std::string six = R"({"name": "six", "extent_m": [1, 1], "enchanters": [)";
    for (const char* label : {"A", "B", "C", "D", "E", "F"})
        six += std::string{*label > 'A' ? ", " : ""} + R"({"label": ")" + label + R"(", "x_m": 0.)" +
               std::to_string(*label - 'A') + R"(, "y_m": 0})";
    write("six.json", six + "]}");
    runs("render drop --seconds 1.2 --layout six.json --out six.wav");
    refuses("play six.wav" + std::string{nobody}, 1,
            "six.wav: 6 channels: expected --layout with a file of as many actuators", 3);
    runs("play six.wav --layout six.json --seconds 0.1" + std::string{nobody});
}

TEST_F(SoundPlay, WhatExceedsFullScaleOrIsNoNumberIsTold) {
    write("loud.wav", tone(327.0f, 327.0f));
    const auto loud = runs("play loud.wav" + std::string{nobody});
    EXPECT_TRUE(has(loud.err, "loud.wav: exceeds full scale by 50.3 dB"));
    write("full.wav", tone(1.0f, 1.0f));
    EXPECT_FALSE(has(call("play full.wav" + std::string{nobody}).err, "exceeds"));
    write("nan.wav", tone(std::numeric_limits<float>::quiet_NaN(), 1.0f));
    for (const std::string& words :
         {"play nan.wav" + std::string{nobody}, std::string{"beats nan.wav --out b.csv"},
          std::string{"material nan.wav"}, std::string{"stimulus wav nan.wav --at 0.3,0.4 --out o.wav"}})
        refuses(words, 1, "nan.wav: expected finite samples, found NaN at 0.0000 s in channel 1", 3);
}

// Game controllers as users and scripts hold on to them: `render --pad`, `play --pad`, `physvib pads`.

class PadsCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        writeHits("hits.csv", "0.1,60,30,0.05,0.02,0.03\n0.5,349,106.99,0.5,0.1,0.03\n");
    }
};

TEST_F(PadsCommand, RenderWritesWhatMotorsWouldGetInsteadOfSamples) {
    const auto outcome = runs("render --from-events hits.csv --seconds 1 --pad pad-xbox --out motors.csv");
    EXPECT_TRUE(has(outcome.out, "motors.csv  what two motors of pad-xbox would get: "));
    std::istringstream file{read("motors.csv")};
    std::string line;
    std::getline(file, line);
    EXPECT_TRUE(has(line, "pad=pad-xbox"));
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
    EXPECT_TRUE(has(last, ",0.00,0.00"));
    const auto all = read("motors.csv");
    runs("render --from-events hits.csv --seconds 1 --pad pad-xbox --out motors.csv --block 17");
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
    const auto outcome = runs("render --from-events hits.csv --seconds 1 --layout dualsense --out coils.wav");
    EXPECT_TRUE(has(outcome.out, "2 channels"));
}

} // namespace physvib::play_command_test
