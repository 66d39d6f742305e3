// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK server of 64 outputs, and its device.
#pragma once
#include "DeviceNoise.h"
#include "JackServer.h"
#include <gtest/gtest.h>

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
