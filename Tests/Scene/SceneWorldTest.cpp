// SPDX-License-Identifier: MIT
// Bodies, joints and actions of a scene against what mechanics say of them.
#include "Scene/World/SceneWorld.h"
#include "DropScene.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/BodyMass.h"
#include <gtest/gtest.h>

namespace physvib::scene_world_test {

/// Of one material of 100 kg/m^2 without friction or bounce.
Scene sceneOf(double gravity, std::vector<BodyDescription> bodies = {}) {
    Scene scene;
    scene.name = "test";
    scene.fieldWidthMetres = scene.fieldHeightMetres = 10.0;
    scene.materials = {{"plain", 100.0, 0.0, 0.0, 200.0, 50.0}, {"heavy", 400.0, 0.3, 0.9, 80.0, 20.0}};
    scene.bodies = std::move(bodies);
    scene.gravityMetresPerSecond2 = {0.0, -gravity};
    return scene;
}

BodyDescription body(std::string name, Shape shape, Vector at, BodyType type = BodyType::dynamicBody) {
    BodyDescription made{std::move(name), type, {{std::move(shape)}}, at};
    if (type != BodyType::dynamicBody) made.massKg = 1.0;
    return made;
}

ScriptInput at(double seconds, Action action) { return {seconds, 1, 0.0, std::move(action)}; }

class World {
public:
    explicit World(const Scene& scene, std::uint32_t seed = 0)
        : inner(scene, seed, {100}) {
        EXPECT_EQ(validate(scene), "");
    }
    void run(double seconds) {
        for (const int end = step + static_cast<int>(seconds * 100.0 + 0.5); step < end; ++step) {
            inner.executeActions(step);
            inner.world().Step(0.01F, 8, 3);
        }
    }
    BodyPose pose(std::size_t body) const { return inner.pose(body); }
    SceneWorld::CurrentFixture now(std::size_t number) const {
        std::vector<SceneWorld::CurrentFixture> found;
        inner.forEachFixture([&](const SceneWorld::CurrentFixture& one) {
            if (one.number == number) found.push_back(one);
        });
        return found.at(0);
    }
    const b2Fixture& fixture(std::size_t number) const { return now(number).fixture; }
    std::size_t fixtureCount() const {
        std::size_t count = 0;
        inner.forEachFixture([&](const SceneWorld::CurrentFixture&) { ++count; });
        return count;
    }

