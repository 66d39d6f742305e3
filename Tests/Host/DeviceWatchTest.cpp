// SPDX-License-Identifier: GPL-3.0-or-later
// A device that asks for nothing has gone; a program that did not look has not lost one.
#include "Live/Devices/DeviceMeters.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace std::chrono_literals;

/// Looks at a clock of its own.
struct Looks {
    bool after(std::chrono::milliseconds pause, std::uint64_t moreBlocks, bool isIdle = false) {
        return watch.hasGone(now += pause, blocks += moreBlocks, isIdle);
    }
    DeviceWatch watch;
    DeviceWatch::Clock::time_point now{10h};
    std::uint64_t blocks = 0;
};

TEST(DeviceWatch, ADeviceThatAsksForNothingForTwoSecondsHasGone) {
    Looks look;
    EXPECT_FALSE(look.after(0s, 0));
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(look.after(1s, 94));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0)) << "and has still";
    EXPECT_FALSE(look.after(1s, 1)) << "until it asks again";
}

TEST(DeviceWatch, OneThatHasNothingToAskForHasNotGone) {
    Looks look;
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(look.after(1s, 0, true));
}

TEST(DeviceWatch, APauseIsNotALoss) {
    for (const auto pause : {2001ms, 2200ms, 3300ms, 60'000ms, 36'000'000ms}) {
        Looks look;
        look.after(0s, 1);
        look.after(1s, 94);
        EXPECT_FALSE(look.after(pause, 0)) << "a late look says nothing: " << pause.count() << " ms";
        EXPECT_FALSE(look.after(1s, 0)) << "the device has two seconds from then";
        EXPECT_FALSE(look.after(1s, 0));
        EXPECT_TRUE(look.after(1s, 0)) << "and no more";
    }
}

TEST(DeviceWatch, ADeviceThatWasOpenedAgainHasItsTwoSeconds) {
    Looks look;
    look.after(0s, 1);
    for (int i = 0; i < 3; ++i) look.after(1s, 0);
    look.watch.lose(look.now);
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0));
}

} // namespace
} // namespace physvib
