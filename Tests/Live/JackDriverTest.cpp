// SPDX-License-Identifier: GPL-3.0-or-later
// Devices of a JACK server: samples at the ports, and connections.
#include "JackDriverFixture.h"
#include "Live/Devices/AudioDevice.h"
#include "PortRecorder.h"
#include <algorithm>
#include <atomic>
#include <vector>

namespace physvib::test {
namespace {

std::vector<std::string> connectionsOf(const std::string& port) {
    std::vector<std::string> names;
    auto* client = jack_client_open("asks", JackNoStartServer, nullptr);
    const char** all = jack_port_get_all_connections(client, jack_port_by_name(client, port.c_str()));
    for (const char** name = all; name != nullptr && *name != nullptr; ++name) names.emplace_back(*name);
    jack_free(all);
    jack_client_close(client);
    return names;
}

TEST_F(JackDriverInRealTime, PortsGetTheUsersSamplesToTheBit) {
    for (const int channels : {1, 4, 64}) {
        const auto device = systemDevice();
        ASSERT_NE(device, nullptr);
        EXPECT_EQ(device->outputs(), 64);
        ChannelSet wanted;
        std::vector<std::string> sources;
        for (int j = 0; j < channels; ++j) {
            wanted.insert(j);
            sources.push_back("physvib:out_" + std::to_string(j + 1));
        }
        ASSERT_EQ(device->open({}, wanted, 0, 0), "");
        EXPECT_EQ(device->sampleRateHz(), 48000);
        EXPECT_EQ(device->blockFrames(), 256);
        PortRecorder recorder{sources};
        EXPECT_EQ(recorder.refused, 0);
        NoiseUser noise;
        device->start(noise);
        EXPECT_EQ(device->activeOutputs(), wanted);
        ASSERT_TRUE(comes([&] { return noise.frames > 24'000; }));
        recorder.close();
        device->stop();
        EXPECT_EQ(noise.starts, 1);
        EXPECT_EQ(noise.stops, 1);
        for (int j = 0; j < channels; ++j)
            EXPECT_TRUE(isNoise(recorder.recorded[static_cast<std::size_t>(j)], j, 20'000))
                << channels << ": " << j;
    }
}

TEST_F(JackDriverInRealTime, OutputsAreConnectedToThoseOfTheSameNumber) {
    const auto device = systemDevice();
    ASSERT_EQ(device->open({}, {1, 5, 70}, 0, 0), "");
    device->start(user);
    EXPECT_EQ(device->activeOutputs(), (ChannelSet{1, 5}));
    EXPECT_EQ(connectionsOf("physvib:out_2"), std::vector<std::string>{"system:playback_2"});
    EXPECT_EQ(connectionsOf("physvib:out_6"), std::vector<std::string>{"system:playback_6"});
    EXPECT_TRUE(connectionsOf("physvib:out_1").empty());
    ASSERT_TRUE(comes([&] { return user.blocks > 2; }));
    EXPECT_EQ(user.outputs, 2);
    EXPECT_GT(device->deviceLatencyFrames(), 0);
}

TEST_F(JackDriverInRealTime, ConnectionsOfOthersAreFollowed) {
    const auto device = systemDevice();
    ASSERT_EQ(device->open({}, {0, 1}, 0, 0), "");
    device->start(user);
    auto* other = jack_client_open("other", JackNoStartServer, nullptr);
    ASSERT_EQ(jack_disconnect(other, "physvib:out_1", "system:playback_1"), 0);
    const auto follows = [&](const ChannelSet& outputs) {
        return comes([&] { return device->isOpen() && device->activeOutputs() == outputs; });
    };
    EXPECT_TRUE(follows({1}));
    EXPECT_EQ(user.starts, 2);
    ASSERT_EQ(jack_disconnect(other, "physvib:out_2", "system:playback_2"), 0);
    EXPECT_TRUE(follows({}));
    const std::uint32_t before = user.blocks;
    std::this_thread::sleep_for(std::chrono::milliseconds{50});
    EXPECT_EQ(user.blocks, before) << "no block without outputs";
    ASSERT_EQ(jack_connect(other, "physvib:out_1", "system:playback_1"), 0);
    EXPECT_TRUE(follows({0}));
    EXPECT_TRUE(comes([&] { return user.blocks > before; }));
    jack_client_close(other);
}

/// Keeps the first sample of each block's only input.
struct Listener final : DeviceUser {
    std::atomic<float> heard{0.0f};
    void aboutToStart(AudioDevice&) override {}
    void stopped() override {}
    void block(const float* const* in, int inputs, float* const* out, int outputs,
               int frames) noexcept override {
        for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
        if (inputs == 1) heard = in[0][0];
    }
};

TEST_F(JackDriverInRealTime, InputsComeFromTheOutputsOfTheSameClient) {
    auto* other = jack_client_open("other", JackNoStartServer, nullptr);
    static jack_port_t* ports[2];
    for (auto*& port : ports)
        port = jack_port_register(other, &port == ports ? "left" : "right", JACK_DEFAULT_AUDIO_TYPE,
                                  JackPortIsOutput, 0);
    jack_port_register(other, "in", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    const auto onBlock = [](jack_nframes_t frames, void*) {
        std::fill_n(static_cast<float*>(jack_port_get_buffer(ports[0], frames)), frames, 0.25f);
        std::fill_n(static_cast<float*>(jack_port_get_buffer(ports[1], frames)), frames, 0.5f);
        return 0;
    };
    jack_set_process_callback(other, onBlock, nullptr);
    jack_activate(other);
    const auto driver = driverNamed("JACK");
    driver->scan();
    EXPECT_EQ(driver->deviceNames(true), std::vector<std::string>{"other"});
    const auto device = driver->create("other", true);
    EXPECT_EQ(device->inputs(), 2);
    Listener listener;
    ASSERT_EQ(device->open({1}, {0}, 0, 0), "");
    device->start(listener);
    EXPECT_TRUE(comes([&] { return listener.heard == 0.5f; }));
    device->close();
    jack_client_close(other);
}

TEST_F(JackDriverInRealTime, SeveralDevicesPlayAtOnceAndAreNoDevicesThemselves) {
    const auto first = systemDevice(), second = systemDevice();
    ASSERT_EQ(first->open({}, {0}, 0, 0), "");
    ASSERT_EQ(second->open({}, {1}, 0, 0), "");
    NoiseUser other;
    first->start(user);
    second->start(other);
    const auto driver = driverNamed("JACK");
    driver->scan();
    EXPECT_EQ(driver->deviceNames(false), std::vector<std::string>{"system"});
    EXPECT_TRUE(comes([&] { return user.blocks > 3 && other.blocks > 3; }));
    first->close();
    const std::uint32_t before = other.blocks;
    EXPECT_TRUE(comes([&] { return other.blocks > before + 3; }));
}

TEST_F(JackDriverInRealTime, WhatOlderVersionsSavedOfAlsasWayToJackIsJacksSystem) {
    const auto found = findAudioDevice(systemAudioDrivers, "ALSA:JACK Audio Connection Kit");
    ASSERT_NE(found.device, nullptr);
    EXPECT_EQ(found.fullName(), "JACK:system");
}

} // namespace
} // namespace physvib::test
