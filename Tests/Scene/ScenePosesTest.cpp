// SPDX-License-Identifier: MIT
// Where the bodies of a scene are, moment by moment: the same as if each moment were asked for alone.
#include "Scene/SceneCatalogue.h"
#include "Scene/World/SceneRun.h"
#include <gtest/gtest.h>
#include <memory>

namespace physvib {
namespace {

constexpr std::int64_t everyNs = 50'000'000;

TEST(ScenePoses, InOneGoAreThoseOfEachMoment) {
    const auto scene = findScene("shake-the-box");
    ASSERT_TRUE(scene);
    const SceneRun run{.seed = 3};
    std::int64_t seen = 0;
    bool hasMoved = false;
    followPoses(scene.value, run, everyNs, 400'000'001,
                [&](std::int64_t timeNs, std::span<const BodyPose> poses) {
                    EXPECT_EQ(timeNs, everyNs * seen++);
                    const auto alone = posesAt(scene.value, run, timeNs);
                    EXPECT_EQ(poses.size(), alone.size());
                    const auto start = posesAt(scene.value, run, 0);
                    for (std::size_t i = 0; i < alone.size(); ++i) {
                        EXPECT_EQ(poses[i].xMetres, alone[i].xMetres);
                        EXPECT_EQ(poses[i].yMetres, alone[i].yMetres);
                        EXPECT_EQ(poses[i].angleRadians, alone[i].angleRadians);
                        EXPECT_EQ(poses[i].isPresent, alone[i].isPresent);
                        hasMoved = hasMoved || poses[i].yMetres != start[i].yMetres;
                    }
                    return true;
                });
    EXPECT_EQ(seen, 9); // 0 to 400 ms, the end not included but passed by one nanosecond
    EXPECT_TRUE(hasMoved);
}

TEST(ScenePoses, EndWhenThatIsEnough) {
    const auto scene = findScene("drop");
    ASSERT_TRUE(scene);
    int seen = 0;
    followPoses(scene.value, {}, everyNs, 1'000'000'000,
                [&](std::int64_t, std::span<const BodyPose>) { return ++seen < 3; });
    EXPECT_EQ(seen, 3);
}

TEST(ScenePoses, OfASessionWaitInItsPausesAndAreThoseOfTheTakeThatRuns) {
    const auto drop = std::make_shared<const Scene>(findScene("drop").value),
               box = std::make_shared<const Scene>(findScene("shake-the-box").value);
    const SceneRun run;
    const std::vector<SceneTake> takes{{0, 300'000'000, 4, drop, {}, {{100'000'000, 200'000'000}}},
                                       {500'000'000, 400'000'000, 5, box, {}, {{0, 10'000'000, 1000}}}};
    const auto alone = [&run](const Scene& scene, std::uint32_t seed, std::int64_t timeNs) {
        SceneRun one = run;
        one.seed = seed;
        return posesAt(scene, one, timeNs);
    };
    std::int64_t seenNs = 50'000'000;
    followTakes(takes, run, seenNs, everyNs, 900'000'000,
                [&](std::int64_t timeNs, const Scene& scene, std::span<const BodyPose> poses) {
                    EXPECT_EQ(timeNs, seenNs);
                    seenNs += everyNs;
                    const bool isFirst = timeNs < 500'000'000;
                    EXPECT_EQ(scene.name, isFirst ? "drop" : "shake-the-box");
                    const std::int64_t worldNs = !isFirst ? (timeNs - 500'000'000) / 2 // slow motion
                                                 : timeNs <= 100'000'000 ? timeNs
                                                 : timeNs <= 300'000'000 ? 100'000'000 // a pause
                                                                         : timeNs - 200'000'000;
                    const auto there =
                        alone(isFirst ? *drop : *box, isFirst ? 4 : 5, worldNs - worldNs % 10'000'000);
                    EXPECT_EQ(poses.size(), there.size());
                    for (std::size_t i = 0; i < there.size(); ++i)
                        EXPECT_EQ(poses[i].yMetres, there[i].yMetres) << timeNs << " ns, body " << i;
                    return true;
                });
    EXPECT_EQ(seenNs, 900'000'000);
}

} // namespace
} // namespace physvib
