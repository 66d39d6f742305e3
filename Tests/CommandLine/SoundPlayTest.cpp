// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play FILE.wav`: what leaves is what is in the file, each channel for its actuator.
#include "Calls.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace physvib {
namespace {

class SoundPlay : public test::CommandLine {
protected:
    static constexpr const char* nobody = " --device 'None:no device' --level 0";

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
    ASSERT_EQ(call("render shake-the-box --seconds 1.5 --out box.wav").exitCode, 0);
    const auto played = call(std::string{"play box.wav --record own.wav --save own.json"} + nobody);
    ASSERT_EQ(played.exitCode, 0) << played.err;
    const auto file = felt("box.wav", 4), own = felt("own.wav", 4);
    ASSERT_GT(file.size(), 40'000u);
    EXPECT_TRUE(own == file) << own.size() << " samples of " << file.size();
    EXPECT_NE(played.out.find("; 4 events left, 0 late, 0 dropped"), std::string::npos) << played.out;
    std::istringstream told{played.out.substr(played.out.find("peaks ") + 6)};
    for (std::size_t j = 0; j < 4; ++j) {
        double peak = 0.0, most = 0.0;
        told >> peak;
        for (std::size_t n = j; n < file.size(); n += 4)
            most = std::max(most, std::abs(static_cast<double>(file[n])));
        EXPECT_NEAR(peak, most, 0.001) << "what left at actuator " << j << ": " << played.out;
    }
    ASSERT_EQ(call("render own.json --out again.wav").exitCode, 0);
    EXPECT_TRUE(felt("again.wav", 4) == file) << "saved, it is rendered again";
}

TEST_F(SoundPlay, TwoChannelsAreTwoActuatorsAndTheLevelIsLowUnlessAskedFor) {
    ASSERT_EQ(call("render drop --seconds 1.2 --layout phone2 --out two.wav").exitCode, 0);
    const auto played = call("play two.wav --device 'None:no device' --record own.wav");
    ASSERT_EQ(played.exitCode, 0) << played.err;
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
    ASSERT_EQ(call("render drop --seconds 1.2 --layout six.json --out six.wav").exitCode, 0);
    refuses("play six.wav" + std::string{nobody}, 1,
            "six.wav: 6 channels: expected --layout with a file of as many actuators", 3);
    EXPECT_EQ(call("play six.wav --layout six.json --seconds 0.1" + std::string{nobody}).exitCode, 0);
}

TEST_F(SoundPlay, WhatExceedsFullScaleOrIsNoNumberIsTold) {
    const auto sound = [](float peak) {
        std::string samples;
        for (int n = 0; n < 4800; ++n)
            samples += test::numberBytes(
                std::bit_cast<std::uint32_t>(peak * static_cast<float>(std::sin(0.026 * n))), 4);
        return test::wavBytes({.format = 3, .bits = 32}, samples);
    };
    write("loud.wav", sound(327.0f));
    const auto loud = call("play loud.wav" + std::string{nobody});
    EXPECT_EQ(loud.exitCode, 0) << loud.err;
    EXPECT_NE(loud.err.find("loud.wav: exceeds full scale by 50.3 dB"), std::string::npos) << loud.err;
    write("full.wav", sound(1.0f));
    EXPECT_EQ(call("play full.wav" + std::string{nobody}).err.find("exceeds"), std::string::npos);
    write("nan.wav", sound(std::numeric_limits<float>::quiet_NaN()));
    for (const std::string& words :
         {"play nan.wav" + std::string{nobody}, std::string{"beats nan.wav --out b.csv"},
          std::string{"material nan.wav"}, std::string{"stimulus wav nan.wav --at 0.3,0.4 --out o.wav"}})
        refuses(words, 1, "nan.wav: expected finite samples, found NaN at 0.0000 s in channel 1", 3);
}

} // namespace
} // namespace physvib
