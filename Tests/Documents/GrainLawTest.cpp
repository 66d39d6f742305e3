// SPDX-License-Identifier: MIT
// The law of grains in session files.
#include "Io/Json/JsonField.h"
#include "Live/Documents/ControlJson.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(GrainLaw, ComesBackAndIsTheLawOfAllElseWhereAFileNamesNone) {
    EnchanterLayout layout;
    ASSERT_TRUE(layoutPreset("phone4", layout));
    PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 0.5};
    constexpr PerChannel<PhantomPanner> kind{4};
    EXPECT_FALSE(writeKind(kind, panner).contains("grain_law")) << "as before";
    const auto back = [&](const OrderedJson& written) {
        const Json json = Json::parse(written.dump());
        return readKind(JsonField{json, "panning"}, kind).grains();
    };
    EXPECT_EQ(back(writeKind(kind, panner)), Spread::layout);
    panner.setGrains(grainSpread);
    EXPECT_EQ(writeKind(kind, panner)["grain_law"], "energy");
    EXPECT_EQ(back(writeKind(kind, panner)), grainSpread);
}

} // namespace
} // namespace physvib
