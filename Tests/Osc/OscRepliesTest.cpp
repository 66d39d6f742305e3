// SPDX-License-Identifier: GPL-3.0-or-later
// What is sent back to a sender, by a clock of the test's own.
#include "Host/Osc/OscPort.h"
#include <deque>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <string>

namespace physvib {
namespace {

constexpr std::int64_t ms = 1'000'000;

TEST(OscRepliesLimits, QueriesInAFloodAreAnsweredWithLittleMoreThanTheyBring) {
    OscReplies replies;
    std::size_t came = 0, sent = 0;
    constexpr int seconds = 5;
    for (std::int64_t now = 0; now < seconds * 1000 * ms; now += ms / 10) { // 10,000 a second
        replies.begin("198.51.100.7:4000", 24, now);
        came += 24;
        if (replies.mayReply(232)) sent += 232;
    }
    EXPECT_LE(sent, came + seconds * OscReplies::freeBytes);
    EXPECT_GT(sent, seconds * OscReplies::freeBytes * 9 / 10) << "and yet answered";
    EXPECT_GT(replies.heldBack(), 40'000U);
}

// Whatever comes, in every second, and for every address.
TEST(OscRepliesLimits, NoSecondHasMoreThanCamePlusTwoKilobytes) {
    struct Passed {
        std::int64_t atNs;
        std::size_t came, sent;
    };
    OscReplies replies;
    std::mt19937 random{5};
    std::map<std::string, std::deque<Passed>> last;
    std::size_t most = 0;
    std::int64_t now = 0;
    for (int k = 0; k < 200'000; ++k) {
        now += static_cast<std::int64_t>(random() % (k % 10'000 < 5'000 ? ms : 20 * ms));
        const std::string address = "198.51.100." + std::to_string(random() % 3);
        Passed passed{now, 8 + random() % 120, 0};
        replies.begin(address + ":" + std::to_string(random() % 60'000), passed.came, now);
        for (auto answers = random() % 4; answers > 0; --answers)
            if (const std::size_t bytes = 20 + random() % 600; replies.mayReply(bytes)) passed.sent += bytes;
        auto& second = last[address];
        second.push_back(passed);
        while (second.front().atNs <= now - 1000 * ms) second.pop_front();
        std::size_t came = 0, sent = 0;
        for (const Passed& one : second) came += one.came, sent += one.sent;
        most = std::max(most, sent - std::min(sent, came));
        ASSERT_LE(sent, came + OscReplies::freeBytes) << k;
    }
    EXPECT_GT(most, OscReplies::freeBytes * 3 / 4) << "it is this limit that holds";
}

TEST(OscRepliesLimits, ARefusalOfACauseIsSentTenTimesASecond) {
    OscReplies replies;
    int told = 0, others = 0;
    for (std::int64_t now = 0; now < 1000 * ms; now += ms) {
        replies.begin("192.0.2.1:5", 100, now);
        told += replies.mayRefuse("strike: level: expected 0 to 1, found " + std::to_string(now)) ? 1 : 0;
        replies.begin("192.0.2.2:5", 100, now);
        others += replies.mayRefuse("strike: level: expected 0 to 1, found 2") ? 1 : 0;
    }
    EXPECT_EQ(told, 10);
    EXPECT_EQ(others, 10) << "each address by itself";
    replies.begin("192.0.2.1:5", 100, 1000 * ms);
    EXPECT_TRUE(replies.mayRefuse("strike: level: expected 0 to 1, found 3"));
    EXPECT_TRUE(replies.mayRefuse("gain: channel: expected a channel from 1 to 4, found 9"))
        << "another cause";
    EXPECT_FALSE(replies.mayRefuse("gain: channel: expected a channel from 1 to 4, found 5"));
}

TEST(OscRepliesLimits, ProgramsOfThisComputerAreToldApartOthersByTheirComputer) {
    OscReplies replies;
    const auto spend = [&replies](const char* sender, std::int64_t now) {
        std::size_t sent = 0;
        replies.begin(sender, 0, now);
        while (replies.mayReply(100)) sent += 100;
        return sent;
    };
    EXPECT_EQ(spend("127.0.0.1:4000", 0), OscReplies::freeBytes);
    EXPECT_EQ(spend("127.0.0.1:4001", 0), OscReplies::freeBytes);
    EXPECT_EQ(spend("192.0.2.1:4000", 0), OscReplies::freeBytes);
    EXPECT_EQ(spend("192.0.2.1:4001", 0), 0U) << "a port is easily made up";
    EXPECT_EQ(spend("192.0.2.1:4001", 999 * ms), 0U);
    EXPECT_EQ(spend("192.0.2.1:4001", 1000 * ms), OscReplies::freeBytes);
}

TEST(OscRepliesLimits, AddressesThatAreMadeUpGetLittleTogether) {
    OscReplies replies;
    std::size_t sent = 0;
    for (int k = 0; k < 10'000; ++k) {
        replies.begin("10.0." + std::to_string(k / 250) + '.' + std::to_string(k % 250) + ":1", 24, 0);
        for (int answers = 0; answers < 100; ++answers)
            if (replies.mayReply(100)) sent += 100;
    }
    EXPECT_LE(sent, OscReplies::maxSenders * (OscReplies::freeBytes + 24));
    replies.begin("192.0.2.1:5", 24, 1000 * ms);
    EXPECT_TRUE(replies.mayReply(100)) << "a second later there is room again";
}

} // namespace
} // namespace physvib
