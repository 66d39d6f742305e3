// SPDX-License-Identifier: MIT
// Every fault of a scene is named with its place.
#include "Scene/SceneValidation.h"
#include "DropScene.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneLimits.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace physvib::scene_validation_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The drop scene with a bit of everything: a chain, a polygon, joints, a script.
Scene richScene() {
    Scene scene = dropScene(1.0);
    const auto sounding = [](Shape shape) -> FixtureDescription { return {std::move(shape), {}, 0.0, 1}; };
    scene.bodies.push_back(
        {"ground", BodyType::staticBody, {sounding(ChainShape{{{4.0, 0.0}, {2.0, 0.1}, {0.0, 0.0}}})}});
    scene.bodies.push_back({"wedge",
                            BodyType::dynamicBody,
                            {sounding(PolygonShape{{{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}}})},
                            {3.0, 2.0}});
    scene.joints = {{"hinge", "ball", "wedge", RevoluteJoint{{2.5, 2.0}}},
                    {"rod", "plate", "wedge", DistanceJoint{{2.0, 0.3}, {3.0, 2.0}}}};
    const BodyDescription stone{"stone", BodyType::dynamicBody, {sounding(CircleShape{0.1})}, {1.0, 3.0}};
    scene.script = {{0.0, 1, 0.0, TiltAction{0.1}},
                    {1.0, 3, 0.5, SpawnAction{stone, {0.3, 0.0}}},
                    {2.0, 1, 0.0, ImpulseAction{"ball", {1.0, 0.0}, {}}},
                    {3.0, 1, 0.0, MotorAction{"hinge", 3.0, 5.0}},
                    {4.0, 1, 0.0, CameraAction{"stone 2", everyFixture, true}},
                    {5.0, 1, 0.0, MaterialAction{"plate", 0, 1}},
                    {6.0, 1, 0.0, RemoveAction{"stone 3"}},
                    {7.0, 1, 0.0, VelocityAction{"wedge", {1.0, 0.0}, 0.0}}};
    return scene;
}

template <class T>
T& action(Scene& scene, std::size_t input) {
    return std::get<T>(scene.script[input].action);
}
Shape& shape(Scene& scene, std::size_t body) { return scene.bodies[body].fixtures[0].shape; }
auto shaped(std::size_t body, Shape as) {
    return [=](Scene& scene) { shape(scene, body) = as; };
}

TEST(SceneValidation, AcceptsGoodScenes) {
    EXPECT_EQ(validate(dropScene(1.0)), "");
    EXPECT_EQ(validate(shakenScene()), "");
    EXPECT_EQ(validate(richScene()), "");
}

void refuses(const std::function<void(Scene&)>& make, const std::string& expected) {
    Scene scene = richScene();
    make(scene);
    EXPECT_TRUE(validate(scene).starts_with(expected)) << validate(scene) << "\nand not " << expected;
}

