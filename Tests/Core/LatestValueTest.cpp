// SPDX-License-Identifier: MIT
// LatestValue: the newest value, whole, never going back.
#include "Core/EventQueue.h"
#include <gtest/gtest.h>
#include <thread>

namespace physvib {
namespace {

struct Wide {
    std::array<std::uint64_t, 32> words{};
};

TEST(LatestValue, IsDefaultBeforeTheFirstWrite) {
    LatestValue<int> value;
    EXPECT_EQ(value.read(), 0);
}

TEST(LatestValue, SkipsToTheNewestAndKeepsIt) {
    LatestValue<int> value;
    for (int i = 1; i <= 5; ++i) value.write(i);
    EXPECT_EQ(value.read(), 5);
    EXPECT_EQ(value.read(), 5);
    value.write(6);
    EXPECT_EQ(value.read(), 6);
}

TEST(LatestValue, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
    constexpr std::uint64_t count = 300'000;
    LatestValue<Wide> value;
    std::thread writer{[&] {
        Wide wide;
        for (std::uint64_t n = 1; n <= count; ++n) {
            wide.words.fill(n);
            value.write(wide);
        }
    }};
    std::uint64_t last = 0;
    bool whole = true, forward = true;
    while (last < count && whole && forward) {
        const Wide wide = value.read();
        for (const auto word : wide.words) whole = whole && word == wide.words[0];
        forward = wide.words[0] >= last;
        last = wide.words[0];
    }
    writer.join();
    EXPECT_TRUE(whole);
    EXPECT_TRUE(forward);
    EXPECT_EQ(value.read().words[7], count);
}

} // namespace
} // namespace physvib
