// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib calibrate` from two recordings, and how bad ones are told.
#include "Calls.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutFile.h"
#include "Support/SimulatedActuator.h"
#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace physvib {
namespace {

class CalibrateCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        ASSERT_EQ(call("calibrate --sweep sweep.wav --seconds 2 --rate 8000").exitCode, 0);
        const std::string wav = read("sweep.wav");
        const std::size_t data = wav.find("data") + 8;
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, wav.data() + data - 4, 4);
        head_ = wav.substr(0, data);
        sweep_.resize(bytes / 4);
        std::memcpy(sweep_.data(), wav.data() + data, bytes);
        ASSERT_EQ(sweep_.size(), 3u * 8000);
    }
    std::vector<float> felt() const {
        SimulatedActuator actuator{{205, 9}, 8000};
        std::vector<float> out;
        for (const float x : sweep_)
            out.push_back(static_cast<float>(0.5 * actuator.process(static_cast<double>(x))));
        return out;
    }
    void record(const std::vector<float>& samples) const {
        const auto bytes = static_cast<std::uint32_t>(4 * samples.size());
        std::string wav = head_ + std::string(reinterpret_cast<const char*>(samples.data()), bytes);
        const auto put = [&wav](std::size_t at, std::uint32_t number) {
            std::memcpy(wav.data() + at, &number, 4);
        };
        put(4, static_cast<std::uint32_t>(wav.size()) - 8);
        put(head_.size() - 4, bytes);
        write("felt.wav", wav);
    }
    static constexpr const char* pair = "calibrate --played sweep.wav --recorded felt.wav --out mine.json ";

    std::string head_;
    std::vector<float> sweep_;
};

TEST_F(CalibrateCommand, WritesTheProfileOfWhatWasRecorded) {
    record(felt());
    const auto outcome = call(std::string{pair} + "--name coin --g-per-unit 4 --drive-volts 2.5");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto profile = loadActuator(folder_ / "mine.json");
    ASSERT_TRUE(profile) << profile.error;
    const ActuatorProfile& p = profile.value;
    EXPECT_EQ(p.name, "coin");
    EXPECT_NEAR(*p.resonanceHz, 205.0, 1.0);
    EXPECT_NEAR(*p.q, 9.0, 0.45);
    EXPECT_NEAR(*p.fullScaleG, 2.0, 0.1);
    EXPECT_EQ(p.driveLimitVolts, 2.5);
    EXPECT_EQ(equaliserFault(p), "");
    ASSERT_EQ(call(std::string{pair} + "--band 150-300").exitCode, 0);
    EXPECT_EQ(loadActuator(folder_ / "mine.json").value.bandOrNone(), (FrequencyBand{150, 300}));
    EXPECT_FALSE(loadActuator(folder_ / "mine.json").value.fullScaleG); // nobody said what a sample is
}

TEST_F(CalibrateCommand, WiredTheOtherWayRoundAnActuatorIsAsStrong) {
    std::vector<float> turned = felt();
    for (float& sample : turned) sample = -sample;
    record(turned);
    ASSERT_EQ(call(std::string{pair} + "--g-per-unit 4").exitCode, 0);
    const auto profile = loadActuator(folder_ / "mine.json");
    ASSERT_TRUE(profile) << profile.error;
    EXPECT_NEAR(*profile.value.fullScaleG, 2.0, 0.1);
}

TEST_F(CalibrateCommand, WritesTheLayoutThatHasItsFullScale) {
    record(felt());
    const auto plain = call(std::string{pair} + "--g-per-unit 10");
    EXPECT_NE(plain.out.find("full scale 5.0"), std::string::npos) << plain.out;
    EXPECT_NE(plain.out.find("--layout-out FILE.json"), std::string::npos) << "it is offered: " << plain.out;
    const auto outcome =
        call(std::string{pair} + "--g-per-unit 10 --layout phone4 --place B --layout-out four.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto layout = loadLayout(folder_ / "four.json");
    ASSERT_TRUE(layout) << layout.error;
    EXPECT_NEAR(layout.value.enchanters[1].fullScaleG, 5.0, 0.25);
    EXPECT_EQ(layout.value.enchanters[1].actuator, "mine.json");
    EXPECT_EQ(layout.value.enchanters[0].fullScaleG, 1.0);
    refuses(std::string{pair} + "--layout phone4 --layout-out five.json", 2,
            "--layout-out: expected --g-per-unit", 4);
    refuses(std::string{pair} + "--g-per-unit 10 --layout phone4 --place Z --layout-out five.json", 1,
            "--place: phone4 has no actuator \"Z\"", 4);
    refuses(std::string{pair} + "--g-per-unit 10 --layout phone4 --layout-out mine.json", 2, "mine.json", 4);
}

TEST_F(CalibrateCommand, BadRecordingsAreOneLineAndLeaveNoProfile) {
    const auto refusesIt = [&](const std::vector<float>& samples, const std::string& words) {
        record(samples);
        refuses(pair, 1, words, 2);
    };
    auto samples = felt();
    refusesIt(std::vector<float>(samples.size(), 0.0f),
              "felt.wav: what was recorded: expected the sweep, found silence");
    refusesIt({0.1f}, "felt.wav: what was recorded: expected at least 0.1 s, found 1 sample");
    refusesIt({}, "felt.wav: expected samples, found none");
    refusesIt(std::vector<float>(601u * 8000), "felt.wav: expected at most 600 s");
    samples[800] = std::numeric_limits<float>::quiet_NaN();
    refusesIt(samples, "felt.wav: expected finite samples, found NaN at 0.1000 s in channel 1");
    samples = felt();
    for (float& x : samples) x = std::clamp(x, -0.05f, 0.05f);
    refusesIt(samples, "felt.wav: what was recorded: expected a recording that is not clipped");
    refusesIt(sweep_, "felt.wav: expected a resonance from 20 to 1000 Hz, found none"); // a cable
    write("felt.wav", "not a recording");
    refuses(pair, 1, "felt.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 2);
    refuses("calibrate --device Nowhere --out mine.json", 1, "Nowhere: no such audio device", 2);
}

TEST_F(CalibrateCommand, BadCallsAreUsageErrors) {
    refuses("calibrate --out mine.json", 2, "expected --device, or --played and --recorded, or --sweep", 1);
    refuses("calibrate --played sweep.wav --out mine.json", 2, "expected both --played and --recorded", 1);
    refuses("calibrate --played sweep.wav --recorded sweep.wav", 2, "expected --out FILE.json", 1);
    refuses("calibrate --played sweep.wav --recorded sweep.wav --out mine.txt", 2,
            "--out: expected a name that ends in .json, found \"mine.txt\"", 1);
    refuses("calibrate --played sweep.wav --recorded sweep.wav --out m.json --band 9", 2,
            "--band: expected LO-HI", 1);
    refuses("calibrate --device x --out m.json --channel 0", 2, "--channel", 1);
    refuses("calibrate --device x --out m.json --level 3", 2, "--level", 1);
    refuses("calibrate --sweep s.wav --device x", 2, "--sweep stands alone", 1);
}

} // namespace
} // namespace physvib