TEST(SceneValidation, RangesAreNamed) {
    refuses([](Scene& s) { s.name.clear(); }, "name: expected text");
    refuses([](Scene& s) { s.fieldWidthMetres = 0.0; }, "field_m[0]: expected 0.01 to 1000, found 0");
    refuses([](Scene& s) { s.fieldHeightMetres = nan; }, "field_m[1]: expected");
    refuses([](Scene& s) { s.driveGain = -1.0; }, "drive_gain: expected");
    refuses([](Scene& s) { s.gravityMetresPerSecond2.y = nan; }, "gravity_m_per_s2[1]: expected");
    refuses([](Scene& s) { s.normalisation.handMassKg = -1.0; }, "normalisation.hand_mass_kg: expected");
    refuses([](Scene& s) { s.materials[1].densityKgPerSquareMetre = 0.0; },
            "materials[1].density_kg_per_m2: expected");
    refuses([](Scene& s) { s.materials[0].friction = -0.1; }, "materials[0].friction: expected");
    refuses([](Scene& s) { s.materials[0].restitution = 1.1; },
            "materials[0].restitution: expected 0 to 1, found 1.1");
    refuses([](Scene& s) { s.materials[0].frequencyHz = 1.0e6; }, "materials[0].frequency_hz");
    refuses([](Scene& s) { s.materials[0].decayPerSecond = -1.0; }, "materials[0].decay_per_s");
    refuses([](Scene& s) { s.bodies[1].fixtures[0].material = 2; },
            "bodies[1].fixtures[0].material: expected one of the 2");
    refuses([](Scene& s) { s.bodies[1].fixtures[0].material = -1; },
            "bodies[1].fixtures[0].material: expected");
    refuses(shaped(1, CircleShape{0.0}), "bodies[1].fixtures[0].radius_m: expected");
    refuses(shaped(0, BoxShape{-1.0, 1.0}), "bodies[0].fixtures[0].size_m[0]: expected");
    refuses(shaped(0, BoxShape{1.0, nan}), "bodies[0].fixtures[0].size_m[1]: expected");
    refuses([](Scene& s) { s.bodies[0].fixtures.clear(); },
            "bodies[0].fixtures: expected 1 to 64 items, found 0");
    refuses([](Scene& s) { s.bodies[0].positionMetres.y = 1.0e9; }, "bodies[0].position_m[1]: expected");
    refuses([](Scene& s) { s.bodies[0].angleRadians = nan; }, "bodies[0].angle_rad: expected");
    refuses([](Scene& s) { s.bodies[1].massKg = -1.0; }, "bodies[1].mass_kg: expected");
    refuses(
        [](Scene& s) {
            std::get<RevoluteJoint>(s.joints[0].joint).limitsRadians = {1.0, -1.0};
        },
        "joints[0].limits_rad: expected [lower, upper]");
    refuses([](Scene& s) { std::get<RevoluteJoint>(s.joints[0].joint).maxTorqueNewtonMetres = -1.0; },
            "joints[0].max_torque_nm: expected");
    refuses([](Scene& s) { s.scriptPeriodSeconds = -1.0; }, "script_period_s: expected");
    refuses([](Scene& s) { s.script[0].timeSeconds = nan; }, "script[0].time_s: expected");
    refuses([](Scene& s) { s.script[1].times = 0; }, "script[1].times: expected 1 to");
    refuses([](Scene& s) { action<SpawnAction>(s, 1).body.fixtures[0].shape = CircleShape{-1.0}; },
            "script[1].body.fixtures[0].radius_m: expected");
    refuses([](Scene& s) { action<SpawnAction>(s, 1).body.fixtures.clear(); },
            "script[1].body.fixtures: expected 1 to");
    refuses([](Scene& s) { action<ImpulseAction>(s, 2).impulseNewtonSeconds.x = nan; },
            "script[2].impulse_ns[0]: expected");
}

TEST(SceneValidation, OutlinesAreNamed) {
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {0.0, 0.5}, {0.5, 0.0}}}),
            "bodies[3].fixtures[0].vertices_m: expected a convex outline"); // clockwise
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {1.0, 0.0}, {0.1, 0.1}, {0.0, 1.0}}}),
            "bodies[3].fixtures[0].vertices_m: expected a convex outline"); // dented
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}),
            "bodies[3].fixtures[0].vertices_m: expected a convex outline"); // twice around
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.001}}}),
            "bodies[3].fixtures[0].vertices_m: expected an outline at least");
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.005}, {0.0, 1.0}}}),
            "bodies[3].fixtures[0].vertices_m: expected edges");
    refuses(shaped(3, PolygonShape{{{0.0, 0.0}, {1.0, 0.0}}}),
            "bodies[3].fixtures[0].vertices_m: expected 3 to 8 items, found 2");
    refuses(shaped(3, PolygonShape{{{0.0, nan}, {1.0, 0.0}, {0.0, 1.0}}}),
            "bodies[3].fixtures[0].vertices_m[0][1]: expected");
    refuses(shaped(2, ChainShape{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}}),
            "bodies[2].fixtures[0].vertices_m: expected edges");
    refuses(shaped(2, ChainShape{{{0.0, 0.0}, {1.0, 0.0}}, true}),
            "bodies[2].fixtures[0].vertices_m: expected at least 3");
    refuses(shaped(2, ChainShape{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}}, true}),
            "bodies[2].fixtures[0].vertices_m: expected edges");
    refuses([](Scene& s) { s.bodies[2].type = BodyType::dynamicBody; },
            "bodies[2].fixtures[0].shape: a chain has no mass");
    refuses(
        [](Scene& s) {
            s.bodies[1].fixtures[0].offsetMetres = {50.0, 0.0};
        },
        "bodies[1].fixtures: expected a centre of mass nearer");
}

