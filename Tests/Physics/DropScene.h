// SPDX-License-Identifier: MIT
// A ball above a plate, as in the thesis' study 1 (Table 5.1): the world whose hits are known by hand.
#pragma once
#include "Physics/Scene.h"
#include "Physics/Simulation.h"
#include <cmath>
#include <numbers>
#include <vector>

namespace physvib {

constexpr double dropGravity = 9.8;
constexpr double dropRadius = 0.15;
constexpr double dropMass = 120.0 * std::numbers::pi * dropRadius * dropRadius;
constexpr double plateMass = 870.0;
constexpr int plateIndex = 0;
constexpr int ballIndex = 1;

/// Rubber ball whose lowest point is `heightMetres` above a concrete camera plate; the field is 4 x 4 m.
inline Scene dropScene(double heightMetres) {
    Scene scene;
    scene.name = "drop";
    scene.fieldWidthMetres = 4.0;
    scene.fieldHeightMetres = 4.0;
    scene.driveGain = 3.0;
    scene.materials = {{"concrete", 1000.0, 0.5, 0.5, 80.0, 34.13}, {"rubber", 120.0, 0.5, 0.688, 205.0, 40.0}};
    scene.bodies.resize(2);
    scene.bodies[plateIndex].shape = BoxShape{2.9, 0.3};
    scene.bodies[plateIndex].position = {2.0, 0.15};
    scene.bodies[plateIndex].isStatic = true;
    scene.bodies[plateIndex].isCamera = true;
    scene.bodies[plateIndex].staticMassKg = plateMass;
    scene.bodies[ballIndex].shape = CircleShape{dropRadius};
    scene.bodies[ballIndex].material = 1;
    scene.bodies[ballIndex].position = {1.7, 0.3 + heightMetres + dropRadius};
    scene.script = {{0.0, 0.0, -dropGravity}};
    return scene;
}

/// All events of the first `seconds` of a scene.
inline std::vector<CollisionEvent> eventsOf(const Scene& scene, double seconds, int stepsPerSecond = 100,
                                            std::uint32_t seed = 0) {
    Simulation simulation(scene, seed, stepsPerSecond);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < seconds * stepsPerSecond; ++i) simulation.step(events);
    return events;
}

} // namespace physvib
