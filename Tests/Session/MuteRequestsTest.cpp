// SPDX-License-Identifier: MIT
// Who asks for silence, and who lifts it.
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Scheduler.h"
#include <gtest/gtest.h>
#include <string>
#include <thread>

namespace physvib::mute_requests_test {

using enum MuteRequester;

TEST(MuteRequests, EachLiftsItsOwnAndTheMachineAll) {
    for (const auto holder : {machine, standardInput, osc})
        for (const auto other : {standardInput, osc}) {
            MuteRequests silence;
            silence.request(holder);
            EXPECT_TRUE(silence.isSilent());
            silence.withdraw(other, silence.requestCount(other));
            EXPECT_EQ(silence.isSilent(), holder != other);
            silence.withdrawAll();
            EXPECT_FALSE(silence.isSilent());
        }
    MuteRequests all;
    for (const auto holder : {machine, standardInput, osc}) all.request(holder);
    for (const auto holder : {standardInput, osc}) all.withdraw(holder, all.requestCount(holder));
    EXPECT_TRUE(all.isSilent()) << "a person at the machine has not lifted it";
    all.withdrawAll();
    EXPECT_FALSE(all.isSilent());
}

TEST(MuteRequests, AnOffThatHasWaitedLiftsNothingThatCameAfterIt) {
    MuteRequests silence;
    silence.request(osc);
    const std::uint64_t before = silence.requestCount(osc);
    silence.request(osc);
    silence.withdraw(osc, before);
    EXPECT_TRUE(silence.isSilent());
    silence.request(osc, 2); // again
    silence.withdraw(osc, 2);
    EXPECT_FALSE(silence.isSilent());
    silence.request(osc, 1);
    EXPECT_FALSE(silence.isSilent()) << "long since lifted";
    silence.withdraw(osc, 10);
    silence.request(osc);
    EXPECT_TRUE(silence.isSilent()) << "nothing is lifted ahead";
}

TEST(MuteRequests, AnOffThatDoesNotSoundSaysWhoStillAsks) {
    MuteRequests silence;
    EXPECT_EQ(applySilence(silence, {true}, osc), "");
    EXPECT_TRUE(silence.isRequestedBy(osc));
    EXPECT_EQ(applySilence(silence, {false}, standardInput), "silence: still asked for by OSC");
    silence.request(machine);
    EXPECT_EQ(applySilence(silence, {true}, standardInput), "");
    EXPECT_EQ(applySilence(silence, {false}, osc),
              "silence: still asked for at the machine and by standard input");
    EXPECT_FALSE(silence.isRequestedBy(osc)) << "its own is lifted";
    silence.withdrawAll();
    EXPECT_EQ(applySilence(silence, {false}, osc), "");
}

TEST(MuteRequests, ARequestIsNeverLostToAnOffOfAnotherThread) {
    MuteRequests silence;
    for (int k = 0; k < 2000; ++k) {
        std::thread lifts{[&silence, before = silence.requestCount(osc)] { silence.withdraw(osc, before); }};
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

// Much nonsense, few words.

constexpr std::int64_t second = 1'000'000'000;

TEST(ComplaintLimits, EachCauseIsSaidOnceInAWhileAndTheOthersAreCounted) {
    ErrorRateLimit limit{second};
    constexpr int lines = 161'806;
    int said = 0;
    for (int k = 0; k < lines; ++k)
        said += limit.shouldReport("strike: level: expected 0 to 1, found " + std::to_string(k),
                                   k * (4 * second / lines))
                    ? 1
                    : 0;
    EXPECT_EQ(said, 4);
    EXPECT_EQ(limit.resetSuppressedCount(), static_cast<std::uint64_t>(lines - 4));
    EXPECT_EQ(limit.resetSuppressedCount(), 0U);
}

TEST(ComplaintLimits, CausesThatAreMadeUpDoNotHelp) {
    ErrorRateLimit limit{second};
    std::size_t said = 0;
    for (int k = 0; k < 100'000; ++k) {
        std::string letters;
        for (int rest = k; rest > 0; rest /= 26) letters += static_cast<char>('a' + rest % 26);
        said += limit.shouldReport(letters + ": expected something else", 0) ? 1 : 0;
    }
    EXPECT_EQ(said, ErrorRateLimit::maxCauses);
}

TEST(ComplaintLimits, ACauseIsWhatIsExpected) {
    const auto cause = [](const char* reason) { return ErrorRateLimit::hashCause(reason); };
    EXPECT_EQ(cause("gain: channel: expected a channel from 1 to 4, found 9"),
              cause("gain: channel: expected a channel from 1 to 4, found 12"));
    EXPECT_EQ(cause("\"jump\": expected the name of a message"),
              cause("\"leap\": expected the name of a message"));
    EXPECT_EQ(cause("at: expected a session time that is not over: it is 1.204 s, found 1 s"),
              cause("at: expected a session time that is not over: it is 12.301 s, found 2 s"));
    EXPECT_NE(cause("gain: channel: expected a channel"), cause("mute: channel: expected a channel"));
    EXPECT_NE(cause("strike: level: expected 0 to 1, found 2"),
              cause("strike: seconds: expected 0 to 3600, found -1"));
}

} // namespace physvib::mute_requests_test
