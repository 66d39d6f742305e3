// SPDX-License-Identifier: MIT
// What comes again is not played again; what was lost is counted, and what comes after is played.
#include "Wire/FrameDecoder.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

struct Stream {
    wire::StrikeOrder order;
    std::uint32_t frame = 4'294'960'000u; // the counter is over soon
    std::uint8_t sequence = 0xFF;
    /// The next strike, 60 ms before its onset.
    bool next() {
        frame += 11;
        return order.isNew(++sequence, frame, frame - 480);
    }
    /// That of `ago` strikes before, once more.
    bool again(int ago) {
        return order.isNew(static_cast<std::uint8_t>(sequence - ago),
                           frame - 11u * static_cast<std::uint32_t>(ago), frame - 480);
    }
};

TEST(StrikeOrder, NothingIsPlayedTwice) {
    Stream stream;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_TRUE(stream.next()) << i;
        for (const int ago : {0, 1, 2, 30, 127})
            if (ago <= i) ASSERT_FALSE(stream.again(ago)) << i << ' ' << ago;
    }
    for (int ago = 0; ago < 1000; ++ago)
        if (ago < 128 || ago * 11 - 480 > 2000) EXPECT_FALSE(stream.again(ago)) << ago;
    EXPECT_EQ(stream.order.lost(), 0u);
    EXPECT_TRUE(stream.next());
}

TEST(StrikeOrder, AnOnsetBeforeTheLastOneIsNoRepetition) {
    wire::StrikeOrder order;
    EXPECT_TRUE(order.isNew(0, 1000, 500));
    EXPECT_TRUE(order.isNew(1, 900, 500));
    EXPECT_TRUE(order.isNew(2, 900, 500)) << "a chord";
    EXPECT_FALSE(order.isNew(1, 900, 500));
}

TEST(StrikeOrder, LostStrikesAreCountedAndNothingWaitsForThem) {
    for (const int lost : {1, 5, 126, 127, 200, 254, 255}) {
        Stream stream;
        for (int i = 0; i < 10; ++i) ASSERT_TRUE(stream.next());
        stream.sequence = static_cast<std::uint8_t>(stream.sequence + lost);
        stream.frame += 11u * static_cast<std::uint32_t>(lost);
        EXPECT_TRUE(stream.next()) << lost;
        EXPECT_EQ(stream.order.lost(), static_cast<std::uint32_t>(lost));
        EXPECT_TRUE(stream.next()) << lost;
    }
}

} // namespace
} // namespace physvib
