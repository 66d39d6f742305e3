// SPDX-License-Identifier: GPL-3.0-or-later
// Devices of ALSA without hardware: null devices that write to files what a sound card would get.
#include "DeviceNoise.h"
#include "Live/Devices/AlsaDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Session/System.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>
#include <vector>

namespace physvib::test {
namespace {

/// The policy of the system's scheduler, and the priority.
std::pair<int, int> priorityOfThis() {
    int policy = -1;
    sched_param given{};
    pthread_getschedparam(pthread_self(), &policy, &given);
    return {policy, given.sched_priority};
}

/// A null device has no clock: after so many frames this user takes its time.
struct SlowUser final : AudioDeviceCallback {
    NoiseUser noise;
    std::atomic<int> inputs{0};
    std::atomic<float> loudest{0.0f};
    std::pair<int, int> priority; // of the first block
    void aboutToStart(AudioDevice& device) override { noise.aboutToStart(device); }
    void stopped() override { noise.stopped(); }
    void processBlock(const float* const* in, int channels, float* const* out, int outputs,
                      int frames) noexcept override {
        if (noise.blocks == 0) priority = priorityOfThis();
        if (noise.frames > 8192) std::this_thread::sleep_for(std::chrono::milliseconds{5});
        inputs = channels;
        for (int k = 0; k < channels; ++k)
            loudest = std::max(loudest.load(), *std::max_element(in[k], in[k] + frames));
        noise.processBlock(in, channels, out, outputs, frames);
    }
};

class AlsaDriverInRealTime : public ::testing::Test {
protected:
    void SetUp() override {
        folder = std::filesystem::temp_directory_path() / ("physvib-alsa-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder);
        setenv("HOME", folder.c_str(), 1);
        std::ofstream{folder / ".asoundrc"}
            << file("floats", "Hands") << file("shorts", "Short hands")
            << "pcm.linear { type linear slave { pcm shorts format S16_LE } "
               "hint { show on description Linear } }\n"
            << "pcm.ears { type file slave.pcm { type null } file /dev/null infile \"" +
                   (folder / "input").string() + "\" format raw hint { show on description Ears } }\n"
            << "pcm.unplugged { type hw card 30 hint { show on description Unplugged } }\n"
            << "pcm.twin { type null hint { show on description Hands } }\n"
            << "pcm.server { type jack hint { show on description \"JACK Audio Connection Kit\" } }\n"
            << "pcm.far { type plug slave.pcm { type softvol slave.pcm server } hint { show on description "
               "Far } }\n"
            << "pcm.round { type plug slave.pcm round hint { show on description Round } }\n"
            << "pcm.pulsed { type plug slave.pcm near hint { show on description Pulsed } }\n"
            << "pcm.near { type pulse }\n";
        driver = driverNamed("ALSA");
        if (driver == nullptr) GTEST_SKIP() << "expected libasound.so.2";
        driver->scan();
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string file(const std::string& id, const std::string& name) const {
        return "pcm." + id + " { type file slave.pcm { type null } file \"" + (folder / id).string() +
               "\" format raw hint { show on description \"" + name + "\" } }\n";
    }
    template <class Sample>
    std::vector<Sample> written(const std::string& id) const {
        std::ifstream in{folder / id, std::ios::binary};
        const std::string bytes{std::istreambuf_iterator<char>{in}, {}};
        std::vector<Sample> samples(bytes.size() / sizeof(Sample));
        std::copy_n(bytes.data(), samples.size() * sizeof(Sample), reinterpret_cast<char*>(samples.data()));
        return samples;
    }
    /// Plays some blocks on outputs 0 and 2, of three.
    void play(const std::string& name) {
        const auto device = driver->create(name, false);
        ASSERT_NE(device, nullptr);
        ASSERT_EQ(device->open({}, {0, 2}, 48000, 256), "");
        EXPECT_EQ(device->sampleRateHz(), 48000);
        EXPECT_EQ(device->blockFrames(), 256);
        device->start(user);
        EXPECT_EQ(device->activeOutputs(), (ChannelSet{0, 2}));
        ASSERT_TRUE(comes([&] { return user.noise.frames > 8192; }));
        device->close();
        EXPECT_FALSE(device->isOpen());
        EXPECT_EQ(user.noise.stops, 1);
        EXPECT_EQ(user.noise.outputs, 2);
    }
    std::filesystem::path folder;
    std::unique_ptr<AudioDriver> driver;
    SlowUser user;
};

TEST_F(AlsaDriverInRealTime, DevicesAreNamedByTheirDescriptions) {
    const auto names = driver->deviceNames(false);
    const auto has = [&](const std::string& name) { return std::ranges::count(names, name) == 1; };
    EXPECT_TRUE(has("Short hands"));
    EXPECT_TRUE(has("Hands (1)")) << "two have this description";
    EXPECT_TRUE(has("Hands (2)"));
    EXPECT_EQ(driver->create("Hands", false), nullptr);
}

TEST_F(AlsaDriverInRealTime, ADeviceWithFloatsGetsTheUsersSamplesToTheBit) {
    ASSERT_NO_FATAL_FAILURE(play("Hands (1)"));
    const auto samples = written<float>("floats");
    ASSERT_GT(samples.size(), 3 * 8192U);
    std::size_t first = 0; // silence until the start
    while (std::bit_cast<std::uint32_t>(samples[first]) == 0) ++first;
    ASSERT_EQ(first % 3, 0U);
    std::uint32_t frame = 0;
    for (std::size_t n = first; frame < 8192; n += 3, ++frame) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(samples[n]), std::bit_cast<std::uint32_t>(noise(frame, 0)));
        EXPECT_EQ(samples[n + 1], 0.0f) << "an output that is not wanted";
        EXPECT_EQ(std::bit_cast<std::uint32_t>(samples[n + 2]),
                  std::bit_cast<std::uint32_t>(noise(frame, 1)));
        if (HasFailure()) break;
    }
}

TEST_F(AlsaDriverInRealTime, AudioComesBeforeTheWorldWhereTheSystemGivesPriorities) {
    std::pair<int, int> ofWorld;
    std::thread{[&] { raiseThreadPriority(false), ofWorld = priorityOfThis(); }}.join();
    ASSERT_NO_FATAL_FAILURE(play("Hands (1)"));
    EXPECT_EQ(user.priority.first, ofWorld.first);
    if (ofWorld.first == SCHED_RR) EXPECT_EQ(user.priority.second, ofWorld.second + 1);
}

TEST_F(AlsaDriverInRealTime, ADeviceWithoutFloatsGetsThemRoundedAndNeverWrapped) {
    ASSERT_NO_FATAL_FAILURE(play("Linear"));
    const auto samples = written<std::int16_t>("shorts");
    std::size_t first = 0;
    std::uint32_t heard = 0; // the first frame of the noise that is not rounded to 0
    while (std::abs(noise(heard, 0)) < 0.001f) ++heard;
    while (std::abs(samples[first]) < 32 || first % 3 != 0) ++first;
    first -= 3 * heard;
    for (std::uint32_t frame = 0; frame < 8000; ++frame) {
        const float wanted = std::clamp(noise(frame, 0), -1.0f, 32767.0f / 32768.0f) * 32768.0f;
        ASSERT_NEAR(samples[first + 3 * frame], wanted, 1.0f) << frame;
    }
}

TEST_F(AlsaDriverInRealTime, InputsAreThoseOfTheSameName) {
    const std::vector<float> recorded(3 * 48'000, 0.5f);
    std::ofstream{folder / "input", std::ios::binary}.write(reinterpret_cast<const char*>(recorded.data()),
                                                            std::streamsize(sizeof(float) * recorded.size()));
    const auto device = driver->create("Ears", true);
    ASSERT_NE(device, nullptr);
    EXPECT_GT(device->inputs(), 2);
    ASSERT_EQ(device->open({1, 2}, {0}, 48000, 256), "");
    device->start(user);
    EXPECT_TRUE(comes([&] { return user.noise.blocks > 3; }));
    device->close();
    EXPECT_EQ(user.inputs, 2);
    EXPECT_EQ(user.loudest, 0.5f);
}

TEST_F(AlsaDriverInRealTime, WhatCannotBeOpenedIsNoDevice) {
    const auto listed = listAudioDevices(systemAudioDrivers);
    const auto has = [&](const std::string& name) {
        return std::ranges::find(listed, name, &AudioDeviceName::name) != listed.end();
    };
    EXPECT_TRUE(has("Short hands"));
    for (const char* const gone : {"Unplugged", "Round"}) {
        EXPECT_EQ(driver->create(gone, false), nullptr) << gone;
        EXPECT_FALSE(has(gone)) << gone;
    }
    for (const AudioDeviceName& one : listed) EXPECT_GT(one.channels, 0) << one.name;
    EXPECT_EQ(findAudioDevice(systemAudioDrivers, "ALSA:Unplugged").device, nullptr);
}

TEST_F(AlsaDriverInRealTime, NothingLeadsToJackAndToPulseOnlyWithoutJack) {
    const auto has = [&](AudioDriver& of, const std::string& name) {
        of.scan();
        const auto names = of.deviceNames(false);
        return std::ranges::find(names, name) != names.end();
    };
    AlsaDriver without{*alsaLibrary(), [] { return false; }}, with{*alsaLibrary(), [] { return true; }};
    for (AlsaDriver* const one : {&without, &with}) {
        EXPECT_FALSE(has(*one, "JACK Audio Connection Kit"));
        EXPECT_FALSE(has(*one, "Far")) << "behind two plug-ins";
        EXPECT_TRUE(has(*one, "Short hands"));
        EXPECT_EQ(one->create("JACK Audio Connection Kit", false), nullptr);
    }
    EXPECT_TRUE(has(without, "Pulsed"));
    EXPECT_FALSE(has(with, "Pulsed"));
}

TEST_F(AlsaDriverInRealTime, ThreeHundredOpensAndCloses) {
    for (int i = 0; i < 300; ++i) {
        const auto device = driver->create("Hands (2)", false);
        ASSERT_EQ(device->open({}, {0}, 0, 0), "") << i;
        device->start(user);
        ASSERT_TRUE(comes([&] { return user.noise.blocks > 0; }));
    }
    EXPECT_EQ(user.noise.stops, 300);
}

} // namespace
} // namespace physvib::test
