// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-render, which has no JUCE: the events, samples and care of the whole program.
#include "Calls.h"
#include "TestPlaces.h"
#include <algorithm>
#include <array>

namespace physvib::render_alone_test {

class RenderAlone : public test::CommandLine {
protected:
    /// What `physvib-render` says; 0 if it is content.
    int alone(const std::string& arguments) const {
        return call(arguments, {}, PHYSVIB_RENDER_PROGRAM).exitCode;
    }
    /// What stands behind the head of a WAV file.
    std::string samplesOf(const std::string& name) const {
        const std::string bytes = read(name);
        return bytes.substr(std::min(bytes.size(), bytes.find("data") + 8));
    }
};

TEST_F(RenderAlone, GivesTheEventsAndSamplesOfTheWholeProgram) {
    for (const std::string scene : {"shake-the-box", "marbles", "drop"})
        for (const std::string options :
             {" --seconds 2 --seed 3",
              " --seconds 1 --layout ring2 --rate 44100 --steps-per-second 200 --instructions scalar"}) {
            runs("render " + scene + options + " --out a.wav --events a.csv --picture a.png");
            ASSERT_EQ(alone(scene + options + " --out b.wav --events b.csv --picture b.png"), 0)
                << read(".err");
            EXPECT_EQ(read("a.csv"), read("b.csv")) << scene;
            EXPECT_GE(samplesOf("b.wav").size(), 8 * 44100u);
            EXPECT_TRUE(samplesOf("a.wav") == samplesOf("b.wav")) << scene << options;
            EXPECT_GE(read("b.png").size(), 10000u);
            EXPECT_TRUE(read("a.png") == read("b.png")) << scene << options;
        }
    ASSERT_EQ(alone("a.csv --seconds 1 --out again.wav"), 0) << read(".err");
}

TEST_F(RenderAlone, AListRendersAsItsSceneDidBecauseItSaysItsField) {
    ASSERT_EQ(alone("shake-the-box --seconds 3 --out scene.wav --events box.csv"), 0) << read(".err");
    ASSERT_EQ(alone("box.csv --seconds 3 --out list.wav"), 0) << read(".err");
    EXPECT_EQ(read(".err"), "");
    EXPECT_TRUE(samplesOf("list.wav") == samplesOf("scene.wav"));
    runs("render --from-events box.csv --seconds 3 --out whole.wav --events whole.csv");
    EXPECT_TRUE(samplesOf("whole.wav") == samplesOf("scene.wav"));
    EXPECT_TRUE(has(read("whole.csv"), " field_m=6.4,3.6\n")) << "handed on";

    std::string old = read("box.csv"); // as lists were before
    const std::string said = " field_m=6.4,3.6";
    ASSERT_NE(old.find(said), std::string::npos) << old.substr(0, 100);
    write("old.csv", old.erase(old.find(said), said.size()));
    ASSERT_EQ(alone("old.csv --seconds 3 --field 6.4,3.6 --out told.wav"), 0) << read(".err");
    EXPECT_EQ(read(".err"), "");
    EXPECT_TRUE(samplesOf("told.wav") == samplesOf("scene.wav"));
    ASSERT_EQ(alone("old.csv --seconds 3 --out guessed.wav --events guessed.csv"), 0) << read(".err");
    const std::string warning =
        " hits lie outside the field of 0.12 x 0.06 m, the layout's, as the list says none (see --field)\n";
    EXPECT_TRUE(read(".err").starts_with("physvib-render: warning: ") && read(".err").ends_with(warning))
        << read(".err");
    EXPECT_FALSE(has(read("guessed.csv"), "field_m")) << "a guess is not handed on";
    const auto whole = call("render --from-events old.csv --seconds 3 --out again.wav");
    EXPECT_TRUE(whole.err.starts_with("physvib: warning: ") && whole.err.ends_with(warning)) << whole.err;
    EXPECT_TRUE(samplesOf("again.wav") == samplesOf("guessed.wav"));
}

TEST_F(RenderAlone, SilenceSaysWhy) {
    const std::string outside = " hits lie outside the field of ";
    for (const auto& [rows, options, why] : std::vector<std::array<std::string, 3>>{
             {"0.5,200,10,0.5,3,2\n0.6,200,10,0.5,4,2\n", "",
              "2 of 2" + outside + "0.12 x 0.06 m, the layout's, as the list says none (see --field)"},
             {"0.5,200,10,0.5,3,2\n", " --field 0.1,0.1", "1 of 1" + outside + "0.1 x 0.1 m (see --field)"},
             {"2,200,10,0.5,0.05,0.02\n", "", "all hits begin after the end"},
             {"0.5,200,10,0,0.05,0.02\n", "", "the strongest hit is 0.000000 of full scale"}}) {
        writeHits("hits.csv", rows);
        ASSERT_EQ(alone("hits.csv --seconds 1 --out a.wav" + options), 0) << read(".err");
        EXPECT_EQ(read(".err"), "physvib-render: warning: silent: " + why + "\n");
        const auto whole = call("render --from-events hits.csv --seconds 1 --out b.wav" + options);
        EXPECT_TRUE(has(whole.out, "48000 Hz, silent: " + why + "\n"));
    }
}

TEST_F(RenderAlone, RefusesInOneLineAndLeavesNothing) {
    for (const auto& [arguments, code] : std::vector<std::pair<std::string, int>>{
             {"drop", 2},
             {"drop --out x.wav --seconds -1", 2},
             {"drop --out x.wav --seconds nan", 2},
             {"drop --out x.wav --events x.wav", 2},
             {"nothing --out x.wav", 1},
             {"drop --layout no --out x.wav", 1},
             {"drop --seconds 86400 --rate 192000 --out x.wav", 1},
             {"drop --out no/x.wav", 1},
             {"drop --out x.wav --field 1", 2},
             {"drop --out x.png --picture x.png", 2},
             {"drop --picture x.svg", 2},
             {"drop --out x.wav --events x.csv --picture no/x.png", 1}}) {
        EXPECT_EQ(alone(arguments), code) << arguments;
        const std::string said = read(".err");
        EXPECT_TRUE(said.starts_with("physvib-render: ")) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_TRUE(files().empty()) << arguments;
    }
}

// `physvib render SCENE.json` and `--set`: anybody's world, and its variables.

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
    const auto outcome = runs("render drop.json --seconds 2 --out a.wav --events a.csv --picture a.png");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(files().size(), 4u);
    EXPECT_TRUE(has(read("a.csv"), "scene=my drop seed=1 steps_per_second=100 height=low size=big"));
    EXPECT_TRUE(has(read("a.csv"), ",80,34.13,"));
}

TEST_F(SceneFiles, SetChangesTheScene) {
    write("drop.json", drop);
    runs("render drop.json --seconds 2 --events low.csv");
    runs("render drop.json --seconds 2 --events again.csv --set height=low");
    runs("render drop.json --seconds 2 --events high.csv --set height=high");
    EXPECT_EQ(read("low.csv"), read("again.csv"));
    EXPECT_NE(read("low.csv"), read("high.csv"));
    EXPECT_TRUE(has(read("high.csv"), "height=high"));
}

TEST_F(SceneFiles, SmallBodiesAreWarnedOf) {
    write("drop.json", drop);
    const auto outcome =
        runs("render drop.json --seconds 1 --events a.csv --set size=tiny --set height=high");
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

} // namespace physvib::render_alone_test
