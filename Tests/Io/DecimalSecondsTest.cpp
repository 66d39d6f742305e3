// SPDX-License-Identifier: MIT
// Seconds become nanoseconds exactly, whatever way they are written.
#include "Io/Text/DecimalSeconds.h"
#include "Support/FileTesting.h"

namespace physvib {
namespace {

std::string written(std::int64_t nanoseconds) {
    std::string text;
    appendSeconds(text, nanoseconds);
    return text;
}

TEST(DecimalSeconds, AreWrittenWithNineDecimals) {
    EXPECT_EQ(written(0), "0.000000000");
    EXPECT_EQ(written(1), "0.000000001");
    EXPECT_EQ(written(250'000'000), "0.250000000");
    EXPECT_EQ(written(12'345'678'901), "12.345678901");
    EXPECT_EQ(written(-1'500'000'000), "-1.500000000");
    EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(DecimalSeconds, ReadBackToTheNanosecond) {
    std::mt19937 random(1);
    for (int i = 0; i < 100'000; ++i) {
        const std::uint64_t high = random();
        const auto range = static_cast<std::uint64_t>(limits::maxTimeNs) + 1;
        const auto nanoseconds = static_cast<std::int64_t>(((high << 32) | random()) % range);
        ASSERT_EQ(parseSeconds(written(nanoseconds)), nanoseconds);
    }
}

TEST(DecimalSeconds, NeverPassThroughADouble) {
    EXPECT_EQ(parseSeconds("999999.999999999"), 999'999'999'999'999);
    EXPECT_EQ(parseSeconds("123456.789012345"), 123'456'789'012'345);
    EXPECT_EQ(parseSeconds("0.30000000000000004"), 300'000'000);
}

TEST(DecimalSeconds, MayBeShortOrHaveAnExponent) {
    EXPECT_EQ(parseSeconds("7"), 7'000'000'000);
    EXPECT_EQ(parseSeconds("7."), 7'000'000'000);
    EXPECT_EQ(parseSeconds(".5"), 500'000'000);
    EXPECT_EQ(parseSeconds("1e-3"), 1'000'000);
    EXPECT_EQ(parseSeconds("1.5E-06"), 1'500);
    EXPECT_EQ(parseSeconds("2.5e+2"), 250'000'000'000);
    EXPECT_EQ(parseSeconds("000000000000000000000000001"), 1'000'000'000);
    EXPECT_EQ(parseSeconds("0e999"), 0);
    EXPECT_EQ(parseSeconds("1e-999"), 0);
}

TEST(DecimalSeconds, RoundHalfToEvenBeyondTheNinthDecimal) {
    EXPECT_EQ(parseSeconds("0.0000000005"), 0);
    EXPECT_EQ(parseSeconds("0.0000000015"), 2);
    EXPECT_EQ(parseSeconds("0.0000000025"), 2);
    EXPECT_EQ(parseSeconds("0.00000000050000000000000000000000001"), 1);
    EXPECT_EQ(parseSeconds("0.00000000149999999999999999999999999"), 1);
    EXPECT_EQ(parseSeconds("0.9999999996"), 1'000'000'000);
    EXPECT_EQ(parseSeconds("9e-10"), 1);
    EXPECT_EQ(parseSeconds("9e-11"), 0);
}

TEST(DecimalSeconds, EndAtTheLimit) {
    EXPECT_EQ(parseSeconds("100000000"), limits::maxTimeNs);
    EXPECT_EQ(parseSeconds("1e8"), limits::maxTimeNs);
    EXPECT_EQ(parseSeconds("100000000.0000000005"), limits::maxTimeNs);
    for (const char* text : {"100000000.000000001", "999999999.999999999", "1e9", "1e2147483647",
                             "99999999999999999999999999", "9e18"})
        EXPECT_EQ(parseSeconds(text), std::nullopt) << text;
}

TEST(DecimalSeconds, RefuseWhatIsNoTime) {
    for (const char* text :
         {"",      ".",     "-1",    "-0",   "+1",  "1,5", "1.2.3", "1e", "e5", ".e5",
          "1e+-3", "1e--3", "1e1.5", "0x10", "nan", "inf", "1 ",    " 1", "1s", "1e99999999999",
          "--1",   "1e3e3"})
        EXPECT_EQ(parseSeconds(text), std::nullopt) << text;
}

} // namespace
} // namespace physvib
