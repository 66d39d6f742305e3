// SPDX-License-Identifier: MIT
// The second study's box is lively, well levelled, felt at every enchanter, and keeps its objects.
#include "Scene/DropScene.h"
#include "Scene/Scene.h"
#include "Scene/SceneFile.h"
#include "Scene/World/BodyMass.h"
#include "SceneHits.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

// How loud each of phone4's enchanters gets in a scene, for tests of whole scenes.
namespace physvib::box_study_test {

/// What phone4 plays, by the linear law.
inline auto onPhoneFour(const Scene& scene, const std::vector<CollisionEvent>& events, int seconds,
                        bool isLimited) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, scene.fieldWidthMetres,
                               scene.fieldHeightMetres};
    return test::renderEvents(events, {8000, 4, panner, isLimited}, seconds * 8000, {4096});
}

/// Largest sample of each enchanter, without the limiter.
inline std::array<double, 4> phoneFourPeaks(const Scene& scene, const std::vector<CollisionEvent>& events,
                                            int seconds) {
    const auto rendered = onPhoneFour(scene, events, seconds, false);
    std::array<double, 4> peaks{};
    for (std::size_t j = 0; j < peaks.size(); ++j)
        for (const float sample : rendered.channels[j])
            peaks[j] = std::max(peaks[j], std::abs(double{sample}));
    return peaks;
}

constexpr int seconds = 60;
constexpr std::array pairs{"rubber-concrete", "wood-wood", "steel-steel"};

Scene boxOf(const std::string& pair) { return findScene("box-study", {{"pair", pair}}).value; }

struct Run {
    std::string pair;
    std::uint32_t seed;
};
std::string nameOf(const testing::TestParamInfo<Run>& run) {
    return bare(run.param.pair) + "Seed" + std::to_string(run.param.seed);
}
std::vector<Run> runs(std::uint32_t first, std::uint32_t last) {
    std::vector<Run> all;
    for (const char* pair : pairs)
        for (std::uint32_t seed = first; seed <= last; ++seed) all.push_back({pair, seed});
    return all;
}

class StudiedBox : public testing::TestWithParam<Run> {
protected:
    const Scene scene = boxOf(GetParam().pair);
    const std::vector<CollisionEvent> minute = eventsOf(scene, seconds, 100, GetParam().seed);
};

TEST_P(StudiedBox, IsHitThreeTimesASecondAndNeverSilentForLong) {
    expectLively(minute, 3U * seconds, 2'500'000'000, 58'000'000'000);
}

// One drive for all pairs, at which the loudest, wood, leaves six decibels: Eq. 5.4 makes the others about 18
// dB weaker.
TEST_P(StudiedBox, PeaksWhereOneDriveForAllPairsPutsItAndUsesEveryEnchanter) {
    const auto all = phoneFourPeaks(scene, minute, seconds);
    const double loudest = *std::max_element(all.begin(), all.end());
    const bool isDefault = GetParam().pair == pairs[0]; // in the others, more objects sometimes pile up
    EXPECT_NEAR(20 * std::log10(loudest), GetParam().pair == pairs[1] ? -6 : -24.3, isDefault ? 2.5 : 4);
    for (const double peak : all) EXPECT_GE(peak, 0.2 * loudest);
}

TEST_P(StudiedBox, EveryWallIsHitAtItsInnerSide) {
    std::array<int, 4> hits{};
    for (const CollisionEvent& event : minute) {
        const auto wall = static_cast<std::size_t>(event.source.fixture);
        ASSERT_LT(wall, 4U);
        ++hits[wall];
        const std::array distances{event.y, event.y - 3.6, event.x, event.x - 6.4};
        EXPECT_LT(std::abs(distances[wall]), 0.15);
    }
    EXPECT_GE(*std::min_element(hits.begin(), hits.end()), 20);
}

INSTANTIATE_TEST_SUITE_P(PairsAndSeeds, StudiedBox, testing::ValuesIn(runs(1, 6)), nameOf);