TEST(SceneValidation, ReferencesAreNamed) {
    refuses([](Scene& s) { s.materials[1].name = "concrete"; },
            "materials[1].name: expected a name of its own, found \"concrete\" again");
    refuses([](Scene& s) { s.materials[0].name = "m39559", s.materials[1].name = "m354015"; },
            "materials[1].name: expected another name: \"m354015\" and \"m39559\" have the same number by "
            "chance");
    refuses([](Scene& s) { s.bodies[1].name = "plate"; }, "bodies[1].name: expected a name of its own");
    refuses([](Scene& s) { s.bodies[1].name = "stone 2"; },
            "bodies: expected names of their own, found \"stone 2\" twice");
    refuses([](Scene& s) { s.joints[1].name = "hinge"; }, "joints[1].name: expected a name of its own");
    refuses([](Scene& s) { s.joints[0].bodyA = "bal"; },
            "joints[0].body_a: expected the name of a body, found \"bal\"");
    refuses([](Scene& s) { s.joints[0].bodyB = "stone"; }, "joints[0].body_b: expected the name of a body");
    refuses([](Scene& s) { s.joints[0].bodyB = "ball"; }, "joints[0].body_b: expected another body");
    refuses(
        [](Scene& s) {
            s.joints[0].joint = WheelJoint{{}, {0.0, 0.0}};
        },
        "joints[0].axis: expected a direction");
    refuses([](Scene& s) { action<ImpulseAction>(s, 2).body = "x"; },
            "script[2].body: expected the name of a body, found \"x\"");
    refuses([](Scene& s) { action<RemoveAction>(s, 6).body = "stone"; },
            "script[6].body: expected the name of a body");
    refuses([](Scene& s) { action<MotorAction>(s, 3).joint = "rod"; },
            "script[3].joint: expected the name of a revolute or wheel joint");
    refuses([](Scene& s) { action<MotorAction>(s, 3).joint = "x"; },
            "script[3].joint: expected the name of a revolute or wheel joint");
    refuses([](Scene& s) { action<MaterialAction>(s, 5).fixture = 1; },
            "script[5].fixture: expected 0 to 0, found 1");
    refuses([](Scene& s) { s.scriptPeriodSeconds = 6.5; }, "script[7].time_s: expected 0 to 6.5, found 7");
    refuses([](Scene& s) { s.script[1].everySeconds = 4.0, s.scriptPeriodSeconds = 8.0; },
            "script[1].time_s: expected 0 to 8, found 9");
}

TEST(SceneValidation, WhatHapticSourcesNeedIsNamed) {
    refuses([](Scene& s) { s.bodies[2].fixtures[0].isCamera = true; }, "bodies[2].mass_kg: expected");
    refuses([](Scene& s) { s.materials[0].frequencyHz = 0.0; }, "bodies[0].fixtures[0].material: a camera");
    refuses([](Scene& s) { s.materials[0].decayPerSecond = 0.0; },
            "bodies[0].fixtures[0].material: a camera");
    refuses([](Scene& s) { s.materials[1].frequencyHz = 0.0, s.script.erase(s.script.begin() + 4); },
            "bodies[0].fixtures[0].material: a camera");
    refuses([](Scene& s) { s.materials[1].frequencyHz = 0.0, s.script.erase(s.script.begin() + 5); },
            "script[1].body.fixtures[0].material: a camera");
    refuses([](Scene& s) { s.materials[1].frequencyHz = 0.0, s.bodies[0].fixtures[0].voice = Voice::other; },
            "materials[1]: expected frequency_hz and decay_per_s, for bodies[0]");
}

