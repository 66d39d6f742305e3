// SPDX-License-Identifier: MIT
// At the wheel one feels how fast one drove, and into what.
#include "Scene/DropScene.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFile.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/ScenePlayer.h"
#include "SceneHits.h"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <tuple>

namespace physvib {
namespace {

constexpr double wheelRadius = 0.34;

const Scene& driving() { return *findBuiltInScene("driving"); }

/// The car alone on its road, both wheels driven for this speed.
Scene emptyRoad(double metresPerSecond) {
    Scene scene = driving();
    scene.script.clear();
    for (const char* axle : {"rear axle", "front axle"})
        scene.script.push_back({0.0, 1, 0.0, MotorAction{axle, -metresPerSecond / wheelRadius, {}}});
    return scene;
}

/// The same without its hump and bumps, so that nothing but the speed differs at the end of it.
Scene levelRoad(double metresPerSecond) {
    Scene scene = emptyRoad(metresPerSecond);
    auto& road = scene.bodies.at(0).fixtures;
    auto& line = std::get<ChainShape>(road.at(0).shape).verticesMetres;
    line = {line.front(), line.back()};
    road.resize(2); // the line and the ground; the third fills the hump
    return scene;
}

double massOf(const std::string& body) {
    return massKg(*std::ranges::find(driving().bodies, body, &BodyDescription::name), driving());
}

/// The first time that the car's body itself strikes `what`.
CollisionEvent firstHit(const Scene& scene, const std::string& what) {
    const SceneHits hits(scene);
    for (const CollisionEvent& event : eventsOf(scene, 12.0))
        if (event.source.other >= 0 && hits.bodyOf(event.source.fixture) == "car" &&
            hits.bodyOf(event.source.other) == what)
            return event;
    ADD_FAILURE() << what << " was not hit";
    return {};
}

TEST(Driving, TheFasterTheCarTheHarderItHitsTheWall) {
    double impulse = 0.0, amplitude = 0.0;
    for (const double speed : {1.0, 1.5, 2.25, 3.375, 5.0625}) {
        const CollisionEvent hit = firstHit(levelRoad(speed), "right wall");
        EXPECT_GT(hit.source.impulseNewtonSeconds, 1.2 * impulse) << speed << " m/s";
        EXPECT_GT(hit.amplitude, 1.2 * amplitude) << speed << " m/s";
        impulse = hit.source.impulseNewtonSeconds;
        amplitude = hit.amplitude;
    }
}

TEST(Driving, AHitAtTwiceTheSpeedIsTwiceAsStrong) {
    EXPECT_NEAR(firstHit(levelRoad(4.0), "right wall").amplitude /
                    firstHit(levelRoad(2.0), "right wall").amplitude,
                2.0, 0.1);
}

/// The walls that were struck, in their order, each once in a row.
std::vector<std::string> wallsHit(const Scene& scene, double seconds) {
    const SceneHits hits(scene);
    std::vector<std::string> walls;
    for (const CollisionEvent& event : eventsOf(scene, seconds)) {
        if (event.source.other < 0) continue;
        const std::string& what = hits.bodyOf(event.source.other);
        if (what.ends_with("wall") && (walls.empty() || walls.back() != what)) walls.push_back(what);
    }
    return walls;
}

TEST(Driving, KeysDriveTheCarFasterWithEachAndBrakeIt) {
    Scene scene = sceneForHands(driving());
    ScenePlayer player{scene};
    EXPECT_TRUE(player.drives());
    EXPECT_TRUE(std::ranges::none_of(scene.script, [](const ScriptInput& input) {
        return std::holds_alternative<MotorAction>(input.action);
    }));
    EXPECT_FALSE(scene.script.empty()) << "obstacles fall all the same";
    scene.script.clear();
    const auto act = [&](double seconds, const std::vector<Action>& actions) {
        for (const Action& action : actions) scene.inputs.push_back({seconds, action});
    };
    EXPECT_TRUE(wallsHit(scene, 12.0).empty()) << "nobody drives";
    act(0.5, player.steer(1));
    act(0.7, player.steer(1));
    EXPECT_EQ(std::get<MotorAction>(scene.inputs.back().action).radiansPerSecond,
              -2.0 * ScenePlayer::stepRadiansPerSecond);
    EXPECT_EQ(wallsHit(scene, 12.0), std::vector<std::string>{"right wall"});
    act(7.0, player.steer(-1)); // against its way: it brakes
    EXPECT_EQ(std::get<MotorAction>(scene.inputs.back().action).radiansPerSecond, 0.0);
    for (const double seconds : {8.0, 8.2, 8.4}) act(seconds, player.steer(-1));
    EXPECT_EQ(wallsHit(scene, 20.0), (std::vector<std::string>{"right wall", "left wall"}));
}

TEST(Driving, TheWallStopsTheCarAndSomeOfItsWheels) {
    const double body = massOf("car"), wheels = massOf("rear wheel") + massOf("front wheel");
    for (const double speed : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
        const double change = speed * (1.0 + 0.2); // m/s, by the restitution of sheet metal
        const double impulse = firstHit(levelRoad(speed), "right wall").source.impulseNewtonSeconds;
        EXPECT_GT(impulse, 0.9 * body * change) << speed << " m/s"; // the nose is below the middle
        EXPECT_LT(impulse, 1.03 * (body + wheels) * change) << speed << " m/s";
    }
}

TEST(Driving, TheHeavierTheObstacleTheHarderTheHit) {
    std::map<std::string, double> impulses;
    for (const BodyDescription& body : sceneCast(driving()))
        for (const char* name : {"wooden crate 1", "steel drum 1", "concrete block"})
            if (body.name == name) {
                Scene scene = levelRoad(4.0);
                scene.bodies.push_back(body);
                scene.bodies.back().positionMetres = {8.2, 1.5};
                impulses[name] = firstHit(scene, name).source.impulseNewtonSeconds;
            }
    EXPECT_GT(impulses["steel drum 1"], 1.2 * impulses["wooden crate 1"]);
    EXPECT_GT(impulses["concrete block"], 1.2 * impulses["steel drum 1"]);
}

TEST(Driving, TheCarRingsTogetherWithWhatItHits) {
    const SceneHits hits(driving());
    std::map<std::tuple<std::int64_t, int, int>, std::multiset<double>> sounds; // by impact
    std::set<std::string> struck;
    for (const CollisionEvent& event : eventsOf(driving(), 72.0, 100, 1)) {
        if (hits.bodyOf(event.source.fixture) != "car") continue;
        ASSERT_GE(event.source.other, 0);
        sounds[{event.timeNs, event.source.fixture, event.source.other}].insert(event.frequencyHz);
        struck.insert(hits.materialOf(event.source.other).name);
    }
    for (const auto& [impact, frequencies] : sounds) {
        const double car = hits.materialOf(std::get<1>(impact)).frequencyHz;
        const double other = hits.materialOf(std::get<2>(impact)).frequencyHz;
        EXPECT_EQ(frequencies.count(car), frequencies.size() / 2);
        EXPECT_EQ(frequencies.count(other), frequencies.size() / 2);
    }
    EXPECT_EQ(struck, (std::set<std::string>{"concrete", "earth", "rubber", "steel", "wood"}));
}

TEST(Driving, WheelsFeelTheRoadAsRubber) {
    const SceneHits hits(driving());
    std::array<int, 2> bumps{};
    for (const CollisionEvent& event : eventsOf(emptyRoad(3.0), 3.0)) {
        const std::string& part = hits.bodyOf(event.source.fixture);
        if (part == "car") continue;
        EXPECT_EQ(event.frequencyHz, hits.materialOf(event.source.fixture).frequencyHz);
        ++bumps[part == "front wheel" ? 0 : 1];
    }
    EXPECT_GE(bumps[0], 3); // the three of the rumble strip
    EXPECT_GE(bumps[1], 3);
}

TEST(Driving, TheCarGoesFromWallToWallAndStaysOnItsWheels) {
    Simulation simulation(driving(), 1, 100);
    const std::size_t car = 3;
    ASSERT_EQ(driving().bodies[car].name, "car");
    std::vector<CollisionEvent> events;
    bool isLeft = true;
    int crossings = 0;
    for (int i = 0; i < 60'000; ++i) {
        simulation.step(events);
        const BodyPose pose = simulation.pose(car);
        ASSERT_LT(std::abs(pose.angleRadians), 0.8) << "at step " << i;
        const bool hasArrived = isLeft ? pose.xMetres > 10.2 : pose.xMetres < 1.8; // half a car from the wall
        if (hasArrived) isLeft = !isLeft;
        crossings += hasArrived ? 1 : 0;
    }
    EXPECT_GE(crossings, 40); // in ten minutes; obstacles are often in the way
}

} // namespace
} // namespace physvib
