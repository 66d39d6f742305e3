// SPDX-License-Identifier: MIT
// Names of a table in help and errors.
#include "Io/Text/NameList.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(NameList, IsReadAsASentence) {
    const std::array<std::string_view, 4> laws{"linear", "log", "log-outer", "energy"};
    EXPECT_EQ(listed(laws), "linear, log, log-outer, energy");
    EXPECT_EQ(listed(laws, " or "), "linear, log, log-outer or energy");
    EXPECT_EQ(listed(std::vector<std::string>{"one"}, " or "), "one");
    EXPECT_EQ(listed(std::vector<std::string>{}), "");
}

TEST(NameList, NumberedNamesAreOne) {
    const std::array<std::string_view, 4> layouts{"phone1", "phone2", "ring1", "ring2"};
    EXPECT_EQ(listedByNumber(layouts), "phone1..phone2, ring1..ring2");
    const std::array<std::string_view, 5> names{"glove5", "phone1", "phone2", "phone4", "arm1"};
    EXPECT_EQ(listedByNumber(names, " to ", " or "), "glove5, phone1 to phone2, phone4 or arm1");
}

} // namespace
} // namespace physvib
