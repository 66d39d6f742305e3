// SPDX-License-Identifier: GPL-3.0-or-later
// Devices of a JACK server: samples at the ports, and connections.
#include "DeviceNoise.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/JackDevice.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <jack/jack.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

// A JACK server without hardware for one test, which may kill it and start it again.
namespace physvib::test {

/// Its name goes with the process, so that tests run beside each other.
class JackServer {
public:
    JackServer() {
        setenv("JACK_DEFAULT_SERVER", ("physvib-" + std::to_string(getpid())).c_str(), 1);
        setenv("JACK_NO_AUDIO_RESERVATION", "1", 1);
    }
    /// A killed server keeps its place among the eight of a machine until one of its name ends by itself.
    ~JackServer() {
        if (wasKilled_ && process_ == 0) start(48000, 256, 2);
        end(SIGTERM);
    }
    JackServer(const JackServer&) = delete;
    JackServer& operator=(const JackServer&) = delete;

    /// False: it cannot be started here.
    bool start(int rateHz, int blockFrames, int outputs) {
        const std::string name = std::getenv("JACK_DEFAULT_SERVER");
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM);
            const int null = open("/dev/null", O_WRONLY);
            dup2(null, STDOUT_FILENO);
            dup2(null, STDERR_FILENO);
            execlp("jackd", "jackd", "-n", name.c_str(), "-r", "-S", "-d", "dummy", "-r",
                   std::to_string(rateHz).c_str(), "-p", std::to_string(blockFrames).c_str(), "-C", "0", "-P",
                   std::to_string(outputs).c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 1000; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
            if (JackClient{*jackLibrary(), "waits"}.isAlive()) return true;
        }
        return false;
    }
    void end(int signal) {
        if (process_ == 0) return;
        kill(process_, signal);
        waitpid(process_, nullptr, 0);
        process_ = 0;
        wasKilled_ = signal == SIGKILL;
    }

private:
    pid_t process_ = 0;
    bool wasKilled_ = false;
};

} // namespace physvib::test

// A JACK server of 64 outputs, and its device.
namespace physvib::test {

inline std::unique_ptr<AudioDevice> systemDevice() {
    const auto driver = driverNamed("JACK");
    driver->scan();
    return driver->create("system", false);
}

class JackDriverInRealTime : public ::testing::Test {
protected:
    void SetUp() override {
        if (!server.start(48000, 256, 64)) GTEST_SKIP() << "expected jackd to start";
    }
    JackServer server;
    NoiseUser user;
};

} // namespace physvib::test

