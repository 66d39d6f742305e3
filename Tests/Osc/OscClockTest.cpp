// SPDX-License-Identifier: GPL-3.0-or-later
// Time tags: what they say, and that two of them lie as far apart in the session as with their sender.
#include "Host/Osc/OscReceiver.h"
#include "Support/ClosedForm.h"
#include <cmath>
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr std::int64_t unixAhead = 1'700'000'000'000'000'000, blockNs = 10'666'667,
                       outputLatencyNs = 50'000'000, deviceNs = 21'333'333;

/// The block that begins at session time `sessionNs`, asked for `delayNs` after `steadyNs`.
OutputMoment blockAt(std::int64_t sessionNs, std::int64_t steadyNs, std::int64_t delayNs) {
    return {sessionNs - outputLatencyNs, steadyNs + delayNs + deviceNs, outputLatencyNs + deviceNs};
}

/// Blocks for `seconds` of a device that runs `ppm` too slow, each asked for up to `mostDelayNs` late.
struct Device {
    OscClock clock;
    test::Random random{5};
    std::int64_t block = 1000;
    void play(double seconds, double ppm, int mostDelayNs) {
        for (const std::int64_t end = block + static_cast<std::int64_t>(seconds * 1e9) / blockNs; block < end;
             ++block)
            clock.follow(
                blockAt(block * blockNs,
                        7'000'000'000 + std::llround(static_cast<double>(block * blockNs) * (1 + 1e-6 * ppm)),
                        random.below(mostDelayNs + 1)),
                unixAhead);
    }
};

TEST(OscClocks, TagsAreSecondsSince1900) {
    EXPECT_EQ(unixNsOf(OscTag{static_cast<std::uint64_t>(oscEpochSeconds)} << 32), 0);
    EXPECT_EQ(unixNsOf((OscTag{static_cast<std::uint64_t>(oscEpochSeconds)} << 32) + 0x8000'0000u),
              500'000'000);
    // the last is behind 2036
    for (const std::int64_t ns : {std::int64_t{0}, std::int64_t{1}, unixAhead + 123'456'789,
                                  std::int64_t{999'999'999}, std::int64_t{2'500'000'000'999'999'999}})
        EXPECT_EQ(unixNsOf(tagOf(ns)), ns);
}

TEST(OscClocks, WhatIsTaggedIsMeantForThePresentAndFeltLater) {
    Device device;
    device.play(3.0, 0.0, 0);
    const std::int64_t present = 5'000'000'000, unix = unixAhead + 7'000'000'000 + present;
    EXPECT_EQ(device.clock.sessionNs(unix), present);
    EXPECT_EQ(device.clock.presentUnixNs(present), unix);
    EXPECT_EQ(device.clock.feltUnixNs(present), unix + outputLatencyNs + deviceNs);
}

TEST(OscClocks, TheMomentIsHeldWhileBlocksComeLate) {
    Device device;
    device.play(3.0, 0.0, 3'000'000);
    const std::int64_t before = device.clock.sessionNs(unixAhead);
    EXPECT_LT(std::abs(before + 7'000'000'000), 400'000) << "the earliest block of a second";
    device.play(60.0, 0.0, 3'000'000);
    EXPECT_EQ(device.clock.sessionNs(unixAhead), before) << "to the nanosecond";
}

TEST(OscClocks, ADriftingDeviceIsFollowed) {
    Device device;
    device.play(600.0, 80.0, 100'000);
    const auto now = static_cast<double>(device.block * blockNs);
    EXPECT_NEAR(
        static_cast<double>(device.clock.presentUnixNs(device.block * blockNs) - unixAhead - 7'000'000'000),
        now * (1 + 80e-6), 1'200'000);
}

TEST(OscClocks, AnotherDeviceIsAnotherBeginning) {
    Device device;
    device.play(3.0, 0.0, 0);
    device.clock.follow(blockAt(0, 90'000'000'000, 0), unixAhead);
    EXPECT_EQ(device.clock.sessionNs(unixAhead + 90'000'000'000), 0);
}

TEST(OscClocks, TheSystemsClockIsReadAgainTheSame) {
    EXPECT_LT(std::abs(unixAheadNs() - unixAheadNs()), 100'000'000);
}

} // namespace
} // namespace physvib
