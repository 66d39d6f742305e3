// SPDX-License-Identifier: MIT
// A ball above a plate, as in the thesis' study 1 (Table 5.1): the world whose hits are known by hand.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/Simulation.h"
#include <gtest/gtest.h>
#include <numbers>
#include <string>
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
    scene.materials = {{"concrete", 1000.0, 0.5, 0.5, 80.0, 34.13},
                       {"rubber", 120.0, 0.5, 0.688, 205.0, 40.0}};
    scene.gravityMetresPerSecond2 = {0.0, -dropGravity};
    scene.bodies.resize(2);
    scene.bodies[plateIndex] = {
        "plate", BodyType::staticBody, {{BoxShape{2.9, 0.3}, {}, 0.0, 0, true}}, {2.0, 0.15}};
    scene.bodies[plateIndex].massKg = plateMass;
    scene.bodies[ballIndex] = {"ball",
                               BodyType::dynamicBody,
                               {{CircleShape{dropRadius}, {}, 0.0, 1}},
                               {1.7, 0.3 + heightMetres + dropRadius}};
    return scene;
}

/// Ten balls in a closed box of 4 x 4 m whose gravity turns over every half second: no step is like another.
inline Scene shakenScene() {
    Scene scene = dropScene(1.0);
    scene.bodies.clear();
    const auto wall = [&](const char* name, Vector centre, BoxShape box) {
        scene.bodies.push_back({name, BodyType::staticBody, {{box, {}, 0.0, 0, true}}, centre});
        scene.bodies.back().massKg = plateMass;
    };
    wall("floor", {2.0, -0.25}, {5.0, 0.5});
    wall("ceiling", {2.0, 4.25}, {5.0, 0.5});
    wall("left", {-0.25, 2.0}, {0.5, 4.0});
    wall("right", {4.25, 2.0}, {0.5, 4.0});
    for (int i = 0; i < 10; ++i)
        scene.bodies.push_back({"ball " + std::to_string(i),
                                BodyType::dynamicBody,
                                {{CircleShape{dropRadius}, {}, 0.0, 1}},
                                {0.5 + 0.3 * i, 1.0 + 0.2 * i}});
    scene.script = {{0.0, 1, 0.0, GravityAction{{3.0, -15.0}}}, {0.5, 1, 0.0, GravityAction{{-5.0, 15.0}}}};
    scene.scriptPeriodSeconds = 1.0;
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

/// So many events at least, none later than `longestNs` after the one before, and the last not before
/// `untilNs`.
inline void expectLively(const std::vector<CollisionEvent>& events, std::size_t least, std::int64_t longestNs,
                         std::int64_t untilNs) {
    EXPECT_GE(events.size(), least);
    std::int64_t before = 0;
    for (const CollisionEvent& event : events) {
        EXPECT_LE(event.timeNs - before, longestNs);
        before = event.timeNs;
    }
    EXPECT_GE(before, untilNs);
}

/// A name for a test, which has no hyphens.
inline std::string bare(std::string name) {
    std::erase(name, '-');
    return name;
}

} // namespace physvib
