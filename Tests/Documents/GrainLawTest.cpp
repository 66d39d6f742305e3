// SPDX-License-Identifier: MIT
// The law of grains in session files.
#include "Io/Json/JsonField.h"
#include "Live/Documents/DocumentJson.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(GrainLaw, ComesBackAndIsTheLawOfAllElseWhereAFileNamesNone) {
    EnchanterLayout layout;
    ASSERT_TRUE(layoutPreset("phone4", layout));
    PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 0.5};
    LayoutDescription described;
    const DescribedPanner<const LayoutDescription> kind{4, described};
    EXPECT_FALSE(writeKind(kind, panner).contains("grain_law")) << "as before";
    const auto back = [&](const OrderedJson& written) {
        LayoutDescription read;
        const Json json = Json::parse(written.dump());
        return readKind(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{4, read}).grains();
    };
    EXPECT_EQ(back(writeKind(kind, panner)), Spread::layout);
    panner.setGrains(grainSpread);
    EXPECT_EQ(writeKind(kind, panner)["grain_law"], "energy");
    EXPECT_EQ(back(writeKind(kind, panner)), grainSpread);
    described = describeLayout("own", layout);
    described.enchanters[1].fullScaleG = 2.5;
    const Json json = Json::parse(writeKind(kind, panner).dump());
    LayoutDescription read;
    readKind(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{4, read});
    EXPECT_EQ(read.name, "own");
    EXPECT_EQ(read.enchanters, described.enchanters) << "full scales too";
}

} // namespace
} // namespace physvib
