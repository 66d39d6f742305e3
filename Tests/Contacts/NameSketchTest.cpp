// SPDX-License-Identifier: MIT
// A sketch of a set of names: no is certain, and yes is rare of what is not there.
#include "Contacts/FixtureTable.h"
#include "Contacts/IndexMaps.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::uint64_t address(int i) { return 0x7F0000001000U + 16U * static_cast<std::uint64_t>(i); }

TEST(NameSketch, NeverDeniesWhatIsThere) {
    NameSketch sketch;
    for (int i = 0; i < 50'000; ++i) sketch.add(address(i));
    for (int i = 100; i < 50'000; ++i) sketch.remove(address(i));
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(sketch.mayHave(address(i))) << i;
}

TEST(NameSketch, SeldomAffirmsWhatIsNot) {
    NameSketch sketch;
    for (int i = 0; i < 100; ++i) sketch.add(address(i));
    int affirmed = 0;
    for (int i = 100; i < 10'100; ++i) affirmed += sketch.mayHave(address(i)) ? 1 : 0;
    EXPECT_LT(affirmed, 1000); // 100 of 2,048 places are taken: 1 in 20
}

TEST(NameSketch, OfCamerasFollowsTheTable) {
    FixtureTable table;
    HapticFixture camera{}, other{};
    camera.isCamera = true;
    const std::int32_t slot = table.know(address(1), {});
    EXPECT_FALSE(table.mayBeCamera(address(1)));
    for (int i = 0; i < 2; ++i) table.set(slot, camera, {});
    EXPECT_TRUE(table.mayBeCamera(address(1)));
    table.set(slot, other, {});
    EXPECT_FALSE(table.mayBeCamera(address(1)));
    table.set(slot, camera, {});
    table.unset(slot);
    EXPECT_FALSE(table.mayBeCamera(address(1)));
    table.set(slot, camera, {});
    table.release(slot);
    EXPECT_FALSE(table.mayBeCamera(address(1)));
}

} // namespace
} // namespace physvib
