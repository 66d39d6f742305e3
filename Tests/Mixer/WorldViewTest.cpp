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

TEST(WorldView, AnActuatorWithoutAnOutputLooksOtherwiseThanAMutedOneAndThanOneThatPlays) {
    const Mix mix = MixerModel::firstMix();
    WorldView view;
    view.setSize(600, 400);
    view.show(*mix.scene);
    const auto badge = [&](std::vector<bool> muted, std::vector<bool> without) {
        view.show(mix.layout, mix.panner(), std::move(muted), std::move(without));
        const auto picture = view.createComponentSnapshot(view.badgeAt(1).expanded(2.0f).toNearestInt());
        std::vector<float> light; // shape, not colour
        for (int y = 0; y < picture.getHeight(); ++y)
            for (int x = 0; x < picture.getWidth(); ++x)
                light.push_back(picture.getPixelAt(x, y).getBrightness());
        return light;
    };
    const auto differ = [](const std::vector<float>& a, const std::vector<float>& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.size(); ++k) count += std::abs(a[k] - b[k]) > 0.1f ? 1 : 0;
        return count;
    };
    const auto plays = badge({}, {}), muted = badge({false, true}, {}),
               without = badge({false, true}, {false, true});
    EXPECT_GT(differ(muted, without), 10); // broken edge, no strokes
    EXPECT_GT(differ(plays, without), 30);
    EXPECT_GT(differ(plays, muted), 30);
}

} // namespace
} // namespace physvib