// Records ports of JACK, and compares what came there with what tests of devices play.
namespace physvib::test {

/// Records ports of another client; what is read is whole blocks.
class PortRecorder {
public:
    explicit PortRecorder(const std::vector<std::string>& sources)
        : client_{jack_client_open("recorder", JackNoStartServer, nullptr)}
        , recorded{std::vector<std::vector<float>>(sources.size())} {
        for (auto& channel : recorded) channel.reserve(capacity);
        for (std::size_t j = 0; j < sources.size(); ++j)
            ports_.push_back(jack_port_register(client_, ("in_" + std::to_string(j + 1)).c_str(),
                                                JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
        const auto onBlock = [](jack_nframes_t frames, void* self) {
            return static_cast<PortRecorder*>(self)->process(frames);
        };
        jack_set_process_callback(client_, onBlock, this);
        jack_activate(client_);
        for (std::size_t j = 0; j < sources.size(); ++j)
            if (jack_connect(client_, sources[j].c_str(), jack_port_name(ports_[j])) != 0) ++refused;
    }
    ~PortRecorder() { close(); }
    void close() {
        if (client_ != nullptr) jack_client_close(client_);
        client_ = nullptr;
    }

    int refused = 0;
    std::atomic<std::size_t> frames{0};

private:
    static constexpr std::size_t capacity = 480'000;
    int process(jack_nframes_t count) {
        if (frames + count > capacity) return 0;
        for (std::size_t j = 0; j < ports_.size(); ++j) {
            const auto* in = static_cast<const float*>(jack_port_get_buffer(ports_[j], count));
            recorded[j].insert(recorded[j].end(), in, in + count);
        }
        frames += count;
        return 0;
    }
    jack_client_t* client_;
    std::vector<jack_port_t*> ports_;

public:
    std::vector<std::vector<float>> recorded;
};

/// Whether these are noise() of the channel, bit for bit, from the first sample that is not 0 on.
inline bool isNoise(const std::vector<float>& samples, int channel, std::size_t least) {
    std::size_t first = 0;
    while (first < samples.size() && std::bit_cast<std::uint32_t>(samples[first]) == 0) ++first;
    if (samples.size() - first < least) return false;
    for (std::size_t n = first; n < samples.size(); ++n) {
        const float expected = noise(static_cast<std::uint32_t>(n - first), channel);
        if (std::memcmp(&expected, &samples[n], sizeof expected) != 0) return false;
    }
    return true;
}

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

// As on a busy machine: JACK waits 20 blocks for itself, and the client is active all the same.
TEST_F(JackDriverInRealTime, AServerThatIsLateDoesNotRefuse) {
    static int calls;
    calls = 0;
    JackLibrary late = *jackLibrary();
    late.activate = [](jack_client_t* client) {
        const int code = jack_activate(client);
        return ++calls == 1 ? -1 : code;
    };
    JackDevice device{late, "system", false};
    ASSERT_EQ(device.open({}, {0, 1}, 0, 0), "");
    device.start(user);
    EXPECT_TRUE(comes([&] { return device.isOpen() && user.outputs == 2; }));
    late.activate = [](jack_client_t*) { return -1; };
    EXPECT_EQ((JackDevice{late, "system", false}.open({}, {0}, 0, 0)),
              "the JACK server refuses to call this program");
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
struct Listener final : AudioDeviceCallback {
    std::atomic<float> heard{0.0f};
    void aboutToStart(AudioDevice&) override {}
    void stopped() override {}
    void processBlock(const float* const* in, int inputs, float* const* out, int outputs,
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

// JACK servers that are killed and come back, and devices that are opened many times.

using JackLossInRealTime = JackDriverInRealTime;

TEST_F(JackLossInRealTime, AKilledServerComesBackAtAnotherRateTenTimes) {
    for (int i = 0; i < 10; ++i) {
        auto device = systemDevice();
        ASSERT_NE(device, nullptr) << i;
        ASSERT_EQ(device->open({}, {0, 1}, 0, 0), "") << i;
        EXPECT_EQ(device->sampleRateHz(), i % 2 == 0 ? 48000 : 44100);
        NoiseUser noise;
        device->start(noise);
        ASSERT_TRUE(comes([&] { return noise.blocks > 3; }));
        server.end(SIGKILL);
        ASSERT_TRUE(comes([&] { return !device->isOpen(); })) << i;
        device->stop();
        EXPECT_EQ(noise.stops, 1);
        device->close();
        EXPECT_EQ(systemDevice(), nullptr) << "while there is no server";
        device.reset();
        ASSERT_TRUE(server.start(i % 2 == 0 ? 44100 : 48000, i % 3 == 0 ? 128 : 512, 2 + i));
    }
}

// JACK's library frees what lost its server at the next opening; nothing may be freed or called again.
TEST_F(JackLossInRealTime, DevicesOutliveTheirServerAndAnOpening) {
    auto first = systemDevice(), second = systemDevice();
    ASSERT_EQ(first->open({}, {0}, 0, 0), "");
    ASSERT_EQ(second->open({}, {1}, 0, 0), "");
    first->start(user);
    server.end(SIGKILL);
    ASSERT_TRUE(comes([&] { return !first->isOpen() && !second->isOpen(); }));
    EXPECT_EQ(systemDevice(), nullptr);
    EXPECT_NE(first->open({}, {0}, 0, 0), "");
    ASSERT_TRUE(server.start(44100, 128, 2));
    auto third = systemDevice();
    ASSERT_EQ(third->open({}, {0}, 0, 0), "");
    first.reset();
    second.reset();
    EXPECT_TRUE(third->isOpen());
    EXPECT_EQ(third->sampleRateHz(), 44100);
    EXPECT_EQ(user.stops, 1);
    third->close();
}

TEST_F(JackLossInRealTime, ThreadsMayOpenDevicesWhileTheServerDies) {
    std::atomic<bool> isOver{false};
    std::atomic<int> played{0};
    std::vector<std::thread> threads;
    for (int j = 0; j < 3; ++j)
        threads.emplace_back([&] {
            NoiseUser noise;
            while (!isOver) {
                const auto device = systemDevice();
                if (device == nullptr || !device->open({}, {0, 1}, 0, 0).empty()) continue;
                device->start(noise);
                std::this_thread::sleep_for(std::chrono::milliseconds{20});
                if (device->isOpen()) ++played;
            }
        });
    for (int i = 0; i < 5; ++i) {
        const int before = played;
        EXPECT_TRUE(comes([&] { return played > before + 5; })) << i;
        server.end(SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds{100});
        ASSERT_TRUE(server.start(48000, 64, 2)) << i;
    }
    isOver = true;
    for (auto& thread : threads) thread.join();
}

TEST_F(JackLossInRealTime, ManyOpensAndClosesLeaveNothing) {
    server.end(SIGTERM);
    ASSERT_TRUE(server.start(48000, 64, 4)) << "each change of the graph takes a block";
    auto* client = jack_client_open("asks", JackNoStartServer, nullptr);
    const auto isConnected = [client](const char* name) {
        const auto* port = jack_port_by_name(client, name);
        return port != nullptr && jack_port_connected(port) > 0;
    };
    for (int i = 0; i < 150; ++i) {
        user.outputs = 0;
        const auto device = systemDevice();
        ASSERT_NE(device, nullptr) << i;
        ASSERT_EQ(device->open({}, {0, 1, 2, 3}, 0, 0), "") << i;
        // opening waits for them, but half a second at most: a device that runs follows them later
        for (const char* name : {"physvib:out_1", "physvib:out_2", "physvib:out_3", "physvib:out_4"})
            ASSERT_TRUE(comes([&] { return isConnected(name); })) << i;
        device->start(user);
        ASSERT_TRUE(comes([&] { return user.outputs == 4; })) << i;
    }
    EXPECT_EQ(user.starts, 150);
    EXPECT_EQ(user.stops, 150);
    const char** left = jack_get_ports(client, "^physvib", nullptr, 0);
    EXPECT_EQ(left, nullptr);
    jack_free(left);
    jack_client_close(client);
}

} // namespace
} // namespace physvib::test
