// SPDX-License-Identifier: MIT
// The law of parts of the body in session files: what is rendered again is panned as it was live.
#include "Io/Json/JsonField.h"
#include "Live/Documents/DocumentJson.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

/// A row of three on the index, tilted, beside the tips of a hand.
EnchanterLayout gloveWithRow() {
    EnchanterLayout layout;
    EXPECT_TRUE(layoutPreset("glove5", layout));
    for (int j = 0; j < 2; ++j)
        layout.places[static_cast<std::size_t>(layout.count++)] = {
            0.06 - 0.01 * (j + 1), 0.085 - 0.03 * (j + 1), -0.01 - 0.005 * (j + 1), partNamed("index")};
    return layout;
}

OrderedJson written(const PhantomPanner& panner) {
    LayoutDescription described;
    return writeKind(DescribedPanner<const LayoutDescription>{64, described}, panner);
}

PhantomPanner readBack(const OrderedJson& text) {
    LayoutDescription described;
    const Json json = Json::parse(text.dump());
    return readKind(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{64, described});
}

PhantomPanner::Gains indexGains(const PhantomPanner& panner) {
    CollisionEvent event;
    event.x = 0.056, event.y = 0.07, event.z = -0.012;
    event.source.part = partNamed("index");
    PhantomPanner::Gains gains{};
    panner.gainsAt(event, gains);
    return gains;
}

TEST(PartLaw, ComesBackWithTheSession) {
    const PhantomPanner live{gloveWithRow(), PanningLaw::automatic, 1.0, 0.14, 0.095};
    ASSERT_EQ(live.law(), PanningLaw::distance);
    EXPECT_EQ(written(live)["law"], "distance");
    EXPECT_EQ(written(live)["part_law"], "auto");
    const PhantomPanner back = readBack(written(live));
    EXPECT_EQ(back.requestedLaw(), PanningLaw::automatic);
    EXPECT_EQ(indexGains(back), indexGains(live));
    EXPECT_EQ(written(back).dump(), written(live).dump());
}

TEST(PartLaw, IsTheLawOfAllWhereAFileNamesNone) {
    const PhantomPanner live{gloveWithRow(), PanningLaw::automatic, 1.0, 0.14, 0.095};
    OrderedJson before = written(live);
    before.erase("part_law");
    const PhantomPanner named{gloveWithRow(), PanningLaw::distance, 1.0, 0.14, 0.095};
    EXPECT_EQ(indexGains(readBack(before)), indexGains(named));
    EXPECT_NE(indexGains(readBack(before)), indexGains(live));
    EXPECT_FALSE(written(named).contains("part_law"));
    EnchanterLayout phone;
    ASSERT_TRUE(layoutPreset("phone4", phone));
    EXPECT_FALSE(written({phone, PanningLaw::automatic, 1.0, 1.0, 0.5}).contains("part_law"))
        << "a layout without parts is written as before";
}

} // namespace
} // namespace physvib
