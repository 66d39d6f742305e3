// SPDX-License-Identifier: MIT
// FrameClock: exact frames and leads at every rate.
#include "Core/ClockLaw.h"
#include "Core/Limits.h"
#include <gtest/gtest.h>
#include <random>

namespace physvib {
namespace {

__extension__ using Wide = __int128;

TEST(FrameClock, OnsetOnAFrameHasNoLead) {
    const FrameClock clock{44100};
    EXPECT_EQ(clock.at(100'000'000).frame, 4410);
    EXPECT_EQ(clock.at(100'000'000).leadFrames, 0.0);
    EXPECT_EQ(clock.at(0).frame, 0);
}

TEST(FrameClock, FrameIsTheFirstOneNotBeforeTheOnset) {
    std::mt19937 random{3};
    for (const int rate : {5000, 11025, 44100, 48000, 96000, 192000}) {
        const FrameClock clock{rate};
        for (int i = 0; i < 2000; ++i) {
            const std::int64_t ns = static_cast<std::int64_t>(random()) * 4096 + random() % 4096;
            const FramePosition p = clock.at(ns);
            const auto ahead = static_cast<double>(static_cast<Wide>(p.frame) * 1'000'000'000 -
                                                   static_cast<Wide>(ns) * rate);
            ASSERT_GE(ahead, 0.0);
            ASSERT_LT(ahead, 1e9);
            ASSERT_NEAR(p.leadFrames, ahead * 1e-9, 1e-15);
        }
    }
}

TEST(FrameClock, ReachesTheLastMomentWithoutOverflow) {
    EXPECT_EQ(FrameClock{192000}.at(limits::maxTimeNs).frame, 19'200'000'000'000);
}

} // namespace
} // namespace physvib
