// SPDX-License-Identifier: MIT
// Every fault of a scene is named with its place.
#include "Physics/SceneValidation.h"
#include "DropScene.h"
#include "Physics/SceneCatalogue.h"
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace physvib {
namespace {

TEST(SceneValidation, AcceptsTheBuiltInScenes) {
    for (const Scene& scene : builtInScenes()) EXPECT_EQ(validate(scene), "") << scene.name;
    EXPECT_EQ(validate(dropScene(1.0)), "");
}

struct Fault {
    const char* name;
    std::function<void(Scene&)> make;
    std::string expected; // the sentence begins so
};
class FaultyScene : public testing::TestWithParam<Fault> {};

TEST_P(FaultyScene, IsRefusedByNamingThePlace) {
    Scene scene = dropScene(1.0);
    GetParam().make(scene);
    EXPECT_EQ(validate(scene).substr(0, GetParam().expected.size()), GetParam().expected);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Each, FaultyScene,
    testing::Values(
        Fault{"FieldWidth", [](Scene& s) { s.fieldWidthMetres = 0.0; }, "field width: expected"},
        Fault{"FieldHeight", [](Scene& s) { s.fieldHeightMetres = nan; }, "field height: expected"},
        Fault{"DriveGain", [](Scene& s) { s.driveGain = -1.0; }, "drive gain: expected"},
        Fault{"Density", [](Scene& s) { s.materials[1].densityKgPerSquareMetre = 0.0; },
              "material 1 (rubber), density: expected"},
        Fault{"Friction", [](Scene& s) { s.materials[0].friction = -0.1; },
              "material 0 (concrete), friction"},
        Fault{"Restitution", [](Scene& s) { s.materials[0].restitution = 1.1; },
              "material 0 (concrete), restitution: expected 0 to 1, found 1.1"},
        Fault{"Frequency", [](Scene& s) { s.materials[0].frequencyHz = 1.0e6; },
              "material 0 (concrete), freq"},
        Fault{"Decay", [](Scene& s) { s.materials[0].decayPerSecond = -1.0; },
              "material 0 (concrete), decay"},
        Fault{"MaterialIndex", [](Scene& s) { s.bodies[1].material = 2; },
              "body 1, material: expected one of"},
        Fault{"NegativeIndex", [](Scene& s) { s.bodies[1].material = -1; },
              "body 1, material: expected one of"},
        Fault{"Radius", [](Scene& s) { s.bodies[1].shape = CircleShape{0.0}; }, "body 1, radius: expected"},
        Fault{"Width",
              [](Scene& s) {
                  s.bodies[0].shape = BoxShape{-1.0, 1.0};
              },
              "body 0, width: expected"},
        Fault{"Height",
              [](Scene& s) {
                  s.bodies[0].shape = BoxShape{1.0, nan};
              },
              "body 0, height: expected"},
        Fault{"Position", [](Scene& s) { s.bodies[0].position.yMetres = 1.0e9; }, "body 0, y: expected"},
        Fault{"Angle", [](Scene& s) { s.bodies[0].angleRadians = nan; }, "body 0, angle: expected"},
        Fault{"CameraMass", [](Scene& s) { s.bodies[0].staticMassKg = 0.0; },
              "body 0, mass: a static camera"},
        Fault{"CameraFrequency", [](Scene& s) { s.materials[0].frequencyHz = 0.0; },
              "body 0, material: a camera"},
        Fault{"CameraDecay", [](Scene& s) { s.materials[0].decayPerSecond = 0.0; },
              "body 0, material: a camera"},
        Fault{"Period", [](Scene& s) { s.scriptPeriodSeconds = -1.0; }, "script period: expected"},
        Fault{"InputOrder",
              [](Scene& s) {
                  s.script = {{2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
              },
              "script input 1, time: expected 2 to"},
        Fault{"InputAfterPeriod",
              [](Scene& s) {
                  s.script = {{2.0, 0.0, 0.0}};
                  s.scriptPeriodSeconds = 1.0;
              },
              "script input 0, time: expected 0 to 1"},
        Fault{"Acceleration", [](Scene& s) { s.script[0].xMetresPerSecond2 = nan; },
              "script input 0, x: expected"}),
    [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace physvib
