// SPDX-License-Identifier: MIT
// CRC-16 and COBS: published check values, round trips, broken frames.
#include "Wire/Frames.h"
#include <array>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace physvib {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const Bytes& payload) {
    Bytes out(cobsMaxEncoded(payload.size()));
    out.resize(cobsEncode(payload, out));
    return out;
}

TEST(Crc16, HasTheCataloguedCheckValue) {
    constexpr std::array<std::uint8_t, 9> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(crc16(digits), 0x29B1);
}

TEST(Cobs, EncodesThePublishedExamples) {
    EXPECT_EQ(encoded({0}), (Bytes{1, 1}));
    EXPECT_EQ(encoded({0x11, 0x22, 0, 0x33}), (Bytes{3, 0x11, 0x22, 2, 0x33}));
}

TEST(Cobs, RoundTripsEverythingWithoutAZero) {
    std::mt19937 random{4};
    for (int i = 0; i < 3000; ++i) {
        Bytes payload(random() % 600);
        for (auto& b : payload) b = static_cast<std::uint8_t>(random() % (1 + random() % 256));
        const Bytes frame = encoded(payload);
        ASSERT_EQ(std::count(frame.begin(), frame.end(), 0), 0);
        Bytes back(payload.size());
        ASSERT_EQ(cobsDecode(frame, back), static_cast<int>(payload.size()));
        ASSERT_EQ(back, payload);
    }
}

TEST(Cobs, BrokenFramesAreRefused) {
    Bytes out(8);
    EXPECT_EQ(cobsDecode(Bytes{5, 1, 2}, out), -1); // group longer than the frame
    EXPECT_EQ(cobsDecode(Bytes{3, 0, 2}, out), -1); // a zero inside
    EXPECT_EQ(cobsDecode(Bytes{0}, out), -1);
    EXPECT_EQ(cobsDecode(encoded(Bytes(9, 7)), out), -1); // does not fit
}

TEST(Cobs, GarbageNeverWritesPastTheEnd) {
    std::mt19937 random{9};
    for (int i = 0; i < 20000; ++i) {
        Bytes frame(random() % 40), out(random() % 20);
        for (auto& b : frame) b = static_cast<std::uint8_t>(random() % 24);
        ASSERT_LE(cobsDecode(frame, out), static_cast<int>(out.size()));
    }
}

} // namespace
} // namespace physvib
