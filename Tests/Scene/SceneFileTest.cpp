// SPDX-License-Identifier: MIT
// Scenes survive writing and reading to the byte, and a bad one is named by its field.
#include "Scene/SceneFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/Simulation.h"
#include "Support/FileTesting.h"
#include "TestPlaces.h"
#include <algorithm>

namespace physvib::scene_file_test {

/// One of everything that the format has.
const std::string full = R"({
  "physvib_scene": 2,
  "name": "full",
  "description": "one of \"everything\" ä",
  "field_m": [8, 4.5],
  "gravity_m_per_s2": [0, -9.8],
  "drive_gain": 2.5,
  "normalisation": { "a_star_s_per_m": 0.125, "hand_mass_kg": 60 },
  "materials": [
    { "name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 349, "decay_per_s": 107 },
    { "name": "felt", "density_kg_per_m2": 50, "friction": 1, "restitution": 0, "frequency_hz": 60, "decay_per_s": 200 }
  ],
  "bodies": [
    {
      "name": "ground",
      "type": "static",
      "position_m": [0, 0],
      "mass_kg": 100,
      "fixtures": [
        { "shape": "chain", "vertices_m": [[8, 0], [4, 0.2], [0, 0]], "material": "wood", "camera": true, "voice": "both" },
        { "shape": "chain", "vertices_m": [[0, 0], [1, 2], [2, 0]], "loop": true, "material": "felt" }
      ]
    },
    {
      "name": "car",
      "position_m": [2, 1],
      "angle_rad": 0.1,
      "velocity_m_per_s": [1, 0],
      "spin_rad_per_s": -0.5,
      "linear_damping_per_s": 0.1,
      "angular_damping_per_s": 0.2,
      "mass_kg": 25,
      "fixtures": [
        { "shape": "box", "size_m": [1.2, 0.3], "material": "wood", "camera": true, "voice": "other", "part": "left knee" },
        { "shape": "polygon", "vertices_m": [[0, 0], [0.4, 0], [0.2, 0.3]], "offset_m": [0.1, 0.15], "angle_rad": 0.2, "material": "felt" }
      ]
    },
    { "name": "wheel", "position_m": [1.6, 0.8], "fixtures": [{ "shape": "circle", "radius_m": 0.2, "material": "felt" }] },
    {
      "name": "lift",
      "type": "kinematic",
      "position_m": [6, 1],
      "mass_kg": 5,
      "fixtures": [{ "shape": "box", "size_m": [1, 0.2], "material": "wood" }]
    }
  ],
  "joints": [
    {
      "name": "axle",
      "body_a": "car",
      "body_b": "wheel",
      "type": "wheel",
      "anchor_m": [1.6, 0.8],
      "axis": [0.6, 0.8],
      "suspension_hz": 4,
      "damping_ratio": 0.7,
      "travel_m": [-0.1, 0.2],
      "motor_rad_per_s": -8,
      "max_torque_nm": 30,
      "rest_m": -0.05
    },
    {
      "name": "hinge",
      "body_a": "ground",
      "body_b": "car",
      "type": "revolute",
      "anchor_m": [2, 1],
      "limits_rad": [-1, 1],
      "motor_rad_per_s": 1,
      "max_torque_nm": 2,
      "collide": true
    },
    {
      "name": "rod",
      "body_a": "car",
      "body_b": "wheel",
      "type": "distance",
      "anchor_a_m": [2, 1],
      "anchor_b_m": [1.6, 0.8],
      "spring_hz": 3,
      "damping_ratio": 0.5,
      "rest_m": 0.25
    },
    {
      "name": "glue",
      "body_a": "car",
      "body_b": "lift",
      "type": "weld",
      "anchor_m": [3, 1],
      "spring_hz": 2,
      "damping_ratio": 0.1,
      "rest_rad": 0.2
    }
  ],
  "script": [
    { "time_s": 0, "input": "gravity", "gravity_m_per_s2": [1, -9] },
    { "time_s": 0.5, "input": "tilt", "angle_rad": 0.3 },
    { "time_s": 1, "times": 3, "every_s": 0.25, "input": "impulse", "body": "car", "impulse_ns": [10, 0], "point_m": [0.1, 0] },
    { "time_s": 1.5, "input": "velocity", "body": "lift", "velocity_m_per_s": [0, 0.5], "spin_rad_per_s": 1 },
    {
      "time_s": 2,
      "times": 2,
      "every_s": 0.5,
      "input": "spawn",
      "body": { "name": "stone", "position_m": [3, 4], "fixtures": [{ "shape": "circle", "radius_m": 0.1, "material": "wood" }] },
      "shift_m": [0.5, 0]
    },
    { "time_s": 3, "input": "remove", "body": "stone 1" },
    { "time_s": 3.5, "input": "motor", "joint": "axle", "motor_rad_per_s": 8, "max_torque_nm": 40 },
    { "time_s": 4, "input": "camera", "body": "car", "fixture": 1, "on": true },
    { "time_s": 4.5, "input": "material", "body": "car", "fixture": 0, "material": "felt" }
  ],
  "script_period_s": 10,
  "inputs": [
    { "time_s": 12.25, "input": "sound", "material": "felt", "frequency_hz": 70, "decay_per_s": 150 },
    {
      "time_s": 12.25,
      "input": "spawn",
      "body": { "name": "coin", "position_m": [3, 4], "fixtures": [{ "shape": "circle", "radius_m": 0.1, "material": "wood" }] }
    },
    { "time_s": 13, "input": "impulse", "body": "coin", "impulse_ns": [1, 2] },
    {
      "time_s": 13.5,
      "input": "texture",
      "material": "felt",
      "grain_m": 0.003,
      "roughness": 2,
      "grain_pattern": "regular",
      "rolling": 0.5
    },
    { "time_s": 14, "input": "grip", "body": "coin", "to_m": [3, 2], "point_m": [0, 0.05], "over_s": 0.5 },
    { "time_s": 15, "input": "grip", "body": "coin" }
  ]
}
)";

