// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play FILE.wav`: what leaves is what is in the file, each channel for its actuator.
#include "Calls.h"
#include <algorithm>
#include <cmath>
#include <cstring>
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
    refuses("play text.wav" + std::string{nobody}, 1, "text.wav: expected a WAV, FLAC or Ogg Vorbis file", 1);
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

} // namespace
} // namespace physvib
