// SPDX-License-Identifier: MIT
// What a device tells whoever follows it.
#include "Live/Session/OutputClock.h"
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace physvib {
namespace {

struct Device final : OutputClock {
    using OutputClock::OutputClock;
    using OutputClock::tell;
};

TEST(OutputClock, EachOfSeveralReadersSeesMomentsWholeAndInTheirOrder) {
    constexpr int moments = 20'000;
    Device device;
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; ++i)
        readers.emplace_back([&device] {
            for (std::int64_t last = 0; last < moments;) {
                const OutputMoment now = device.felt();
                ASSERT_GE(now.sessionNs, last);
                ASSERT_EQ(now.steadyNs, now.sessionNs);
                ASSERT_EQ(now.behindNs, now.sessionNs);
                ASSERT_EQ(now.sampleRateHz, now.sessionNs);
                last = now.sessionNs;
            }
        });
    for (int n = 1; n <= moments; ++n) device.tell({n, n, n, n});
    for (std::thread& reader : readers) reader.join();
}

TEST(OutputClock, IsSilentWhileSomebodyAsksForItOrTheProgramEnds) {
    std::atomic<bool> isEnded{false};
    Device device{&isEnded};
    EXPECT_FALSE(device.isSilent());
    device.silence().request(MuteRequester::osc);
    EXPECT_TRUE(device.isSilent());
    device.setSilent(false);
    EXPECT_FALSE(device.isSilent());
    isEnded = true;
    EXPECT_TRUE(device.isSilent());
}

} // namespace
} // namespace physvib
