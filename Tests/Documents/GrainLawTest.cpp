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
    EXPECT_FALSE(pannerJson(panner).contains("grain_law")) << "as before";
    const auto back = [](const OrderedJson& written) {
        const Json json = Json::parse(written.dump());
        return readPanner({json, "panning"}, 4).grains();
    };
    EXPECT_EQ(back(pannerJson(panner)), Spread::layout);
    panner.setGrains(grainSpread);
    EXPECT_EQ(pannerJson(panner)["grain_law"], "energy");
    EXPECT_EQ(back(pannerJson(panner)), grainSpread);
}

} // namespace
} // namespace physvib
