// SPDX-License-Identifier: MIT
// Who asks for silence, and who lifts it.
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Scheduler.h"
#include <gtest/gtest.h>
#include <thread>

namespace physvib {
namespace {

using enum MuteRequester;

TEST(MuteRequests, EachLiftsItsOwnAndTheMachineAll) {
    for (const auto holder : {machine, standardInput, osc})
        for (const auto other : {standardInput, osc}) {
            MuteRequests silence;
            silence.request(holder);
            EXPECT_TRUE(silence.isSilent());
            silence.lift(other, silence.asked(other));
            EXPECT_EQ(silence.isSilent(), holder != other);
            silence.liftAll();
            EXPECT_FALSE(silence.isSilent());
        }
    MuteRequests all;
    for (const auto holder : {machine, standardInput, osc}) all.request(holder);
    for (const auto holder : {standardInput, osc}) all.lift(holder, all.asked(holder));
    EXPECT_TRUE(all.isSilent()) << "a person at the machine has not lifted it";
    all.liftAll();
    EXPECT_FALSE(all.isSilent());
}

TEST(MuteRequests, AnOffThatHasWaitedLiftsNothingThatCameAfterIt) {
    MuteRequests silence;
    silence.request(osc);
    const std::uint64_t before = silence.asked(osc);
    silence.request(osc);
    silence.lift(osc, before);
    EXPECT_TRUE(silence.isSilent());
    silence.request(osc, 2); // again
    silence.lift(osc, 2);
    EXPECT_FALSE(silence.isSilent());
    silence.request(osc, 1);
    EXPECT_FALSE(silence.isSilent()) << "long since lifted";
    silence.lift(osc, 10);
    silence.request(osc);
    EXPECT_TRUE(silence.isSilent()) << "nothing is lifted ahead";
}

TEST(MuteRequests, AnOffThatDoesNotSoundSaysWhoStillAsks) {
    MuteRequests silence;
    EXPECT_EQ(takeSilence(silence, {true}, osc), "");
    EXPECT_TRUE(silence.isHeldBy(osc));
    EXPECT_EQ(takeSilence(silence, {false}, standardInput), "silence: still asked for by OSC");
    silence.request(machine);
    EXPECT_EQ(takeSilence(silence, {true}, standardInput), "");
    EXPECT_EQ(takeSilence(silence, {false}, osc),
              "silence: still asked for at the machine and by standard input");
    EXPECT_FALSE(silence.isHeldBy(osc)) << "its own is lifted";
    silence.liftAll();
    EXPECT_EQ(takeSilence(silence, {false}, osc), "");
}

TEST(MuteRequests, ARequestIsNeverLostToAnOffOfAnotherThread) {
    MuteRequests silence;
    for (int k = 0; k < 2000; ++k) {
        std::thread lifts{[&silence, before = silence.asked(osc)] { silence.lift(osc, before); }};
        silence.request(osc);
        lifts.join();
        ASSERT_TRUE(silence.isSilent()) << k;
    }
}

TEST(InputQueues, KeepTheirOrderAndHaveABound) {
    InputQueue<int> queue;
    EXPECT_FALSE(queue.wait(std::chrono::milliseconds{0}));
    constexpr std::size_t each = 1 << 20;
    int kept = 0;
    while (queue.push(int{kept}, each)) ++kept;
    EXPECT_EQ(kept, 15) << "16 MiB, and what each takes beside its text";
    EXPECT_TRUE(queue.wait(std::chrono::milliseconds{0}));
    EXPECT_EQ(queue.pop(), 0);
    EXPECT_TRUE(queue.push(int{kept}, each));
    for (int k = 1; k <= kept; ++k) EXPECT_EQ(queue.pop(), k);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

} // namespace
} // namespace physvib
