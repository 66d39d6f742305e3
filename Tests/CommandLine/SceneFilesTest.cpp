// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render SCENE.json` and `--set`: anybody's world, and its variables.
#include "Calls.h"

namespace physvib {
namespace {

using SceneFiles = test::CommandLine;

/// A ball above a camera, with two variables.
const std::string drop =
    R"({ "physvib_scene": 1, "name": "my drop", "field_m": [4, 4], "gravity_m_per_s2": [0, -9.8],
  "materials": [{ "name": "concrete", "density_kg_per_m2": 1000, "friction": 0.5, "restitution": 0.5, "frequency_hz": 80, "decay_per_s": 34.13 }],
  "bodies": [
    { "name": "plate", "type": "static", "position_m": [2, 0.15], "mass_kg": 870, "fixtures": [{ "shape": "box", "size_m": [2.9, 0.3], "material": "concrete", "camera": true }] },
    { "name": "ball", "position_m": [2, 1.3], "fixtures": [{ "shape": "circle", "radius_m": 0.15, "material": "concrete" }] }],
  "variables": [
    { "name": "height", "default": "low", "choices": [{ "value": "low", "set": {} }, { "value": "high", "set": { "/bodies/1/position_m/1": 3 } }] },
    { "name": "size", "default": "big", "choices": [{ "value": "big", "set": {} }, { "value": "tiny", "set": { "/bodies/1/fixtures/0/radius_m": 0.02 } }] }]
})";

TEST_F(SceneFiles, AnybodysWorldIsRendered) {
    write("drop.json", drop);
    const auto outcome = call("render drop.json --seconds 2 --out a.wav --events a.csv --picture a.png");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(files().size(), 4u);
    EXPECT_NE(read("a.csv").find("scene=my drop seed=1 steps_per_second=100 height=low size=big"),
              std::string::npos);
    EXPECT_NE(read("a.csv").find(",80,34.13,"), std::string::npos);
}

TEST_F(SceneFiles, SetChangesTheScene) {
    write("drop.json", drop);
    ASSERT_EQ(call("render drop.json --seconds 2 --events low.csv").exitCode, 0);
    ASSERT_EQ(call("render drop.json --seconds 2 --events again.csv --set height=low").exitCode, 0);
    ASSERT_EQ(call("render drop.json --seconds 2 --events high.csv --set height=high").exitCode, 0);
    EXPECT_EQ(read("low.csv"), read("again.csv"));
    EXPECT_NE(read("low.csv"), read("high.csv"));
    EXPECT_NE(read("high.csv").find("height=high"), std::string::npos);
}

TEST_F(SceneFiles, SmallBodiesAreWarnedOf) {
    write("drop.json", drop);
    const auto outcome =
        call("render drop.json --seconds 1 --events a.csv --set size=tiny --set height=high");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.err, "physvib: warning: drop.json: bodies[1].fixtures[0]: expected 0.1 to 10, found "
                           "0.04 m: Box2D simulates such moving bodies less well\n");
}

TEST_F(SceneFiles, BadScenesAreNamedByTheirField) {
    write("bad.json",
          R"({ "physvib_scene": 1, "name": "bad", "field_m": [0, 4], "materials": [], "bodies": [] })");
    refuses("render bad.json --out a.wav --events a.csv", 1,
            "bad.json: field_m[0]: expected 0.01 to 1000, found 0", 1);
    refuses("render none.json --out a.wav", 1, "none.json: cannot be read", 1);
    refuses("render ./none --out a.wav", 1, "./none: cannot be read", 1);
}

TEST_F(SceneFiles, WrongSettingsAreRefused) {
    refuses("render shake-the-box --set size=big --out a.wav", 2, "no variable \"size\", the scene has none");
    refuses("render shake-the-box --set size --out a.wav", 2, "--set: expected NAME=VALUE");
    refuses("render nonsense --out a.wav", 2, "no scene \"nonsense\" (see physvib scenes)");
    write("drop.json", drop);
    refuses("render drop.json --set height=2 --out a.wav", 1,
            "drop.json: variable \"height\": expected one of low, high, found \"2\"", 1);
    refuses("render --from-events drop.json --set height=low --out a.wav", 2,
            "--set: only a scene has variables", 1);
}

} // namespace
} // namespace physvib
