// SPDX-License-Identifier: MIT
// Where the bodies of a scene are, moment by moment: the same as if each moment were asked for alone.
#include "Scene/SceneCatalogue.h"
#include "Scene/World/SceneRun.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr std::int64_t everyNs = 50'000'000;

TEST(ScenePoses, InOneGoAreThoseOfEachMoment) {
    const auto scene = findScene("shake-the-box");
    ASSERT_TRUE(scene);
    const SceneRun run{.seed = 3};
    std::int64_t seen = 0;
    bool hasMoved = false;
    followPoses(scene.value, run, everyNs, 400'000'001, [&](std::int64_t timeNs, std::span<const BodyPose> poses) {
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
    followPoses(scene.value, {}, everyNs, 1'000'000'000, [&](std::int64_t, std::span<const BodyPose>) { return ++seen < 3; });
    EXPECT_EQ(seen, 3);
}

} // namespace
} // namespace physvib
