// SPDX-License-Identifier: MIT
// Much nonsense, few words.
#include "Live/Messages/MessageRouter.h"
#include <gtest/gtest.h>
#include <string>

namespace physvib {
namespace {

constexpr std::int64_t second = 1'000'000'000;

TEST(ComplaintLimits, EachCauseIsSaidOnceInAWhileAndTheOthersAreCounted) {
    ErrorRateLimit limit{second};
    constexpr int lines = 161'806;
    int said = 0;
    for (int k = 0; k < lines; ++k)
        said +=
            limit.take("strike: level: expected 0 to 1, found " + std::to_string(k), k * (4 * second / lines))
                ? 1
                : 0;
    EXPECT_EQ(said, 4);
    EXPECT_EQ(limit.takeLeftOut(), static_cast<std::uint64_t>(lines - 4));
    EXPECT_EQ(limit.takeLeftOut(), 0U);
}

TEST(ComplaintLimits, CausesThatAreMadeUpDoNotHelp) {
    ErrorRateLimit limit{second};
    std::size_t said = 0;
    for (int k = 0; k < 100'000; ++k) {
        std::string letters;
        for (int rest = k; rest > 0; rest /= 26) letters += static_cast<char>('a' + rest % 26);
        said += limit.take(letters + ": expected something else", 0) ? 1 : 0;
    }
    EXPECT_EQ(said, ErrorRateLimit::mostCauses);
}

TEST(ComplaintLimits, ACauseIsWhatIsExpected) {
    const auto cause = [](const char* reason) { return ErrorRateLimit::causeOf(reason); };
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

} // namespace
} // namespace physvib
