// SPDX-License-Identifier: MIT
// JSON from anywhere: what is refused while it is parsed, and the words for it.
#include "Live/Documents/SessionFile.h"
#include "Scene/LayoutFile.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(StrictJson, IsBoundedInValuesHoweverFewBytesTheyHave) {
    std::string lists = "{\"physvib_session\": 1, \"takes\": [[]";
    for (int i = 0; i < 4'000'000; ++i) lists += ",[]";
    EXPECT_EQ(readSession(lists + "]}", "s.json").error,
              "s.json: expected at most 2500004 values and fields in so many bytes, found more");
}

TEST(StrictJson, ALongSessionIsWithinTheBound) {
    std::string inputs = "{\"physvib_session\": 200000000, \"inputs\": [0";
    for (int i = 0; i < 400'000; ++i)
        inputs += ",{\"time_s\": 1234.567891, \"input\": \"tilt\", \"angle_rad\": 0.3456}";
    // at once: no list is looked through for each of its items
    const auto error = readSession(inputs + "]}", "s.json").error;
    EXPECT_NE(error.find("made for a newer PhysVib"), std::string::npos) << error;
}

TEST(StrictJson, QuotesBytesOfAFileInCleanWords) {
    const std::string error = readLayout("{\"name\": \"\xff\x1b[2J\n\xe2\x80\xae\", }", "l.json").error;
    EXPECT_EQ(error, cleanLine(error));
    EXPECT_NE(error.find("\\x"), std::string::npos) << error;
}

TEST(CleanText, LeavesWordsAndShowsEverythingElse) {
    EXPECT_EQ(cleanLine("K\u00fcche \u2192 \U0001F600"), "K\u00fcche \u2192 \U0001F600");
    EXPECT_EQ(cleanLine("a\nb\x1b[31m\x7f"), "a\\x0ab\\x1b[31m\\x7f");
    EXPECT_EQ(cleanLine("\xff\xc3"), "\\xff\\xc3") << "no UTF-8, and half a character";
    EXPECT_EQ(cleanLine("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80")
        << "longer than need be; half of a pair";
    EXPECT_EQ(cleanLine("\u009b\u202e\u2028"), "\\xc2\\x9b\\xe2\\x80\\xae\\xe2\\x80\\xa8")
        << "controls that UTF-8 can spell";
}

} // namespace
} // namespace physvib
