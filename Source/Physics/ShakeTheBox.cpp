// SPDX-License-Identifier: MIT
// Box, objects and the person who shakes them.
#include "Physics/ShakeTheBox.h"
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace physvib {

namespace {

constexpr double width = 6.4; // metres, thesis 5.3
constexpr double height = 3.6;
constexpr double scale = 0.66;    // of the sizes in Table 5.1, thesis 5.3
constexpr double thickness = 0.3; // as Table 5.1's blocks; the thesis' 0.02 m is thinner than a step's travel
constexpr double gravity = 9.8;   // m/s^2, thesis 5.3
constexpr double period = 24.0;   // s, the sum of the moves in script()

// Measured at 100 steps/s, 60 s, four enchanters, linear law: with this gain the loudest channel of the seeds 1 to 6
// peaks at -7.0 to -4.6 dBFS (median -6.2). Single hits reach 0.5 to 0.9; between enchanters each plays its share.
constexpr double driveGain = 7.0;

enum MaterialIndex { rubber, wood, steelCan, concreteWall, woodWall, steelWall };

// Table 5.1, which has no friction and no sound of the objects: they are no cameras. Friction is ours.
std::vector<Material> materials() {
    return {
        {"rubber", 120.0, 0.6, 0.688, 0.0, 0.0},           {"wood", 850.0, 0.4, 0.603, 0.0, 0.0},
        {"steel can", 1193.0, 0.3, 0.597, 0.0, 0.0},       {"concrete wall", 1000.0, 0.5, 0.500, 80.0, 34.13},
        {"wooden wall", 850.0, 0.4, 0.603, 349.0, 106.99}, {"steel wall", 7820.0, 0.3, 0.597, 430.0, 11.97}};
}

BodyDescription wall(const char* name, int material, double massKg, Point centre, BoxShape box) {
    BodyDescription body;
    body.name = name;
    body.shape = box;
    body.material = material;
    body.position = centre;
    body.isStatic = true;
    body.isCamera = true;
    body.staticMassKg = massKg; // of a box of that material, thesis 5.3
    return body;
}

void addWalls(std::vector<BodyDescription>& bodies) {
    const double out = thickness / 2.0;
    const BoxShape lying{width + 2.0 * thickness, thickness};
    const BoxShape standing{thickness, height};
    bodies.push_back(wall("floor", woodWall, 340.0, {width / 2.0, -out}, lying));
    bodies.push_back(wall("ceiling", woodWall, 340.0, {width / 2.0, height + out}, lying));
    bodies.push_back(wall("left wall", concreteWall, 400.0, {-out, height / 2.0}, standing));
    bodies.push_back(wall("right wall", steelWall, 3128.0, {width + out, height / 2.0}, standing));
}

BodyDescription object(std::string name, int material, Shape shape, Point centre) {
    BodyDescription body;
    body.name = std::move(name);
    body.shape = shape;
    body.material = material;
    body.position = centre;
    return body;
}

// Three columns (small, medium, large) of three rows (rubber, wood, steel).
void addObjects(std::vector<BodyDescription>& bodies) {
    constexpr const char* sizes[] = {"small", "medium", "large"};
    for (int size = 0; size < 3; ++size) {
        const double times = scale * (size + 1);
        const CircleShape ball{0.15 * times};
        const BoxShape can{0.157 * times, 0.30 * times};
        const double x = 1.1 + 2.0 * size;
        const std::string name = sizes[size];
        bodies.push_back(object(name + " rubber ball", rubber, ball, {x, 3.0}));
        bodies.push_back(object(name + " wood sphere", wood, ball, {x + 0.4, 1.9}));
        bodies.push_back(object(name + " steel can", steelCan, can, {x, 0.7}));
    }
}

/// The moves of a person who holds the box, appended one after the other.
class Hands {
public:
    /// Holds the box so that down lies at this angle (0: upright, pi/2: on its right wall).
    void tilt(double angleRadians, double seconds) { push(angleRadians, seconds, 0.0, 0.0); }

    /// Jerks the box to and fro, along x or y, `times` times each way.
    void shake(double xMetresPerSecond2, double yMetresPerSecond2, int times, double seconds) {
        for (int i = 0; i < 2 * times; ++i) {
            const double sign = i % 2 == 0 ? 1.0 : -1.0;
            push(0.0, seconds / (2 * times), sign * xMetresPerSecond2, sign * yMetresPerSecond2);
        }
    }

    /// Turns the box once around, in equal parts.
    void turn(int parts, double seconds) {
        for (int i = 0; i < parts; ++i) tilt(2.0 * std::numbers::pi * i / parts, seconds / parts);
    }

    std::vector<GravityInput> script;

private:
    void push(double downRadians, double seconds, double x, double y) {
        script.push_back(
            {seconds_, gravity * std::sin(downRadians) + x, -gravity * std::cos(downRadians) + y});
        seconds_ += seconds;
    }
    double seconds_ = 0.0;
};

std::vector<GravityInput> script() {
    Hands hands;
    hands.tilt(0.0, 1.0);
    hands.tilt(1.2, 1.5);
    hands.tilt(-1.2, 1.5);
    hands.shake(18.0, 18.0, 5, 4.0);
    hands.tilt(-0.8, 1.0);
    hands.tilt(0.8, 1.0);
    hands.shake(25.0, 0.0, 4, 4.0);
    hands.turn(24, 6.0);
    hands.shake(0.0, 25.0, 6, 4.0);
    return hands.script;
}

} // namespace

Scene shakeTheBox() {
    Scene scene;
    scene.name = "shake-the-box";
    scene.description =
        "nine objects in a box of wood, concrete (left) and steel (right) that is shaken and tilted";
    scene.fieldWidthMetres = width;
    scene.fieldHeightMetres = height;
    scene.driveGain = driveGain;
    scene.materials = materials();
    addWalls(scene.bodies);
    addObjects(scene.bodies);
    scene.script = script();
    scene.scriptPeriodSeconds = period;
    return scene;
}

} // namespace physvib
