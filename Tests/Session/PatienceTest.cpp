// SPDX-License-Identifier: MIT
// What a world is given up for is the processor's time, not that of the day.
#include "Live/Session/OfflineRender.h"
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace physvib {
namespace {

TEST(Patience, WaitingIsNoSlowWorld) {
    Patience patience{0.05};
    std::this_thread::sleep_for(std::chrono::milliseconds{200}); // as on a machine where others work
    EXPECT_TRUE(patience(0));
    EXPECT_EQ(patience.fault(), "");
}

TEST(Patience, WorkIsGivenUp) {
    Patience patience{0.05};
    const double end = threadSeconds() + 0.15;
    while (threadSeconds() < end) {
    }
    EXPECT_TRUE(patience(1'000'000'000)) << "a second was simulated";
    EXPECT_FALSE(patience(10'000'000));
    EXPECT_TRUE(patience.fault().starts_with(
        "expected a world that is simulated as fast as it lasts, found 0.01 s of it after 0."))
        << patience.fault();
    EXPECT_TRUE(patience.fault().ends_with(" s of processor time (--patience waits longer)"))
        << patience.fault();
}

TEST(Patience, AnotherThreadsWorkIsNotCounted) {
    Patience patience{0.05};
    std::thread{[] {
        const double end = threadSeconds() + 0.15;
        while (threadSeconds() < end) {
        }
    }}.join();
    EXPECT_TRUE(patience(0));
}

} // namespace
} // namespace physvib