const std::string small = R"({ "physvib_scene": 1, "name": "small", "field_m": [4, 2],
  "materials": [{ "name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6 }],
  "bodies": [{ "name": "ball", "position_m": [2, 1], "fixtures": [{ "shape": "circle", "radius_m": 0.2, "material": "wood" }] }]
})";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

Scene readGood(const std::string& text, const SceneSettings& settings = {}) {
    Result<Scene> read = readScene(text, "my.json", settings);
    EXPECT_EQ(read.error, "");
    return std::move(read.value);
}

std::string errorOf(const std::string& text, const SceneSettings& settings = {}) {
    const Result<Scene> read = readScene(text, "my.json", settings);
    EXPECT_FALSE(read);
    EXPECT_TRUE(read.value == Scene{});
    EXPECT_TRUE(
        std::ranges::none_of(read.error, [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
    return read.error;
}

TEST(SceneFile, ReadsEveryField) {
    const Scene scene = readGood(full);
    EXPECT_EQ(scene.fieldHeightMetres, 4.5);
    EXPECT_EQ(scene.normalisation.handMassKg, 60.0);
    EXPECT_EQ(scene.bodies[0].type, BodyType::staticBody);
    EXPECT_EQ(scene.bodies[0].fixtures[0].voice, Voice::both);
    EXPECT_TRUE(std::get<ChainShape>(scene.bodies[0].fixtures[1].shape).isLoop);
    EXPECT_EQ(scene.bodies[1].fixtures[0].part, "left knee");
    EXPECT_EQ(scene.bodies[1].fixtures[1].part, "");
    EXPECT_EQ(scene.bodies[1].fixtures[1].material, 1);
    EXPECT_EQ(std::get<PolygonShape>(scene.bodies[1].fixtures[1].shape).verticesMetres[2],
              (Vector{0.2, 0.3}));
    EXPECT_EQ(std::get<WheelJoint>(scene.joints[0].joint).travelMetres, (Interval{-0.1, 0.2}));
    EXPECT_EQ(std::get<WheelJoint>(scene.joints[0].joint).restMetres, -0.05);
    EXPECT_EQ(std::get<DistanceJoint>(scene.joints[2].joint).restMetres, 0.25);
    EXPECT_EQ(std::get<WeldJoint>(scene.joints[3].joint).restRadians, 0.2);
    EXPECT_EQ(scene.script[2].times, 3);
    EXPECT_EQ(std::get<SpawnAction>(scene.script[4].action).body.name, "stone");
    EXPECT_EQ(std::get<MotorAction>(scene.script[6].action).maxTorqueNewtonMetres, 40.0);
    EXPECT_EQ(std::get<MaterialAction>(scene.script[8].action).material, 1);
    EXPECT_EQ(scene.scriptPeriodSeconds, 10.0);
    EXPECT_EQ(scene.inputs[0], (LiveInput{12.25, SoundAction{1, 70.0, 150.0}}));
    EXPECT_EQ(std::get<SpawnAction>(scene.inputs[1].action).body.name, "coin");
    EXPECT_EQ(scene.inputs[3].action, (Action{TextureAction{1, 0.003, 2.0, GrainPattern::regular, 0.5}}));
    EXPECT_EQ(scene.inputs[4].action, (Action{GripAction{"coin", Vector{3.0, 2.0}, Vector{0.0, 0.05}, 0.5}}));
    EXPECT_EQ(scene.inputs[5].action, (Action{GripAction{"coin", {}, {}}}));
}

TEST(SceneFile, WhatIsReadIsWrittenTheSame) {
    EXPECT_EQ(sceneJson(readGood(full)), full);
    EXPECT_EQ(sceneJson(readGood(sceneJson(readGood(small)))), sceneJson(readGood(small)));
}

TEST(SceneFile, GrainsAreReadAndWrittenTheSame) {
    std::string rough = full;
    const std::string felt = "\"frequency_hz\": 60, \"decay_per_s\": 200";
    const auto at = rough.find(felt) + felt.size();
    rough.insert(
        at, ", \"grain_m\": 0.002, \"roughness\": 2.5, \"grain_pattern\": \"regular\", \"rolling\": 0.75");
    const Scene scene = readGood(rough);
    const Texture texture = scene.materials[1].texture();
    EXPECT_EQ(texture.grainMetres, 0.002);
    EXPECT_EQ(texture.roughness, 2.5);
    EXPECT_EQ(texture.pattern, GrainPattern::regular);
    EXPECT_EQ(texture.rolling, 0.75);
    EXPECT_EQ(readGood(sceneJson(scene)).materials, scene.materials);
    const auto faultWith = [&](const std::string& fields) {
        return errorOf(std::string{full}.insert(at, fields));
    };
    EXPECT_EQ(faultWith(", \"grain_m\": -1"), "my.json: materials[1].grain_m: expected 0 to 10, found -1");
    EXPECT_EQ(faultWith(", \"rolling\": 2"), "my.json: materials[1].rolling: expected 0 to 1, found 2");
    EXPECT_EQ(faultWith(", \"grain_pattern\": \"even\""),
              "my.json: materials[1].grain_pattern: expected one of random, regular, found \"even\"");
}

TEST(SceneFile, EveryBuiltInSceneSurvives) {
    for (const Scene& scene : builtInScenes()) {
        const std::string text = sceneJson(scene);
        Scene again = readGood(text);
        EXPECT_EQ(sceneJson(again), text);
        again.variables = scene.variables;
        EXPECT_TRUE(again == scene) << scene.name;
    }
}

TEST(SceneFile, NumbersSurviveToTheBit) {
    std::mt19937 random(30);
    Scene scene = readGood(full);
    for (int i = 0; i < 200; ++i) {
        const auto any = [&](double reach) {
            return (static_cast<double>(random()) / 2147483648.0 - 1.0) * reach;
        };
        scene.bodies[1].positionMetres = {any(1000.0), i % 2 == 0 ? -0.0 : any(1e-9)};
        scene.bodies[1].angleRadians = any(1000.0);
        scene.script[0].timeSeconds = std::abs(any(10.0));
        EXPECT_TRUE(readGood(sceneJson(scene)) == scene);
        EXPECT_EQ(std::signbit(readGood(sceneJson(scene)).bodies[1].positionMetres.y),
                  std::signbit(scene.bodies[1].positionMetres.y));
    }
}

TEST(SceneFile, LeftOutFieldsHaveDefaults) {
    const Scene scene = readGood(small);
    EXPECT_EQ(scene.driveGain, 1.0);
    EXPECT_EQ(scene.normalisation, Normalisation{});
    EXPECT_EQ(scene.bodies[0].type, BodyType::dynamicBody);
    EXPECT_FALSE(scene.bodies[0].fixtures[0].isCamera);
    EXPECT_EQ(
        readGood(replaced(small, "\"name\": \"small\"", "\"normalisation\": \"auto\", \"name\": \"small\""))
            .normalisation,
        Normalisation{});
}

TEST(SceneFile, NamesTheFieldByItsPath) {
    const std::vector<std::array<std::string, 3>> cases{
        {"\"radius_m\": 0.2", "\"radius_m\": \"0.2\"",
         "bodies[2].fixtures[0].radius_m: expected a number, found a string"},
        {"\"radius_m\": 0.2", "\"radius_m\": 0",
         "bodies[2].fixtures[0].radius_m: expected 0.01 to 100, found 0"},
        {"\"radius_m\": 0.2", "\"radius\": 0.2", "bodies[2].fixtures[0]: unknown field \"radius\""},
        {"\"radius_m\": 0.2, ", "", "bodies[2].fixtures[0]: field \"radius_m\" is missing"},
        {"\"size_m\": [1.2, 0.3]", "\"size_m\": [1.2]",
         "bodies[1].fixtures[0].size_m: expected 2 numbers, found 1 items"},
        {"\"shape\": \"circle\"", "\"shape\": \"ring\"",
         "bodies[2].fixtures[0].shape: expected one of circle, box, polygon, chain, found \"ring\""},
        {"\"voice\": \"both\"", "\"voice\": \"all\"",
         "bodies[0].fixtures[0].voice: expected one of own, other, both, found \"all\""},
        {"\"camera\": true", "\"camera\": 1",
         "bodies[0].fixtures[0].camera: expected true or false, found a number"},
        {"\"material\": \"felt\"", "\"material\": \"fell\"",
         "bodies[0].fixtures[1].material: expected the name of a material, found \"fell\""},
        {"\"type\": \"kinematic\"", "\"type\": \"moving\"",
         "bodies[3].type: expected one of static, kinematic, dynamic, found \"moving\""},
        {"\"body_a\": \"ground\"", "\"body_a\": \"grind\"",
         "joints[1].body_a: expected the name of a body, found \"grind\""},
        {"\"limits_rad\": [-1, 1]", "\"limits_rad\": [1, -1]",
         "joints[1].limits_rad: expected [lower, upper], found them the other way round"},
        {"\"times\": 3", "\"times\": 2.5", "script[2].times: expected a whole number, found 2.5"},
        {"\"times\": 3", "\"times\": 1000000", "script[2].times: expected 1 to 100000, found 1e+06"},
        {"\"input\": \"tilt\"", "\"input\": \"roll\"",
         "script[1].input: expected one of gravity, tilt, impulse, velocity, spawn, remove, motor, camera, "
         "material, sound, hold, texture, grip, change, join, unjoin, found \"roll\""},
        {"\"time_s\": 13", "\"time_s\": 12",
         "inputs[2].time_s: expected a time that is not before that of the input above"},
        {"\"body\": \"coin\"", "\"body\": \"coil\"",
         "inputs[2].body: expected the name of a body, found \"coil\""},
        {"\"name\": \"coin\"", "\"name\": \"car\"",
         "bodies: expected names of their own, found \"car\" twice"},
        {"\"frequency_hz\": 70", "\"frequency_hz\": 0",
         "inputs[0].frequency_hz: expected 1 to 20000, found 0"},
        {"\"name\": \"stone\"", "\"nam\": \"stone\"", "script[4].body: unknown field \"nam\""},
        {"\"hand_mass_kg\": 60", "\"hand_mass_kg\": \"auto\"",
         "normalisation.hand_mass_kg: expected a number, found a string"},
        {"\"drive_gain\": 2.5", "\"drive_gain\": 2.5, \"drive_gain\": 2",
         "field \"drive_gain\" appears twice"},
        {"\"field_m\": [8, 4.5]", "\"field_m\": 8", "field_m: expected an array, found a number"},
        {"\"script_period_s\": 10", "\"script_period_s\": 3", "script[6].time_s: expected 0 to 3, found 3.5"},
        {"\"mass_kg\": 100", "\"mass_kg\": 0", "bodies[0].mass_kg: expected above 0, as a line has none"},
    };
    for (const auto& [what, by, message] : cases)
        EXPECT_EQ(errorOf(replaced(full, what, by)), "my.json: " + message);
}

TEST(SceneFile, OnlyItsOwnVersionsAreRead) {
    EXPECT_EQ(errorOf(replaced(small, "\"physvib_scene\": 1", "\"physvib_scene\": 3")),
              "my.json: physvib_scene: made for a newer PhysVib: expected a version up to 2, found 3");
    EXPECT_EQ(errorOf(replaced(small, "\"physvib_scene\": 1", "\"physvib_scene\": 0")),
              "my.json: physvib_scene: expected a version from 1 on, found 0");
    EXPECT_EQ(errorOf(replaced(small, "\"physvib_scene\": 1, ", "")),
              "my.json: field \"physvib_scene\" is missing");
    EXPECT_EQ(errorOf("[]"), "my.json: expected an object, found an array");
}

TEST(SceneFile, AbsurdRequestsAreRefusedWithTheLimit) {
    std::string bodies;
    for (int i = 0; i < 5000; ++i) bodies += "0,";
    EXPECT_EQ(errorOf(replaced(small, "\"bodies\": [", "\"bodies\": [" + bodies)),
              "my.json: bodies: expected at most 4096 items, found 5001");
    EXPECT_EQ(errorOf(std::string(4'000'001, ' ')), "my.json: expected at most 4000000 bytes, found more");
    EXPECT_EQ(errorOf(replaced(full, "\"times\": 2,", "\"times\": 100000,")),
              "my.json: bodies: expected at most 4096 in all, found 100004");
}

const std::string variable = R"("variables": [
    { "name": "size", "default": "big", "choices": [
        { "value": "big", "set": {} },
        { "value": "tiny", "set": { "/bodies/0/fixtures/0/radius_m": 0.05, "/bodies/0/name": "grain" } } ] },
    { "name": "height", "default": "1", "choices": [
        { "value": "1", "set": { "/bodies/0/position_m/1": 1 } },
        { "value": "2", "set": { "/bodies/0/position_m/1": 2 } } ] } ], "name": "small")";
const std::string varied = replaced(small, "\"name\": \"small\"", variable);

double radiusOf(const Scene& scene) {
    return std::get<CircleShape>(scene.bodies[0].fixtures[0].shape).radiusMetres;
}

TEST(SceneVariables, HaveTheirDefaultsUnlessSet) {
    const Scene scene = readGood(varied);
    EXPECT_EQ(radiusOf(scene), 0.2);
    EXPECT_EQ(scene.variables,
              (std::vector<SceneVariable>{{"size", "big", {"big", "tiny"}}, {"height", "1", {"1", "2"}}}));
}

TEST(SceneVariables, ReplaceWhatTheChoiceSays) {
    const Scene scene = readGood(varied, {{"height", "2"}, {"size", "tiny"}});
    EXPECT_EQ(radiusOf(scene), 0.05);
    EXPECT_EQ(scene.bodies[0].name, "grain");
    EXPECT_EQ(scene.bodies[0].positionMetres.y, 2.0);
    EXPECT_EQ(scene.variables[0].value, "tiny");
    EXPECT_EQ(readGood(sceneJson(scene)).bodies, scene.bodies) << "written as they are set";
}

TEST(SceneVariables, UnknownOnesAndValuesAreNamed) {
    EXPECT_EQ(errorOf(varied, {{"colour", "red"}}),
              "my.json: no variable \"colour\", expected one of size, height");
    EXPECT_EQ(errorOf(varied, {{"size", "huge"}}),
              "my.json: variable \"size\": expected one of big, tiny, found \"huge\"");
    EXPECT_EQ(errorOf(small, {{"size", "huge"}}), "my.json: no variable \"size\", the scene has none");
}

TEST(SceneVariables, PointersLeadToValuesThatAreThere) {
    for (const std::string bad :
         {"/bodies/1/name", "/bodies/0/nam", "bodies", "", "/bodies/-", "/bodies/01", "/variables/0"})
        EXPECT_EQ(
            errorOf(replaced(varied, "/bodies/0/name", bad)),
            "my.json: variables[0].choices[1].set: expected a pointer to a value of the scene, found \"" +
                bad + "\"");
}

TEST(SceneVariables, FaultsNameTheirField) {
    const std::vector<std::array<std::string, 3>> cases{
        {"\"default\": \"big\"", "\"default\": \"huge\"",
         "variable \"size\": expected one of big, tiny, found \"huge\""},
        {"\"default\": \"big\"", "\"standard\": \"big\"", "variables[0]: unknown field \"standard\""},
        {"\"set\": {}", "\"set\": []", "variables[0].choices[0].set: expected an object, found an array"},
        {"\"value\": \"tiny\"", "\"value\": 3",
         "variables[0].choices[1].value: expected a string, found a number"},
        {"{ \"value\": \"big\", \"set\": {} }", "{ \"value\": \"big\" }",
         "variables[0].choices[0]: field \"set\" is missing"},
    };
    for (const auto& [what, by, message] : cases)
        EXPECT_EQ(errorOf(replaced(varied, what, by)), "my.json: " + message);
}

TEST(SceneFile, NoMutationCrashesOrHalfLoads) {
    std::mt19937 random(31);
    int accepted = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Result<Scene> read =
            readScene(mutated(full, "0123456789,.-eE{}[]\":\\un \n\xEF", random), "my.json");
        if (!read) {
            ASSERT_TRUE(read.value == Scene{});
            ASSERT_TRUE(read.error.starts_with("my.json: ")) << read.error;
            continue;
        }
        ++accepted;
        ASSERT_EQ(sceneJson(readGood(sceneJson(read.value))), sceneJson(read.value));
        Simulation simulation(read.value, 1, 100); // whatever is accepted can be simulated
        std::vector<CollisionEvent> events;
        for (int step = 0; step < 5; ++step) simulation.step(events);
    }
    EXPECT_GT(accepted, 100);
    EXPECT_LT(accepted, 9'000);
}

TEST(SceneFile, ACommaLocaleChangesNothing) {
    const CommaLocale comma;
    EXPECT_EQ(sceneJson(readGood(full)), full);
    EXPECT_EQ(errorOf(replaced(full, "\"drive_gain\": 2.5", "\"drive_gain\": -1234.5")),
              "my.json: drive_gain: expected 0 to 1e+06, found -1234.5");
    if (!comma.hasCLocale)
        GTEST_SKIP() << "no C locale with a decimal comma here; tried with C++ streams only";
}

using SceneFileOnDiskTest = FolderTest;

TEST_F(SceneFileOnDiskTest, LoadsWhatWasWrittenAndNamesTheFileInErrors) {
    const std::string path = (folder / "my.json").string();
    ASSERT_EQ(writeFile(path, full), "");
    EXPECT_TRUE(loadScene(path).value == readGood(full));
    EXPECT_TRUE(findScene(path).value == readGood(full));
    ASSERT_EQ(writeFile(path, "{}"), "");
    EXPECT_EQ(loadScene(path).error, path + ": field \"physvib_scene\" is missing");
    EXPECT_EQ(loadScene(folder / "none.json").error,
              (folder / "none.json").string() + ": cannot be read: No such file or directory");
    ASSERT_EQ(writeFile(path, std::string(limits::maxSceneFileBytes + 1, ' ')), "");
    EXPECT_EQ(loadScene(path).error, path + ": expected at most 4000000 bytes, found more");
}

TEST(SceneCatalogue, FindsScenesByName) {
    ASSERT_NE(findBuiltInScene("shake-the-box"), nullptr);
    EXPECT_EQ(findBuiltInScene("shake-the-box")->name, "shake-the-box");
    EXPECT_EQ(findBuiltInScene("shake"), nullptr);
    EXPECT_TRUE(findScene("shake-the-box").value == *findBuiltInScene("shake-the-box"));
    EXPECT_EQ(findScene("shake").error, "no scene \"shake\" (see physvib scenes)");
    EXPECT_EQ(findScene("shake-the-box", {{"a", "b"}}).error,
              "shake-the-box: no variable \"a\", the scene has none");
}

TEST(SceneCatalogue, EveryBuiltInSceneIsReadableWithEveryChoice) {
    for (const Scene& scene : builtInScenes())
        for (const SceneVariable& variable : scene.variables)
            for (const std::string& choice : variable.choices)
                EXPECT_EQ(findScene(scene.name, {{variable.name, choice}}).error, "");
}

TEST(SceneCatalogue, EmbeddedFilesAreTheFiles) {
    for (const Scene& scene : builtInScenes()) {
        const auto path =
            std::filesystem::path(PHYSVIB_SOURCE_DIR) / "Source/Scene/Scenes" / (scene.name + ".json");
        EXPECT_TRUE(loadScene(path).value == scene) << path;
    }
}

} // namespace physvib::scene_file_test
