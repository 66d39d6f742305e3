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

// At once its middle is white; the ring of one that is silenced is empty.
TEST(WorldView, AGlowIsOfWhatIsFelt) {
    Mix mix = MixerModel::firstMix();
    Scene scene = *mix.scene;
    scene.bodies.clear();
    WorldView view;
    view.setSize(600, 400);
    view.show(scene);
    const CollisionEvent hit{.frequencyHz = 200.0,
                             .decayPerSecond = 50.0,
                             .amplitude = 1.0,
                             .x = 0.5 * scene.fieldWidthMetres,
                             .y = 0.5 * scene.fieldHeightMetres};
    double nowMs = 0.0;
    const auto glows = [&](bool isFelt, std::vector<bool> muted) {
        view.show(mix.layout, mix.panner(), std::move(muted));
        nowMs += 500.0; // longer than one is seen
        view.update({{}, 0, 0, std::span{&hit, 1}, {}, isFelt, nowMs});
        const auto at = view.placeOfShare({0.5, 0.5}).toInt();
        return view.createComponentSnapshot(view.getLocalBounds()).getPixelAt(at.x, at.y).getBrightness() >
               0.9f;
    };
    EXPECT_TRUE(glows(true, {}));
    EXPECT_TRUE(glows(true, {true, true, true, false})) << "D plays it";
    EXPECT_FALSE(glows(true, {true, true, true, true}));
    EXPECT_FALSE(glows(false, {})) << "all is silent";
}

} // namespace
} // namespace physvib
