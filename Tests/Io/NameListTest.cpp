// SPDX-License-Identifier: MIT
// Names of a table in help and errors.
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(NameList, IsReadAsASentence) {
    const std::array<std::string_view, 4> laws{"linear", "log", "log-outer", "energy"};
    EXPECT_EQ(nameList(laws), "linear, log, log-outer, energy");
    EXPECT_EQ(nameList(laws, " or "), "linear, log, log-outer or energy");
    EXPECT_EQ(nameList(std::vector<std::string>{"one"}, " or "), "one");
    EXPECT_EQ(nameList(std::vector<std::string>{}), "");
}

TEST(NameList, NumberedNamesAreOne) {
    const std::array<std::string_view, 4> layouts{"phone1", "phone2", "ring1", "ring2"};
    EXPECT_EQ(rangeList(layouts), "phone1..phone2, ring1..ring2");
    const std::array<std::string_view, 5> names{"glove5", "phone1", "phone2", "phone4", "arm1"};
    EXPECT_EQ(rangeList(names, " to ", " or "), "glove5, phone1 to phone2, phone4 or arm1");
}

} // namespace
TEST(ByNumbers, NumbersInNamesAreOrderedByValue) {
    const std::vector<std::string> ordered{"",
                                           "P2",
                                           "P10",
                                           "condition=still level=-12",
                                           "condition=still level=-3",
                                           "condition=still level=0.05",
                                           "condition=still level=0.2",
                                           "condition=still level=01",
                                           "condition=still level=1",
                                           "condition=still level=1 loud",
                                           "condition=still level=70",
                                           "condition=still level=140",
                                           "condition=walking level=70",
                                           "x-3",
                                           "x-20"};
    for (std::size_t i = 0; i < ordered.size(); ++i)
        for (std::size_t j = 0; j < ordered.size(); ++j)
            EXPECT_EQ(NaturalOrder{}(ordered[i], ordered[j]), i < j) << ordered[i] << " and " << ordered[j];
}

TEST(ByNumbers, IsAnOrderOfAllTexts) { // each of one to four characters that it looks at
    std::vector<std::string> all{""};
    for (std::size_t from = 0, length = 0; length < 4; ++length)
        for (const std::size_t end = all.size(); from < end; ++from)
            for (const char c : {'0', '1', '9', '.', '-', 'e'}) all.push_back(all[from] + c);
    std::ranges::sort(all, NaturalOrder{});
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
        EXPECT_TRUE(NaturalOrder{}(all[i], all[i + 1]) && !NaturalOrder{}(all[i + 1], all[i])) << all[i];
    for (std::size_t i = 0; i < all.size(); i += 7) // neighbours in order tell of all
        for (std::size_t j = i + 1; j < all.size(); j += 11)
            EXPECT_TRUE(NaturalOrder{}(all[i], all[j])) << all[i] << " and " << all[j];
}

} // namespace physvib