TEST(SceneValidation, TotalsAreNamed) {
    refuses([](Scene& s) { s.bodies.resize(1'000'000, s.bodies[1]); },
            "bodies: expected 0 to 4096 items, found 1000000");
    refuses([](Scene& s) { s.script[1].times = 100'000, s.script[1].everySeconds = 0.0; },
            "bodies: expected at most 4096 in all, found 100004");
    refuses([](Scene& s) { s.script[0].times = 1'000'000; },
            "script[0].times: expected 1 to 100000, found 1e+06");
    refuses([](Scene& s) { s.script[0].times = 100'000; },
            "script actions: expected at most 100000 in all, found 100009");
    refuses(
        [](Scene& s) {
            auto& fixtures = action<SpawnAction>(s, 1).body.fixtures;
            fixtures.resize(64, FixtureDescription{fixtures[0]});
            s.script[1].times = 200;
            s.script[1].everySeconds = 0.0;
        },
        "fixtures: expected at most 8192 in all, found 12804");
    refuses([](Scene& s) { std::get<ChainShape>(shape(s, 2)).verticesMetres.resize(1025); },
            "bodies[2].fixtures[0].vertices_m: expected 2 to 1024 items, found 1025");
}

// Beside the two bodies of the scene, with a fixture each. A loop has as many edges as vertices.
TEST(SceneValidation, TotalsCountBodiesOfTheSceneOfARepeatedScriptAndLiveOnesAlike) {
    using namespace sceneLimits;
    ChainShape loop{{}, true};
    for (std::size_t i = 0; i < maxChainVertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / maxChainVertices;
        loop.verticesMetres.push_back({10.0 * std::cos(angle), 10.0 * std::sin(angle)});
    }
    struct Limit {
        std::string what;
        std::size_t fixtures; // of each body
        Shape shape;
        std::size_t most; // bodies
    };
    for (const Limit& limit : {Limit{"bodies", 1, CircleShape{0.1}, maxBodies - 2},
                               Limit{"fixtures", 10, CircleShape{0.1}, (maxFixtures - 2) / 10},
                               Limit{"chain edges", 1, loop, maxChainEdges / maxChainVertices}}) {
        BodyDescription body{"x", BodyType::staticBody};
        body.fixtures.assign(limit.fixtures, FixtureDescription{limit.shape});
        Scene own = dropScene(1.0), scripted = own, live = own;
        scripted.script = {{0.0, 0, 0.0, SpawnAction{body, {}}}};
        for (std::size_t count = 1; count <= limit.most + 1; ++count) {
            body.name = "x" + std::to_string(count);
            own.bodies.push_back(body);
            ++scripted.script[0].times;
            live.inputs.push_back({0.0, SpawnAction{body, {}}});
            if (count < limit.most) continue;
            for (const Scene* scene : {&own, &scripted, &live}) {
                const std::string said = validate(*scene);
                EXPECT_EQ(said.substr(0, said.find(':')), count > limit.most ? limit.what : "") << said;
            }
        }
    }
}

TEST(SceneValidation, MaterialsAloneAreCheckedToo) {
    Scene scene = dropScene(1.0);
    EXPECT_EQ(validateMaterials(scene.materials), "");
    scene.materials[1].friction = -1.0;
    EXPECT_EQ(validateMaterials(scene.materials), "materials[1].friction: expected 0 to 100, found -1");
}

TEST(SceneWarnings, TellMovingBodiesOutsideBox2dsRange) {
    Scene scene = richScene();
    EXPECT_TRUE(sceneWarnings(scene).empty());
    shape(scene, 0) = BoxShape{90.0, 0.02}; // static: no matter
    shape(scene, 1) = CircleShape{0.04};
    shape(scene, 3) = PolygonShape{{{0.0, 0.0}, {12.0, 0.0}, {0.0, 5.0}}};
    const auto warnings = sceneWarnings(scene);
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0], "bodies[1].fixtures[0]: expected 0.1 to 10, found 0.08 m: Box2D simulates such "
                           "moving bodies less well");
    EXPECT_EQ(warnings[1].substr(0, 51), "bodies[3].fixtures[0]: expected 0.1 to 10, found 13");
}

} // namespace physvib::scene_validation_test
