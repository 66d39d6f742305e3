// SPDX-License-Identifier: MIT
// A channel's delay: exact when it rests, without a step when it changes, silent when it is empty.
#include "Core/Actuators/ActuatorStage.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {
namespace {

std::vector<float> sine(int frames) {
    std::vector<float> x(static_cast<std::size_t>(frames));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = static_cast<float>(std::sin(0.02 * static_cast<double>(n)));
    return x;
}

TEST(ChannelDelay, DelaysByWholeFramesAtAnyBlockSize) {
    const auto in = sine(3000);
    for (const int block : {1, 7, 64, 3000}) {
        ChannelDelay<500> delay;
        delay.prepare(100, 123);
        auto out = in;
        for (int done = 0; done < 3000; done += block)
            delay.process(out.data() + done, std::min(block, 3000 - done), false);
        for (std::size_t n = 0; n < out.size(); ++n) ASSERT_EQ(out[n], n < 123 ? 0.0f : in[n - 123]) << n;
    }
}

TEST(ChannelDelay, ChangesWithoutAStep) {
    auto io = sine(4000);
    ChannelDelay<500> delay;
    delay.prepare(200, 0);
    EXPECT_TRUE(delay.isOut());
    delay.process(io.data(), 1000, false);
    delay.moveTo(400);
    delay.process(io.data() + 1000, 1500, false);
    delay.moveTo(0);
    delay.process(io.data() + 2500, 1500, false);
    EXPECT_TRUE(delay.isOut());
    for (std::size_t n = 1; n < io.size(); ++n) ASSERT_LT(std::abs(io[n] - io[n - 1]), 0.04f) << n;
}

TEST(ChannelDelay, TellsWhenNothingIsOnItsWay) {
    std::vector<float> io(100, 0.0f);
    ChannelDelay<500> delay;
    delay.prepare(10, 250);
    EXPECT_TRUE(delay.process(io.data(), 100, true));
    io[0] = 1.0f;
    EXPECT_FALSE(delay.process(io.data(), 100, false));
    int heard = 0;
    for (int block = 0; block < 10; ++block) {
        std::fill(io.begin(), io.end(), 0.0f);
        const bool isSilent = delay.process(io.data(), 100, true);
        for (const float x : io) heard += x != 0.0f ? 1 : 0;
        EXPECT_EQ(isSilent, block >= 5) << block;
    }
    EXPECT_EQ(heard, 1);
}

} // namespace
} // namespace physvib