class TenMinutesOfStudy : public testing::TestWithParam<Run> {};

// A small can between two large ones and a wall is pressed into the wall for some steps, by half its width.
TEST_P(TenMinutesOfStudy, NothingLeavesTheBox) {
    const Scene scene = boxOf(GetParam().pair);
    Simulation simulation(scene, GetParam().seed, 100);
    std::vector<CollisionEvent> events;
    std::array<int, 10> stepsInWall{};
    for (int i = 0; i < 60'000; ++i) {
        simulation.step(events);
        for (std::size_t b = 1; b < simulation.bodyCount(); ++b) {
            const BodyPose pose = simulation.pose(b);
            const double depth =
                std::max({-pose.xMetres, pose.xMetres - 6.4, -pose.yMetres, pose.yMetres - 3.6});
            stepsInWall[b] = depth > 0 ? stepsInWall[b] + 1 : 0;
            ASSERT_LT(depth, 0.06) << scene.bodies[b].name << " at step " << i;
            ASSERT_LE(stepsInWall[b], 10) << scene.bodies[b].name << " at step " << i;
        }
    }
    EXPECT_EQ(simulation.drops(), 0U);
}

INSTANTIATE_TEST_SUITE_P(PairsAndSeeds, TenMinutesOfStudy, testing::ValuesIn(runs(0, 2)), nameOf);

TEST(BoxStudy, HasTheSizesAndMassesOfTheSecondStudy) {
    const double ball = 0.4356 * std::numbers::pi * 0.0225,
                 can = 0.4356 * 0.157 * 0.30; // 66 % of the small ones
    const std::array smallMasses{120 * ball, 850 * ball, 1193 * can};
    constexpr std::array boxMasses{400.0, 340.0, 3128.0};
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Scene scene = boxOf(pairs[p]);
        EXPECT_EQ(scene.fieldWidthMetres, 6.4);
        EXPECT_EQ(scene.fieldHeightMetres, 3.6);
        ASSERT_EQ(scene.bodies.size(), 10U);
        EXPECT_EQ(massKg(scene.bodies[0], scene), boxMasses[p]);
        for (std::size_t i = 0; i < 9; ++i) {
            const auto scale = static_cast<double>(i / 3 + 1);
            EXPECT_NEAR(massKg(scene.bodies[i + 1], scene), scale * scale * smallMasses[p], 1e-9)
                << scene.bodies[i + 1].name;
        }
    }
}

