// SPDX-License-Identifier: MIT
// A hand that holds a body: where it pulls it, how evenly, how hard at most, and what ends it.
#include "DropScene.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneWorld.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

/// A ball of 8.5 kg and a box of 40 kg, far above a plate, without weight.
Scene weightless() {
    Scene scene = dropScene(1.0);
    scene.gravityMetresPerSecond2 = {};
    scene.bodies.push_back({"box", BodyType::dynamicBody, {{BoxShape{0.4, 0.1}, {}, 0.0, 0}}, {3.0, 2.0}});
    return scene;
}

class Held {
public:
    explicit Held(Scene scene)
        : world{scene, 0, 100} {
        EXPECT_EQ(validate(scene), "");
    }
    void run(double seconds) {
        for (int i = 0; i < static_cast<int>(100.0 * seconds + 0.5); ++i) world.step(events);
    }
    void act(Action action) { world.addInput(0.0, std::move(action)); }
    /// m/s in the last step of the next `seconds`.
    Vector speedAfter(double seconds, std::size_t body) {
        run(seconds - 0.01);
        const BodyPose before = world.pose(body);
        run(0.01);
        return {100.0 * (world.pose(body).xMetres - before.xMetres),
                100.0 * (world.pose(body).yMetres - before.yMetres)};
    }
    Simulation world;
    std::vector<CollisionEvent> events;
};

constexpr std::size_t box = 2;

TEST(SceneGrips, AHandTakesABodyWhereItGoes) {
    Held held{weightless()};
    held.act(GripAction{"ball", Vector{3.0, 1.0}, {}, 1.0});
    held.act(GripAction{"box", Vector{1.0, 3.0}, Vector{0.2, 0.0}, 0.0});
    held.run(3.0);
    EXPECT_NEAR(held.world.pose(ballIndex).xMetres, 3.0, 1e-3);
    EXPECT_NEAR(held.world.pose(ballIndex).yMetres, 1.0, 1e-3);
    const BodyPose pose = held.world.pose(box);
    EXPECT_NEAR(pose.xMetres + 0.2 * std::cos(pose.angleRadians), 1.0, 5e-3) << "it is held at its end";
    EXPECT_NEAR(pose.yMetres + 0.2 * std::sin(pose.angleRadians), 3.0, 5e-3);
}

TEST(SceneGrips, AHandGoesStraightAndEvenlyAndTurnsWithoutAStop) {
    Held held{weightless()};
    const double x = held.world.pose(ballIndex).xMetres, y = held.world.pose(ballIndex).yMetres;
    held.act(GripAction{"ball", Vector{x + 2.0, y}, {}, 2.0});
    EXPECT_NEAR(held.speedAfter(1.0, ballIndex).x, 1.0, 0.01);
    held.act(GripAction{"ball", Vector{x + 1.0, y + 0.5}, {}, 0.5}); // it is at x + 1
    const Vector turned = held.speedAfter(0.5, ballIndex);
    EXPECT_NEAR(turned.x, 0.0, 0.1);
    EXPECT_NEAR(turned.y, 1.0, 0.1);
}

TEST(SceneGrips, AHandPullsByTenWeightsAtMostWhateverTheMass) {
    for (const char* name : {"ball", "box"}) {
        Held held{weightless()};
        held.act(GripAction{name, Vector{1000.0, 2.0}, {}, 0.0});
        EXPECT_NEAR(held.speedAfter(0.1, name == std::string{"ball"} ? ballIndex : box).x,
                    0.1 * sceneLimits::maxGripMetresPerSecond2, 0.6)
            << name;
    }
}

TEST(SceneGrips, WhatIsLetGoGoesOn) {
    Held held{weightless()};
    held.act(GripAction{"ball", Vector{3.7, 1.45}, {}, 2.0});
    held.run(1.0);
    held.act(GripAction{"ball", {}, {}});
    held.act(GripAction{"ball", {}, {}}); // once is enough
    const Vector speed = held.speedAfter(0.5, ballIndex), later = held.speedAfter(0.2, ballIndex);
    EXPECT_EQ(speed, later);
    EXPECT_NEAR(speed.x, 1.0, 0.02);
}

TEST(SceneGrips, ABodyThatIsRemovedOrStartsAnewIsLetGo) {
    Scene scene = weightless();
    const BodyDescription stone{"stone", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1}}, {1.0, 3.0}};
    scene.script = {{0.0, 1, 0.0, SpawnAction{stone, {}}},
                    {0.1, 1, 0.0, GripAction{"stone", Vector{3.0, 3.0}, {}, 0.0}}};
    scene.scriptPeriodSeconds = 2.0;
    Held held{scene};
    held.run(1.9);
    EXPECT_NEAR(held.world.pose(3).xMetres, 3.0, 0.01);
    held.run(0.19); // it starts anew at 2 s, and is held again at 2.1 s
    EXPECT_EQ(held.world.pose(3).xMetres, 1.0);

    held.act(SpawnAction{{"coin", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1}}, {1.0, 2.5}}, {}});
    held.act(GripAction{"coin", Vector{2.0, 2.5}, {}, 0.5});
    held.run(0.2);
    held.act(RemoveAction{"coin"});
    held.act(GripAction{"coin", Vector{1.0, 1.0}, {}, 0.5}); // nothing happens
    held.run(2.0);                                           // it is destroyed meanwhile
    EXPECT_EQ(held.world.bodiesInBox2d(), 4U);
}

TEST(SceneGrips, WhatDoesNotMoveByForcesDoesNotNotice) {
    Held held{dropScene(1.0)};
    held.act(GripAction{"plate", Vector{0.0, 0.0}, {}, 0.0});
    held.run(0.5);
    EXPECT_EQ(held.world.pose(plateIndex).xMetres, 2.0);
    InputCheck check{dropScene(1.0)};
    EXPECT_EQ(check.take(GripAction{"nobody", Vector{}, {}}),
              "body: expected the name of a body, found \"nobody\"");
    EXPECT_EQ(check.take(GripAction{"ball", Vector{1e4, 0.0}, {}}),
              "to_m[0]: expected -1000 to 1000, found 10000");
    EXPECT_EQ(check.take(GripAction{"ball", Vector{}, {}, -1.0}), "over_s: expected 0 to 86400, found -1");
}

TEST(SceneGrips, ScrapingIsFeltAndATextureMakesASurfaceRough) {
    Scene scene = dropScene(0.01);
    Held held{scene};
    held.run(1.0);
    const auto slides = [&] {
        return std::ranges::count_if(
            held.events, [](const CollisionEvent& e) { return e.source.kind != ContactKind::hit; });
    };
    held.act(GripAction{"ball", Vector{2.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_EQ(slides(), 0) << "smooth";
    held.act(TextureAction{0, 0.005});
    held.act(GripAction{"ball", Vector{1.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_GT(slides(), 100) << "1 m of grains of 5 mm";
    held.act(TextureAction{0});
    held.run(0.2);
    held.events.clear();
    held.act(GripAction{"ball", Vector{2.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_EQ(slides(), 0) << "smooth again";
}

} // namespace
} // namespace physvib
