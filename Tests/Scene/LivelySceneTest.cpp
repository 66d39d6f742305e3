// SPDX-License-Identifier: MIT
// The fruit basket and the driven car are lively, well levelled, felt at every enchanter, and lose nothing.
#include "PhoneFourPeaks.h"
#include "Scene/DropScene.h"
#include "Scene/SceneFile.h"
#include "SceneHits.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr int seconds = 60;

struct Run {
    const char* scene;
    std::uint32_t seed;
    int stepsPerSecond;
};
std::string nameOf(const testing::TestParamInfo<Run>& run) {
    std::string name = run.param.scene;
    std::erase(name, '-');
    return name + "Seed" + std::to_string(run.param.seed) + "At" + std::to_string(run.param.stepsPerSecond);
}
std::vector<Run> runs(std::uint32_t seedsAt100, std::uint32_t seedsAt1000) {
    std::vector<Run> all;
    for (const char* scene : {"fruit-basket", "driving"}) {
        for (std::uint32_t seed = 1; seed <= seedsAt100; ++seed) all.push_back({scene, seed, 100});
        for (std::uint32_t seed = 1; seed <= seedsAt1000; ++seed) all.push_back({scene, seed, 1000});
    }
    return all;
}

double decibels(double amplitude) { return 20.0 * std::log10(amplitude); }

class LivelyScene : public testing::TestWithParam<Run> {
protected:
    const Scene& scene = *findBuiltInScene(GetParam().scene);
    const std::vector<CollisionEvent> minute =
        eventsOf(scene, seconds, GetParam().stepsPerSecond, GetParam().seed);
};

TEST_P(LivelyScene, IsHitThreeTimesASecondAndNeverSilentForLong) {
    EXPECT_GE(minute.size(), 3U * seconds);
    std::int64_t before = 0;
    for (const CollisionEvent& event : minute) {
        EXPECT_LE(event.timeNs - before, 3'000'000'000);
        before = event.timeNs;
    }
    EXPECT_GE(before, 57'000'000'000);
}

TEST_P(LivelyScene, IsFeltAtEveryEnchanter) {
    const auto peaks = phoneFourPeaks(scene, minute, seconds);
    const double loudest = *std::max_element(peaks.begin(), peaks.end());
    for (const double peak : peaks) EXPECT_GE(decibels(peak / loudest), -20.0);
}

TEST_P(LivelyScene, IsFeltWithinItsField) {
    for (const CollisionEvent& event : minute) {
        EXPECT_TRUE(event.x >= 0.0 && event.x <= scene.fieldWidthMetres) << event.x;
        EXPECT_TRUE(event.y >= 0.0 && event.y <= scene.fieldHeightMetres) << event.y;
    }
}

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, LivelyScene, testing::ValuesIn(runs(6, 2)), nameOf);

class SceneLevel : public testing::TestWithParam<const char*> {};

TEST_P(SceneLevel, PeaksNearMinusSixDecibelsFromSeedToSeed) {
    const Scene& scene = *findBuiltInScene(GetParam());
    std::vector<double> levels;
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const auto peaks = phoneFourPeaks(scene, eventsOf(scene, seconds, 100, seed), seconds);
        levels.push_back(decibels(*std::max_element(peaks.begin(), peaks.end())));
        EXPECT_NEAR(levels.back(), -6.0, 3.5) << "seed " << seed;
    }
    std::sort(levels.begin(), levels.end());
    EXPECT_NEAR((levels[2] + levels[3]) / 2.0, -6.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneLevel, testing::Values("fruit-basket", "driving", "marbles", "drawing"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(SceneGuard, IsNotNeededByDrawing) {
    const Scene& scene = *findBuiltInScene("drawing");
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, scene.fieldWidthMetres,
                               scene.fieldHeightMetres};
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const auto rendered =
            test::renderEvents(eventsOf(scene, 21, 100, seed), {8000, 4, panner}, 21 * 8000, {4096});
        EXPECT_EQ(rendered.status.guarded, 0u) << "cloth that is rubbed fast held a coil";
    }
}

class TenMinutesOfScene : public testing::TestWithParam<Run> {};

TEST_P(TenMinutesOfScene, LoseNothingForGood) {
    const Scene& scene = *findBuiltInScene(GetParam().scene);
    const SceneHits hits(scene);
    Simulation simulation(scene, GetParam().seed, GetParam().stepsPerSecond);
    std::vector<CollisionEvent> events;
    std::vector<int> stepsOutside(simulation.bodyCount());
    for (int i = 0; i < 600 * GetParam().stepsPerSecond; ++i) {
        simulation.step(events);
        for (std::size_t b = 0; b < simulation.bodyCount(); ++b) {
            if (hits.cast()[b].type != BodyType::dynamicBody) continue;
            const BodyPose pose = simulation.pose(b);
            const bool isInside = pose.xMetres > 0.0 && pose.xMetres < scene.fieldWidthMetres &&
                                  pose.yMetres > 0.0 && pose.yMetres < scene.fieldHeightMetres;
            stepsOutside[b] = isInside || !pose.isPresent ? 0 : stepsOutside[b] + 1;
            ASSERT_LE(stepsOutside[b], 2 * GetParam().stepsPerSecond) // a jump out of the picture ends sooner
                << hits.cast()[b].name << " at step " << i;
        }
    }
    EXPECT_EQ(simulation.drops(), 0U);
}

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, TenMinutesOfScene, testing::ValuesIn(runs(3, 0)), nameOf);

} // namespace
} // namespace physvib