TEST(BoxStudy, WallsAreOutsideTheField) {
    const BodyDescription box = boxOf("rubber-concrete").bodies[0];
    ASSERT_EQ(box.fixtures.size(), 4U);
    constexpr std::array<std::array<double, 2>, 4> inner{{{3.2, 0.0}, {3.2, 3.6}, {0.0, 1.8}, {6.4, 1.8}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& shape = std::get<BoxShape>(box.fixtures[i].shape);
        const double thickness = std::min(shape.widthMetres, shape.heightMetres);
        EXPECT_DOUBLE_EQ(thickness, 0.3); // the thesis' 0.02 m let small cans through
        const double x = box.positionMetres.x + box.fixtures[i].offsetMetres.x,
                     y = box.positionMetres.y + box.fixtures[i].offsetMetres.y;
        EXPECT_NEAR(std::hypot(x - inner[i][0], y - inner[i][1]), thickness / 2, 1e-12);
        EXPECT_TRUE(box.fixtures[i].isCamera);
    }
}

TEST(BoxStudy, DragsAreImpulsesOf32KilonewtonSecondsPerMetre) {
    for (const char* pair : pairs)
        for (const ScriptInput& input : boxOf(pair).script)
            if (const auto* drag = std::get_if<ImpulseAction>(&input.action)) {
                const double metres =
                    std::hypot(drag->impulseNewtonSeconds.x, drag->impulseNewtonSeconds.y) / 32'000;
                EXPECT_NEAR(metres * 1000, std::round(metres * 1000), 1e-9) << "whole millimetres";
                EXPECT_LE(metres, 0.05) << "within a phone's screen";
            } else
                EXPECT_TRUE(std::holds_alternative<TiltAction>(input.action))
                    << "gravity turns, and stays 9.8 m/s^2";
}

// The shaken box is lively, well levelled, and keeps its objects.

struct ShakenRun {
    std::uint32_t seed;
    int stepsPerSecond;
};
class ShakenBox : public testing::TestWithParam<ShakenRun> {
protected:
    std::vector<CollisionEvent> minute() const {
        return eventsOf(*findBuiltInScene("shake-the-box"), 60.0, GetParam().stepsPerSecond, GetParam().seed);
    }
};

TEST_P(ShakenBox, IsNeverSilentForLong) { expectLively(minute(), 180U, 2'000'000'000, 58'000'000'000); }

TEST_P(ShakenBox, HitsAllFourWallsWithTheirOwnSounds) {
    constexpr std::array<double, 4> frequencies{349.0, 349.0, 80.0, 430.0};
    constexpr std::array<double, 4> decays{106.99, 106.99, 34.13, 11.97};
    std::array<int, 4> hits{};
    for (const CollisionEvent& event : minute()) {
        const auto wall = static_cast<std::size_t>(event.source.fixture);
        ASSERT_LT(wall, 4U);
        ++hits[wall];
        EXPECT_EQ(event.frequencyHz, frequencies[wall]);
        EXPECT_EQ(event.decayPerSecond, decays[wall]);
        const std::array distances{event.y, event.y - 3.6, event.x, event.x - 6.4};
        EXPECT_LT(std::abs(distances[wall]), 0.15);
    }
    EXPECT_GE(*std::min_element(hits.begin(), hits.end()), 20);
}

TEST_P(ShakenBox, PeaksNearMinusSixDecibelsWithAWideRange) {
    std::vector<double> amplitudes;
    for (const CollisionEvent& event : minute()) amplitudes.push_back(event.amplitude);
    std::sort(amplitudes.begin(), amplitudes.end());
    EXPECT_GE(amplitudes.back(), 0.45);
    // below 1 here; another C library's sinf makes another minute: 1.08 with Windows', seed 1
    EXPECT_LE(amplitudes.back(), 1.1);
    const double fifth = amplitudes[amplitudes.size() / 20];
    EXPECT_GE(20.0 * std::log10(amplitudes.back() / fifth), 30.0); // 30 dB even without the faintest 5 %
}

std::string shakenName(const testing::TestParamInfo<ShakenRun>& run) {
    return "Seed" + std::to_string(run.param.seed) + "At" + std::to_string(run.param.stepsPerSecond) +
           "StepsPerSecond";
}

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, ShakenBox,
                         testing::Values(ShakenRun{0, 100}, ShakenRun{1, 100}, ShakenRun{2, 100},
                                         ShakenRun{3, 100}, ShakenRun{1, 1000}),
                         shakenName);

class TenMinutesInTheBox : public testing::TestWithParam<std::uint32_t> {};

