// SPDX-License-Identifier: MIT
// The map against std::map, with keys that collide.
#include "Contacts/IndexMaps.h"
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace physvib {
namespace {

TEST(IntegerMap, EqualsAStandardMapThroughRandomEdits) {
    std::mt19937 random(1);
    IntegerMap map(4);
    std::map<std::uint64_t, std::int32_t> reference;
    for (int i = 0; i < 200'000; ++i) {
        const std::uint64_t key = (1 + random() % 200) << 40U;
        if (random() % 2 == 0) {
            map.set(key, i);
            reference[key] = i;
        } else {
            map.erase(key);
            reference.erase(key);
        }
        if (random() % 1000 == 0) {
            map.clear();
            reference.clear();
        }
        const std::uint64_t asked = (1 + random() % 200) << 40U;
        const auto found = reference.find(asked);
        ASSERT_EQ(map.find(asked), found == reference.end() ? IntegerMap::none : found->second);
        ASSERT_EQ(map.size(), reference.size());
    }
}

TEST(IntegerMap, UnknownKeysHaveNoValue) {
    IntegerMap map;
    EXPECT_EQ(map.find(7), IntegerMap::none);
    map.erase(7);
    map.set(7, 3);
    EXPECT_EQ(map.find(8), IntegerMap::none);
}

} // namespace
} // namespace physvib
