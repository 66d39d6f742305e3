// SPDX-License-Identifier: GPL-3.0-or-later
// JACK servers that are killed and come back, and devices that are opened many times.
#include "JackDriverFixture.h"
#include <jack/jack.h>
#include <thread>
#include <vector>

namespace physvib::test {
namespace {

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
    for (int i = 0; i < 150; ++i) {
        user.outputs = 0;
        const auto device = systemDevice();
        ASSERT_NE(device, nullptr) << i;
        ASSERT_EQ(device->open({}, {0, 1, 2, 3}, 0, 0), "") << i;
        device->start(user);
        ASSERT_TRUE(comes([&] { return user.outputs == 4; }));
    }
    EXPECT_EQ(user.starts, 150);
    EXPECT_EQ(user.stops, 150);
    auto* client = jack_client_open("asks", JackNoStartServer, nullptr);
    const char** left = jack_get_ports(client, "^physvib", nullptr, 0);
    EXPECT_EQ(left, nullptr);
    jack_free(left);
    jack_client_close(client);
}

} // namespace
} // namespace physvib::test
