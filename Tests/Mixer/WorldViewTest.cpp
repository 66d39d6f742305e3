// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen is what is felt at that time: poses wait as long as the samples that were made of them.
#include "MixerTesting.h"

namespace physvib {
namespace {

TEST(WorldView, ABodyIsSeenWhereItIsWhenThatIsFelt) {
    Scene scene;
    scene.fieldWidthMetres = 10.0;
    scene.fieldHeightMetres = 10.0;
    scene.bodies.emplace_back().name = "ball";
    WorldView view;
    view.setSize(600, 600);
    view.show(scene);
    constexpr std::int64_t ms = 1'000'000, stepNs = 10 * ms, aheadNs = 55 * ms;
    for (std::int64_t now = 0; now < 1'000 * ms; now += stepNs) { // it goes at 5 m/s
        view.update({{BodyPose{5e-9 * static_cast<double>(now), 5.0}}, now, aheadNs, {}, {}});
        // the last step before what is felt
        const std::int64_t felt = std::max<std::int64_t>(0, (now - aheadNs) / stepNs * stepNs);
        EXPECT_NEAR(view.placeOfBody("ball").x,
                    view.placeOfShare({0.5e-9 * static_cast<double>(felt), 0.5}).x, 1e-3)
            << "at " << now / ms << " ms";
    }
}

} // namespace
} // namespace physvib