TEST_P(TenMinutesInTheBox, NothingLeavesTheBox) {
    const Scene scene = *findBuiltInScene("shake-the-box");
    Simulation simulation(scene, GetParam(), 100);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 60'000; ++i) {
        simulation.step(events);
        for (std::size_t b = 4; b < simulation.bodyCount(); ++b) {
            const BodyPose pose = simulation.pose(b);
            ASSERT_TRUE(pose.xMetres > 0.0 && pose.xMetres < 6.4 && pose.yMetres > 0.0 && pose.yMetres < 3.6)
                << scene.bodies[b].name << " at step " << i;
        }
    }
    EXPECT_EQ(simulation.drops(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TenMinutesInTheBox, testing::Values(0U, 1U, 2U, 3U));

TEST(ShakeTheBox, HasTheSizesAndMassesOfTheSecondStudy) {
    const Scene scene = *findBuiltInScene("shake-the-box");
    EXPECT_EQ(scene.fieldWidthMetres, 6.4);
    EXPECT_EQ(scene.fieldHeightMetres, 3.6);
    ASSERT_EQ(scene.bodies.size(), 13U);
    // 0.66^2 times density times area of Table 5.1's objects, small to large.
    const double ball = 0.4356 * std::numbers::pi * 0.0225;
    const double can = 0.4356 * 0.157 * 0.30;
    const std::array<double, 13> masses{340.0,       340.0,       400.0,      3128.0,      120 * ball,
                                        850 * ball,  1193 * can,  480 * ball, 3400 * ball, 4772 * can,
                                        1080 * ball, 7650 * ball, 10737 * can};
    for (std::size_t i = 0; i < masses.size(); ++i)
        EXPECT_NEAR(massKg(scene.bodies[i], scene), masses[i], 1.0e-9) << scene.bodies[i].name;
}

TEST(ShakeTheBox, ScriptRepeatsAfterAtLeastTwentySeconds) {
    const Scene scene = *findBuiltInScene("shake-the-box");
    EXPECT_GE(scene.scriptPeriodSeconds, 20.0);
    const ScriptInput& last = scene.script.back();
    const double lastSeconds = last.timeSeconds + (last.times - 1) * last.everySeconds;
    EXPECT_LT(lastSeconds, scene.scriptPeriodSeconds);
    EXPECT_NEAR(lastSeconds, scene.scriptPeriodSeconds, 1.0);
}

// The fruit basket and the driven car are lively, well levelled, felt at every enchanter, and lose nothing.

struct SceneRun {
    const char* scene;
    std::uint32_t seed;
    int stepsPerSecond;
};
std::string sceneRunName(const testing::TestParamInfo<SceneRun>& run) {
    return bare(run.param.scene) + "Seed" + std::to_string(run.param.seed) + "At" +
           std::to_string(run.param.stepsPerSecond);
}
std::vector<SceneRun> sceneRuns(std::uint32_t seedsAt100, std::uint32_t seedsAt1000) {
    std::vector<SceneRun> all;
    for (const char* scene : {"fruit-basket", "driving"}) {
        for (std::uint32_t seed = 1; seed <= seedsAt100; ++seed) all.push_back({scene, seed, 100});
        for (std::uint32_t seed = 1; seed <= seedsAt1000; ++seed) all.push_back({scene, seed, 1000});
    }
    return all;
}

double decibels(double amplitude) { return 20.0 * std::log10(amplitude); }

class LivelyScene : public testing::TestWithParam<SceneRun> {
protected:
    const Scene& scene = *findBuiltInScene(GetParam().scene);
    const std::vector<CollisionEvent> minute =
        eventsOf(scene, seconds, GetParam().stepsPerSecond, GetParam().seed);
};

TEST_P(LivelyScene, IsHitThreeTimesASecondAndNeverSilentForLong) {
    expectLively(minute, 3U * seconds, 3'000'000'000, 57'000'000'000);
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

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, LivelyScene, testing::ValuesIn(sceneRuns(6, 2)), sceneRunName);

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
                         [](const auto& scene) { return bare(scene.param); });

TEST(SceneGuard, IsNotNeededByDrawing) {
    const Scene& scene = *findBuiltInScene("drawing");
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const auto rendered = onPhoneFour(scene, eventsOf(scene, 21, 100, seed), 21, true);
        EXPECT_EQ(rendered.status.guarded, 0u) << "cloth that is rubbed fast held a coil";
    }
}

class TenMinutesOfScene : public testing::TestWithParam<SceneRun> {};

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

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, TenMinutesOfScene, testing::ValuesIn(sceneRuns(3, 0)), sceneRunName);

} // namespace physvib::box_study_test