    SceneWorld inner;
    int step = 0;
};

double mass(const World& world, std::size_t fixture) { return world.fixture(fixture).GetBody()->GetMass(); }

/// Height at which a small ball comes to rest on body 0, dropped at x.
double restingHeight(const Shape& ground, double x) {
    Scene scene = sceneOf(10.0, {body("ground", ground, {0.0, 0.0}, BodyType::staticBody),
                                 body("ball", CircleShape{0.1}, {x, 2.0})});
    World world(scene);
    world.run(3.0);
    return world.pose(1).yMetres - 0.1;
}

constexpr double slop = 0.006; // Box2D lets bodies sink in by 5 mm

TEST(SceneWorld, EveryShapeIsWhereItIsDescribed) {
    const double box = restingHeight(BoxShape{4.0, 2.0}, 0.5);
    EXPECT_NEAR(box, 1.0, slop);
    EXPECT_NEAR(restingHeight(PolygonShape{{{-2.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {-2.0, 1.0}}}, 0.5), box,
                1.0e-3);
    EXPECT_NEAR(restingHeight(ChainShape{{{4.0, 1.0}, {0.0, 1.0}, {-4.0, 1.0}}}, 0.5), box, 1.0e-3);
}

TEST(SceneWorld, ChainsAreHitFromTheRightOfTheirDirection) {
    EXPECT_LT(restingHeight(ChainShape{{{-4.0, 1.0}, {0.0, 1.0}, {4.0, 1.0}}}, 0.5), -10.0); // falls through
    const std::vector<Vector> clockwise{{-3.0, -1.0}, {-3.0, 3.0}, {3.0, 3.0}, {3.0, -1.0}};
    EXPECT_NEAR(restingHeight(ChainShape{clockwise, true}, 0.0), -1.0, slop); // contains
    const std::vector<Vector> counterClockwise{{-3.0, -1.0}, {3.0, -1.0}, {3.0, 1.0}, {-3.0, 1.0}};
    EXPECT_NEAR(restingHeight(ChainShape{counterClockwise, true}, 0.0), 1.0, slop); // keeps out
}

TEST(SceneWorld, FixturesSitAtTheirOffsetAndAngle) {
    Scene scene = sceneOf(0.0, {body("turned", BoxShape{2.0, 0.2}, {5.0, 5.0}, BodyType::staticBody)});
    scene.bodies[0].fixtures[0].offsetMetres = {1.0, 2.0};
    scene.bodies[0].fixtures[0].angleRadians = 1.5707963267948966;
    const World world(scene);
    EXPECT_TRUE(world.fixture(0).TestPoint({6.0F, 7.9F}));
    EXPECT_FALSE(world.fixture(0).TestPoint({6.9F, 7.0F}));
}

TEST(SceneWorld, SeveralFixturesShareAMassAndACentre) {
    Scene scene = sceneOf(0.0, {body("dumb-bell", BoxShape{1.0, 1.0}, {5.0, 5.0})});
    scene.bodies[0].fixtures.push_back({BoxShape{1.0, 1.0}, {4.0, 0.0}, 0.0, 1}); // four times as heavy
    const World world(scene);
    const b2Body& built = *world.fixture(0).GetBody();
    EXPECT_NEAR(built.GetMass(), 500.0, 1.0e-3);
    EXPECT_NEAR(built.GetWorldCenter().x, 5.0 + 4.0 * 400.0 / 500.0, 1.0e-5);
    const double inertia = 500.0 / 6.0 + 100.0 * 3.2 * 3.2 + 400.0 * 0.8 * 0.8; // about the centre
    EXPECT_NEAR(bodyMoments(scene.bodies[0], scene).inertiaKgSquareMetres, inertia, 1.0e-9);
    EXPECT_NEAR(built.GetInertia(), inertia + 500.0 * 3.2 * 3.2, 0.01); // Box2D's is about the origin
}

TEST(SceneWorld, APrintedMassReplacesTheComputedOne) {
    Scene scene = sceneOf(0.0, {body("ball", CircleShape{0.5}, {5.0, 5.0})});
    scene.bodies[0].massKg = 8.48;
    const World world(scene);
    EXPECT_FLOAT_EQ(world.fixture(0).GetBody()->GetMass(), 8.48F);
    EXPECT_FLOAT_EQ(world.fixture(0).GetBody()->GetInertia(), 8.48F * 0.125F);
    EXPECT_EQ(massKg(scene.bodies[0], scene), 8.48);
}

TEST(SceneWorld, BodiesStartAsTheyAreDescribed) {
    Scene scene = sceneOf(0.0, {body("flying", CircleShape{0.5}, {1.0, 5.0}),
                                body("slowing", CircleShape{0.5}, {1.0, 8.0}),
                                body("carrying", BoxShape{1.0, 0.2}, {1.0, 1.0}, BodyType::kinematicBody)});
    scene.bodies[0].velocityMetresPerSecond = scene.bodies[1].velocityMetresPerSecond =
        scene.bodies[2].velocityMetresPerSecond = {2.0, 0.5};
    scene.bodies[0].spinRadiansPerSecond = 3.0;
    scene.bodies[1].linearDampingPerSecond = 1.0;
    World world(scene);
    world.run(1.0);
    EXPECT_NEAR(world.pose(0).xMetres, 3.0, 1.0e-4);
    EXPECT_NEAR(world.pose(0).angleRadians, 3.0, 1.0e-4);
    EXPECT_NEAR(world.pose(1).xMetres, 1.0 + 2.0 * (1.0 - std::exp(-1.0)), 0.02);
    EXPECT_NEAR(world.pose(2).yMetres, 1.5, 1.0e-4);
}

TEST(SceneWorld, MotorTurnsAHingeUpToItsLimit) {
    Scene scene = sceneOf(0.0, {body("base", BoxShape{1.0, 1.0}, {5.0, 5.0}, BodyType::staticBody),
                                body("arm", BoxShape{2.0, 0.2}, {6.0, 5.0})});
    scene.joints = {{"hinge", "base", "arm", RevoluteJoint{{5.0, 5.0}, Interval{-0.5, 1.0}, 2.0, 1.0e5}}};
    scene.script = {at(1.0, MotorAction{"hinge", -2.0, {}})};
    World world(scene);
    world.run(0.25);
    EXPECT_NEAR(world.pose(1).angleRadians, 0.5, 0.05);
    world.run(0.75);
    EXPECT_NEAR(world.pose(1).angleRadians, 1.0, 0.05);
    EXPECT_NEAR(world.pose(1).xMetres, 5.0 + std::cos(1.0), 0.05);
    world.run(2.0);
    EXPECT_NEAR(world.pose(1).angleRadians, -0.5, 0.05);
}

TEST(SceneWorld, WheelCarriesItsCarOnASpringAndDrivesIt) {
    Scene scene = sceneOf(10.0);
    scene.materials[0].friction = 0.9;
    scene.bodies = {body("road", BoxShape{50.0, 1.0}, {0.0, -0.5}, BodyType::staticBody),
                    body("car", BoxShape{2.0, 0.4}, {0.0, 0.8}), body("rear", CircleShape{0.3}, {-0.8, 0.3}),
                    body("front", CircleShape{0.3}, {0.8, 0.3})};
    for (const char* wheel : {"rear", "front"}) {
        const double x = wheel[0] == 'r' ? -0.8 : 0.8;
        scene.joints.push_back({wheel, "car", wheel,
                                WheelJoint{{x, 0.3}, {0.0, 0.5}, 4.0, 0.7, Interval{-0.2, 0.2}, 0.0, 500.0}});
    }
    scene.script = {at(2.0, MotorAction{"rear", -5.0, {}}), at(2.0, MotorAction{"front", -5.0, {}})};
    World world(scene);
    world.run(2.0);
    EXPECT_NEAR(world.pose(1).xMetres, 0.0, 0.05);
    EXPECT_GT(world.pose(1).yMetres, 0.6);
    EXPECT_LT(world.pose(1).yMetres, 0.8); // the spring has given way
    world.run(4.0);
    EXPECT_GT(world.pose(1).xMetres, 3.0); // clockwise wheels roll to the right, at most 1.5 m/s
    EXPECT_LT(world.pose(1).xMetres, 6.1);
}

TEST(SceneWorld, WheelHangsAtTheEndOfItsTravel) {
    Scene scene = sceneOf(10.0, {body("hook", BoxShape{0.2, 0.2}, {5.0, 8.0}, BodyType::staticBody),
                                 body("wheel", CircleShape{0.2}, {5.0, 7.0})});
    scene.joints = {
        {"axle", "hook", "wheel", WheelJoint{{5.0, 7.0}, {0.0, 0.5}, 0.0, 0.0, Interval{-0.3, 0.2}}}};
    World world(scene);
    world.run(2.0);
    EXPECT_NEAR(world.pose(1).yMetres, 6.7, 0.01);
    EXPECT_NEAR(world.pose(1).xMetres, 5.0, 1.0e-3);
}

TEST(SceneWorld, RodKeepsItsLengthAndSpringSwings) {
    Scene scene = sceneOf(10.0, {body("hook", BoxShape{0.2, 0.2}, {5.0, 8.0}, BodyType::staticBody),
                                 body("bob", CircleShape{0.2}, {6.0, 8.0}),
                                 body("weight", CircleShape{0.2}, {5.0, 6.0})});
    scene.joints = {{"rod", "hook", "bob", DistanceJoint{{5.0, 8.0}, {6.0, 8.0}}},
                    {"spring", "hook", "weight", DistanceJoint{{5.0, 8.0}, {5.0, 6.0}, 1.0, 0.0}, true}};
    World world(scene);
    double lowest = 6.0;
    for (int i = 0; i < 100; ++i) {
        world.run(0.01);
        EXPECT_NEAR(std::hypot(world.pose(1).xMetres - 5.0, world.pose(1).yMetres - 8.0), 1.0, 0.01);
        lowest = std::min(lowest, world.pose(2).yMetres);
    }
    EXPECT_NEAR(lowest, 6.0 - 2.0 * 10.0 / std::pow(2.0 * std::numbers::pi, 2), 0.05); // twice g / omega^2
}

TEST(SceneWorld, WeldGluesTwoBodies) {
    Scene scene =
        sceneOf(0.0, {body("a", BoxShape{1.0, 1.0}, {2.0, 5.0}), body("b", BoxShape{1.0, 1.0}, {3.2, 5.0})});
    scene.joints = {{"seam", "a", "b", WeldJoint{{2.6, 5.0}}}};
    scene.script = {at(0.0, ImpulseAction{"a", {100.0, 0.0}, {}})};
    World world(scene);
    world.run(1.0);
    EXPECT_NEAR(world.pose(0).xMetres, 2.5, 0.01); // 100 N s on 200 kg
    EXPECT_NEAR(world.pose(1).xMetres - world.pose(0).xMetres, 1.2, 0.01);
}

TEST(SceneWorld, TiltTurnsTheScenesGravity) {
    Scene scene = sceneOf(10.0);
    scene.script = {at(0.1, TiltAction{1.5707963267948966}), at(0.2, GravityAction{{1.0, 2.0}}),
                    at(0.3, TiltAction{0.0})};
    World world(scene);
    const auto gravity = [&] { return world.inner.world().GetGravity(); };
    EXPECT_EQ(gravity(), b2Vec2(0.0F, -10.0F));
    world.run(0.11);
    EXPECT_NEAR(gravity().x, 10.0F, 1.0e-5);
    world.run(0.1);
    EXPECT_EQ(gravity(), b2Vec2(1.0F, 2.0F));
    world.run(0.1);
    EXPECT_EQ(gravity(), b2Vec2(0.0F, -10.0F));
}

TEST(SceneWorld, ImpulseChangesMomentumAndOffTheCentreSpin) {
    Scene scene = sceneOf(
        0.0, {body("ball", CircleShape{0.5}, {2.0, 2.0}), body("other", CircleShape{0.5}, {2.0, 6.0})});
    scene.script = {{0.0, 4, 0.1, ImpulseAction{"ball", {5.0, 0.0}, {}}},
                    at(0.0, ImpulseAction{"other", {10.0, 0.0}, Vector{0.0, 0.5}})};
    World world(scene);
    world.run(1.0);
    const b2Body& ball = *world.fixture(0).GetBody();
    const b2Body& other = *world.fixture(1).GetBody();
    EXPECT_NEAR(ball.GetLinearVelocity().x, 20.0 / mass(world, 0), 1.0e-5);
    EXPECT_EQ(ball.GetAngularVelocity(), 0.0F);
    EXPECT_NEAR(other.GetAngularVelocity(), -0.5 * 10.0 / other.GetInertia(), 1.0e-5);
}

TEST(SceneWorld, VelocityMovesKinematicBodiesAndStopsThem) {
    Scene scene = sceneOf(0.0, {body("lift", BoxShape{1.0, 0.2}, {5.0, 1.0}, BodyType::kinematicBody)});
    scene.script = {at(0.5, VelocityAction{"lift", {0.0, 2.0}, 0.0}),
                    at(1.5, VelocityAction{"lift", {0.0, 0.0}, 0.0})};
    World world(scene);
    world.run(3.0);
    EXPECT_NEAR(world.pose(0).yMetres, 3.0, 1.0e-4);
}

Scene spawningScene() {
    Scene scene = sceneOf(0.0, {body("first", CircleShape{0.2}, {1.0, 1.0})});
    scene.script = {{0.5, 3, 0.2, SpawnAction{body("stone", BoxShape{0.4, 0.4}, {3.0, 3.0}), {1.0, 0.5}}},
                    at(2.0, RemoveAction{"stone 2"}),
                    at(0.1, SpawnAction{body("last", CircleShape{1.0}, {8.0, 8.0}), {}})};
    return scene;
}

TEST(SceneWorld, SpawnedBodiesComeOneAfterTheOther) {
    World world(spawningScene());
    EXPECT_TRUE(world.pose(0).isPresent);
    for (const std::size_t i : {1U, 2U, 3U, 4U}) EXPECT_FALSE(world.pose(i).isPresent);
    world.run(0.8);
    EXPECT_TRUE(world.pose(1).isPresent && world.pose(2).isPresent && world.pose(4).isPresent);
    EXPECT_FALSE(world.pose(3).isPresent);
    world.run(0.2);
    EXPECT_NEAR(world.pose(3).xMetres, 5.0, 1.0e-6);
    EXPECT_NEAR(world.pose(3).yMetres, 4.0, 1.0e-6);
    world.run(1.2);
    EXPECT_FALSE(world.pose(2).isPresent);
    EXPECT_TRUE(world.pose(3).isPresent);
}

TEST(SceneWorld, FixtureNumbersFollowTheCast) {
    Scene scene = spawningScene();
    scene.bodies[0].fixtures.push_back(scene.bodies[0].fixtures[0]);
    const auto cast = allBodies(scene);
    std::vector<std::string> names;
    for (const BodyDescription& one : cast) names.push_back(one.name);
    EXPECT_EQ(names, (std::vector<std::string>{"first", "stone 1", "stone 2", "stone 3", "last"}));
    const World world(scene);
    EXPECT_EQ(world.fixtureCount(), 6U);
    for (const auto& [fixture, index] : {std::pair{0, 0U}, {1, 0U}, {2, 1U}, {4, 3U}, {5, 4U}}) {
        EXPECT_EQ(bodyOfFixture(cast, fixture), index);
        EXPECT_EQ(world.now(static_cast<std::size_t>(fixture)).body.name, cast[index].name);
    }
    EXPECT_EQ(bodyOfFixture(cast, 6), cast.size());
    EXPECT_EQ(bodyOfFixture(cast, -1), cast.size());
}

TEST(SceneWorld, ABodyThatIsSpawnedAgainStartsAnew) {
    Scene scene = sceneOf(0.0);
    BodyDescription stone = body("stone", CircleShape{0.2}, {1.0, 5.0});
    stone.velocityMetresPerSecond = {2.0, 0.0};
    scene.script = {at(0.0, SpawnAction{stone, {}}), at(0.5, MaterialAction{"stone", everyFixture, 1}),
                    at(0.6, CameraAction{"stone", 0, true})};
    scene.scriptPeriodSeconds = 1.0;
    World world(scene);
    world.run(0.9);
    EXPECT_NEAR(world.pose(0).xMetres, 2.8, 0.01);
    EXPECT_TRUE(world.now(0).description.isCamera);
    EXPECT_EQ(world.now(0).description.material, 1);
    world.run(0.2);
    EXPECT_NEAR(world.pose(0).xMetres, 1.2, 0.01);
    EXPECT_FALSE(world.now(0).description.isCamera);
    EXPECT_EQ(world.now(0).description.material, 0);
    EXPECT_NEAR(mass(world, 0), 100.0 * std::numbers::pi * 0.04, 1.0e-4);
}

TEST(SceneWorld, ABodyThatIsSpawnedAgainTouchesAnew) {
    Scene scene = sceneOf(0.0, {body("floor", BoxShape{4.0, 1.0}, {5.0, 0.5}, BodyType::staticBody)});
    scene.script = {at(0.0, SpawnAction{body("stone", CircleShape{0.2}, {5.0, 1.19}), {}})};
    scene.scriptPeriodSeconds = 1.0;
    World world(scene);
    world.run(1.0);
    EXPECT_NE(world.fixture(1).GetBody()->GetContactList(), nullptr);
    world.inner.executeActions(100);
    EXPECT_EQ(world.fixture(1).GetBody()->GetContactList(), nullptr);
}

TEST(SceneWorld, RemovedBodiesCarryNothingAndWakeWhatLay) {
    Scene scene = sceneOf(10.0, {body("shelf", BoxShape{2.0, 0.2}, {5.0, 5.0}, BodyType::staticBody),
                                 body("ball", CircleShape{0.2}, {5.0, 5.4})});
    scene.script = {at(3.0, RemoveAction{"shelf"}), at(3.1, ImpulseAction{"shelf", {1.0, 0.0}, {}}),
                    at(3.1, VelocityAction{"shelf", {1.0, 0.0}, 0.0})};
    World world(scene);
    world.run(3.0);
    EXPECT_NEAR(world.pose(1).yMetres, 5.3, 0.01);
    world.run(1.0);
    EXPECT_LT(world.pose(1).yMetres, 1.0);
}

TEST(SceneWorld, OnlyWhatIsThereHasABodyInBox2D) {
    Scene scene = sceneOf(0.0);
    scene.script = {at(0.0, SpawnAction{body("scripted", CircleShape{0.2}, {5.0, 5.0}), {}}),
                    at(0.1, RemoveAction{"scripted"})};
    World world(scene);
    for (int i = 0; i < 1000; ++i) {
        const std::string name = "note " + std::to_string(i);
        world.inner.addInput(world.step,
                             SpawnAction{body(name, CircleShape{0.2}, {1.0 + 0.1 * (i % 10), 5.0}), {}});
        world.inner.addInput(world.step + 10, RemoveAction{name});
        world.run(0.1);
        world.inner.dropExecutedInputs();
    }
    world.run(1.0);
    EXPECT_EQ(world.inner.world().GetBodyCount(), 1) << "the script's, which it may want again";
    EXPECT_EQ(world.fixtureCount(), 1U);
    EXPECT_EQ(world.inner.bodyCount(), 1001U) << "numbers are never used twice";
    EXPECT_FALSE(world.pose(500).isPresent);
    EXPECT_LT(world.inner.scene().inputs.size(), 3U);
    world.inner.addInput(world.step, SpawnAction{body("note 0", CircleShape{0.2}, {1.0, 5.0}), {}});
    world.run(0.1);
    EXPECT_TRUE(world.pose(1001).isPresent);
    EXPECT_EQ(world.now(1001).body.name, "note 0");
}

TEST(SceneWorld, MaterialChangesSurfaceAndMass) {
    Scene scene = sceneOf(
        0.0, {body("ball", CircleShape{0.5}, {5.0, 5.0}), body("printed", CircleShape{0.5}, {8.0, 5.0})});
    scene.bodies[1].massKg = 3.0;
    scene.script = {at(0.1, MaterialAction{"ball", 0, 1}),
                    at(0.1, MaterialAction{"printed", everyFixture, 1})};
    World world(scene);
    world.run(0.2);
    EXPECT_FLOAT_EQ(world.fixture(0).GetFriction(), 0.3F);
    EXPECT_FLOAT_EQ(world.fixture(0).GetRestitution(), 0.9F);
    EXPECT_NEAR(mass(world, 0), 400.0 * std::numbers::pi * 0.25, 1.0e-3);
    EXPECT_FLOAT_EQ(static_cast<float>(mass(world, 1)), 3.0F);
}

TEST(SceneWorld, AHeldDeviceIsTurnedAndHeavierOnTopOfTheScript) {
    Scene scene = sceneOf(10.0);
    scene.script = {at(0.1, HoldAction{2.0, 1.5707963267948966}), at(0.2, GravityAction{{1.0, 2.0}}),
                    at(0.3, TiltAction{1.5707963267948966}), at(0.4, HoldAction{1.0, 0.0})};
    World world(scene);
    const auto expectGravity = [&](float x, float y) {
        EXPECT_NEAR(world.inner.world().GetGravity().x, x, 1.0e-5);
        EXPECT_NEAR(world.inner.world().GetGravity().y, y, 1.0e-5);
    };
    world.run(0.11);
    expectGravity(20.0F, 0.0F);
    world.run(0.1);
    expectGravity(-4.0F, 2.0F);
    world.run(0.1);
    expectGravity(0.0F, 20.0F);
    world.run(0.1);
    expectGravity(10.0F, 0.0F);
}

TEST(SceneWorld, TellsWhenFixturesMayHaveChanged) {
    Scene scene = spawningScene();
    scene.script = {at(0.1, TiltAction{1.0}), at(0.2, CameraAction{"first", 0, true}),
                    at(0.3, MaterialAction{"first", 0, 1}), scene.script[0], at(0.6, RemoveAction{"first"})};
    World world(scene);
    std::vector<int> changes;
    for (int step = 0; step < 100; ++step)
        if (world.inner.executeActions(step)) changes.push_back(step);
    EXPECT_EQ(changes, (std::vector{20, 30, 50, 70, 90}));
}

TEST(SceneWorld, SeedsMoveSpawnedBodiesToo) {
    const auto placeOf = [](std::uint32_t seed) {
        World world(spawningScene(), seed);
        world.run(0.6);
        return world.pose(1).xMetres;
    };
    EXPECT_EQ(placeOf(0), 3.0);
    EXPECT_NE(placeOf(5), 3.0);
    EXPECT_NEAR(placeOf(5), 3.0, 2.1e-3); // 1 mm, and 1 mm/s for a moment
    EXPECT_EQ(placeOf(5), placeOf(5));
}

TEST(SceneWorld, BodiesInOnePlaceHaveNoMoreContactsThanAStepCanBear) {
    Scene scene = sceneOf(0.0);
    // 54,285 pairs
    for (int i = 0; i < 330; ++i)
        scene.bodies.push_back(body("ball " + std::to_string(i), CircleShape{0.2}, {5.0, 5.0}));
    World world(scene);
    world.run(0.01);
    EXPECT_EQ(world.inner.world().GetContactCount(), sceneLimits::maxContacts);
    EXPECT_GE(world.inner.refusedContacts(), 4285u);
}

} // namespace physvib::scene_world_test
