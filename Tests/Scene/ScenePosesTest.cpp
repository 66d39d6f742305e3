// SPDX-License-Identifier: MIT
// Where the bodies of a scene are, moment by moment: the same as if each moment were asked for alone.
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace physvib::scene_poses_test {

constexpr std::int64_t everyNs = 50'000'000;

TEST(ScenePoses, InOneGoAreThoseOfEachMoment) {
    const auto scene = findScene("shake-the-box");
    ASSERT_TRUE(scene);
    const RunSettings run{.seed = 3};
    std::int64_t seen = 0;
    bool hasMoved = false;
    followPoses(scene.value, run, everyNs, 400'000'001, [&](std::int64_t timeNs, const WorldPoses& now) {
        const auto& poses = now.bodies;
        EXPECT_EQ(timeNs, everyNs * seen++);
        const auto alone = posesAt(scene.value, run, timeNs).bodies;
        EXPECT_EQ(poses.size(), alone.size());
        const auto start = posesAt(scene.value, run, 0).bodies;
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
                [&](std::int64_t, const WorldPoses&) { return ++seen < 3; });
    EXPECT_EQ(seen, 3);
}

TEST(ScenePoses, OfASessionWaitInItsPausesAndAreThoseOfTheTakeThatRuns) {
    const auto drop = std::make_shared<const Scene>(findScene("drop").value),
               box = std::make_shared<const Scene>(findScene("shake-the-box").value);
    const RunSettings run;
    const std::vector<SceneRun> takes{{0, 300'000'000, 4, drop, {}, {{100'000'000, 200'000'000}}},
                                      {500'000'000, 400'000'000, 5, box, {}, {{0, 10'000'000, 1000}}}};
    const auto alone = [&run](const Scene& scene, std::uint32_t seed, std::int64_t timeNs) {
        RunSettings one = run;
        one.seed = seed;
        return posesAt(scene, one, timeNs).bodies;
    };
    std::int64_t seenNs = 50'000'000;
    followRuns(takes, run, seenNs, everyNs, 900'000'000,
               [&](std::int64_t timeNs, const Scene& scene, const WorldPoses& now) {
                   const auto& poses = now.bodies;
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

TEST(ScenePoses, JointsAreWhereTheirBodiesAreAsLongAsTheyHold) {
    Scene scene;
    scene.name = "swing";
    scene.fieldWidthMetres = scene.fieldHeightMetres = 10.0;
    scene.gravityMetresPerSecond2 = {0.0, -10.0};
    scene.materials = {{"steel", 7800.0, 0.2, 0.5, 430.0, 11.97}};
    const auto body = [](const char* name, BodyType type, Vector at) {
        return BodyDescription{name, type, {{CircleShape{0.2}, {}, 0.0, 0}}, at};
    };
    scene.bodies = {body("hook", BodyType::staticBody, {5.0, 8.0}),
                    body("bob", BodyType::dynamicBody, {6.0, 8.0}),
                    body("cart", BodyType::dynamicBody, {1.0, 2.0})};
    scene.joints = {{"rod", "hook", "bob", DistanceJoint{{5.0, 8.0}, {6.0, 8.0}}},
                    {"way", "hook", "cart", SliderJoint{{1.0, 2.0}, {0.5, 0.0}, Interval{0.0, 3.0}}}};
    const auto there = [&](double seconds) {
        return posesAt(scene, {.seed = 0}, std::llround(seconds * 1e9));
    };
    const auto expectNear = [](Vector found, Vector expected) {
        EXPECT_NEAR(found.x, expected.x, 0.01);
        EXPECT_NEAR(found.y, expected.y, 0.01);
    };
    const auto swung = there(0.4);
    ASSERT_EQ(swung.joints.size(), 2u);
    EXPECT_TRUE(std::holds_alternative<DistanceJoint>(swung.joints[0].joint));
    expectNear(swung.joints[0].aMetres, {5.0, 8.0});
    expectNear(swung.joints[0].bMetres, {swung.bodies[1].xMetres, swung.bodies[1].yMetres});
    EXPECT_LT(swung.joints[0].bMetres.y, 7.7);
    expectNear(swung.joints[1].aMetres, {1.0, 2.0});
    expectNear(swung.joints[1].bMetres, {4.0, 2.0});
    for (std::size_t i = 0; i < 2; ++i) {
        const auto described = jointPose(scene.joints[i]), first = there(0.0).joints[i];
        expectNear(described.aMetres, first.aMetres);
        expectNear(described.bMetres, first.bMetres);
    }
    auto larger = scene.bodies[1];
    larger.fixtures[0].shape = CircleShape{0.3};
    scene.inputs = {{0.3, ChangeAction{larger, true}},
                    {0.5, UnjoinAction{"rod"}},
                    {0.7, JoinAction{{"rope", "hook", "cart", DistanceJoint{{5.0, 8.0}, {1.0, 2.0}}}}},
                    {0.8, RemoveAction{"cart"}}};
    const auto changed = there(0.4); // the bob is the fourth body now
    expectNear(changed.joints[0].bMetres, {changed.bodies[3].xMetres, changed.bodies[3].yMetres});
    EXPECT_EQ(there(0.6).joints.size(), 1u);
    EXPECT_EQ(there(0.75).joints.size(), 2u);
    EXPECT_EQ(there(0.9).joints.size(), 0u);
}

} // namespace physvib::scene_poses_test
