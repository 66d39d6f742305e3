// SPDX-License-Identifier: MIT
// In the fruit basket one feels the fruits that one catches: each kind with its own sound, the heavier the
// stronger.
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

namespace physvib::fruit_basket_test {

constexpr double floorTop = 0.9, basketAt = 4.0;
constexpr double dropMetres = 2.0;

const Scene& basket() { return *findBuiltInScene("fruit-basket"); }

bool isOf(const CollisionEvent& event, const Material& material) {
    return event.frequencyHz == material.frequencyHz && event.decayPerSecond == material.decayPerSecond;
}

const Material& materialNamed(const std::string& name) { return *findNamed(basket().materials, name); }

/// The first fruit of each kind, by its material.
std::map<std::string, BodyDescription> kinds() {
    std::map<std::string, BodyDescription> found;
    for (const BodyDescription& body : allBodies(basket()))
        if (body.type == BodyType::dynamicBody) {
            const auto material = static_cast<std::size_t>(body.fixtures[0].material);
            found.emplace(basket().materials[material].name, body);
        }
    return found;
}

/// The same basket, still and empty, but for one fruit that falls from 2 m.
struct Fall {
    Scene scene = basket();
    double massKg;
    CollisionEvent landing;

    explicit Fall(BodyDescription fruit) {
        std::erase_if(scene.bodies, [](const auto& body) { return body.type == BodyType::dynamicBody; });
        scene.script.clear();
        const double radius = std::get<CircleShape>(fruit.fixtures[0].shape).radiusMetres;
        fruit.positionMetres = {basketAt, floorTop + dropMetres + radius};
        massKg = physvib::massKg(fruit, scene);
        scene.bodies.push_back(fruit);
        landing = eventsOf(scene, 1.0).at(0);
    }
};

TEST(FruitBasket, AMelonIsNotACherry) {
    const Fall melon(kinds().at("melon")), cherry(kinds().at("cherry"));
    EXPECT_TRUE(isOf(melon.landing, materialNamed("melon")));
    EXPECT_TRUE(isOf(cherry.landing, materialNamed("cherry")));
    EXPECT_LT(melon.landing.frequencyHz, cherry.landing.frequencyHz / 2.0); // a thud, not a tick
    EXPECT_LT(melon.landing.decayPerSecond, cherry.landing.decayPerSecond / 2.0);
    EXPECT_GT(melon.landing.amplitude, 10.0 * cherry.landing.amplitude);
}

TEST(FruitBasket, FruitsLandByTheirWeightAndSpring) {
    const double speed = std::sqrt(2.0 * dropGravity * dropMetres);
    std::map<double, double> amplitudes; // by weight
    for (const auto& [kind, fruit] : kinds()) {
        const Fall fall(fruit);
        const double impulse = fall.massKg * speed * (1.0 + materialNamed(kind).restitution);
        EXPECT_NEAR(fall.landing.source.impulseNewtonSeconds, impulse, 0.02 * impulse) << kind;
        // also the largest: m_h of Eq. 5.7
        const double basketMass = massKg(*findNamed(basket().bodies, "basket"), basket());
        const double amplitude =
            basket().driveGain * impulse / (2.0 * basket().fieldWidthMetres * 2.0 * basketMass);
        EXPECT_NEAR(fall.landing.amplitude, amplitude, 0.02 * amplitude) << kind;
        amplitudes[fall.massKg] = fall.landing.amplitude;
    }
    ASSERT_EQ(amplitudes.size(), 6U);
    for (auto next = std::next(amplitudes.begin()); next != amplitudes.end(); ++next)
        EXPECT_GT(next->second, std::prev(next)->second) << next->first << " kg";
}

TEST(FruitBasket, OnlyFruitsAreHeardAndEachKindIsOnEveryPartOfTheBasket) {
    const SceneHits hits(basket());
    std::set<std::string> parts, sounds;
    for (const CollisionEvent& event : eventsOf(basket(), 180.0, 100, 1)) {
        ASSERT_GE(event.source.other, 0);
        const Material& fruit = hits.materialOf(event.source.other);
        EXPECT_TRUE(isOf(event, fruit)) << fruit.name << " sounds with " << event.frequencyHz << " Hz";
        sounds.insert(fruit.name);
        parts.insert(fruit.name + " at " + std::to_string(event.source.fixture));
    }
    EXPECT_EQ(sounds, (std::set<std::string>{"cherry", "coconut", "fig", "melon", "orange", "plum"}));
    EXPECT_EQ(parts.size(), 6U * 3U); // floor, two sides
}

TEST(FruitBasket, SoundsAreAllDifferent) {
    std::set<double> frequencies;
    for (const Material& material : basket().materials) frequencies.insert(material.frequencyHz);
    EXPECT_EQ(frequencies.size(), basket().materials.size());
}

/// One orange that falls from a tree at `x`, and a basket that a player moves.
struct Orchard {
    Scene scene = sceneForUserInput(basket());
    ScenePlayer player{scene};

    explicit Orchard(double x) {
        scene.script.clear();
        BodyDescription orange = kinds().at("orange");
        orange.positionMetres = {x, 3.7};
        scene.bodies.push_back(orange);
    }
    void act(double seconds, const std::vector<Action>& actions) {
        for (const Action& action : actions) scene.inputs.push_back({seconds, action});
    }
    std::size_t felt() const { return eventsOf(scene, 2.0).size(); }
};

TEST(FruitBasket, IsPlayedByHandsAndItsScriptLeavesThatToThem) {
    const Orchard orchard{6.0};
    EXPECT_TRUE(orchard.player.moves());
    EXPECT_EQ(orchard.player.body(), "basket");
    const auto moves = [](const Scene& scene) {
        return std::ranges::count_if(scene.script, isAnyOf<VelocityAction>, &ScriptInput::action);
    };
    EXPECT_GT(moves(basket()), 10) << "the script catches for whoever only looks";
    EXPECT_EQ(moves(sceneForUserInput(basket())), 0);
    EXPECT_GT(sceneForUserInput(basket()).script.size(), 20U) << "fruits fall all the same";
}

TEST(FruitBasket, WhatIsCaughtByKeysIsFeltAndWhatIsMissedIsNot) {
    Orchard missed{6.0}, caught{6.0}, tooFar{6.0};
    EXPECT_EQ(missed.felt(), 0U);
    caught.act(0.1, caught.player.steer(1));
    caught.act(0.6, caught.player.steer(-1)); // against its way: it stops
    EXPECT_EQ(caught.scene.inputs.size(), 2U);
    EXPECT_GE(caught.felt(), 2U) << "it bounces in the basket";
    tooFar.act(0.1, tooFar.player.steer(-1));
    EXPECT_EQ(tooFar.felt(), 0U);
}

TEST(FruitBasket, TheMouseAndATiltCatchAsKeysDo) {
    Orchard byMouse{6.0}, byTilt{6.0};
    double at = basketAt, speed = 0.0;
    for (int look = 0; look < 60; ++look, at += speed / 30.0) {
        const auto actions = byMouse.player.moveTowards(6.0, at);
        if (!actions.empty()) speed = std::get<VelocityAction>(actions.front()).velocityMetresPerSecond.x;
        byMouse.act(look / 30.0, actions);
    }
    EXPECT_NEAR(at, 6.0, 0.1);
    EXPECT_GE(byMouse.felt(), 2U);
    byTilt.act(0.1, byTilt.player.tilt(-0.5)); // clockwise: to the right
    byTilt.act(0.6, byTilt.player.tilt(0.0));
    EXPECT_GE(byTilt.felt(), 2U);
}

TEST(FruitBasket, IsNotMovedOffItsField) {
    ScenePlayer player{basket()};
    ASSERT_EQ(player.steer(1).size(), 1U);
    EXPECT_TRUE(player.keepInside(6.0).empty());
    const auto stop = player.keepInside(6.8);
    ASSERT_EQ(stop.size(), 1U);
    EXPECT_EQ(std::get<VelocityAction>(stop.front()).velocityMetresPerSecond.x, 0.0);
    ASSERT_EQ(player.steer(-1).size(), 1U);
    EXPECT_TRUE(player.keepInside(6.8).empty()) << "it may leave an edge";
    EXPECT_EQ(player.keepInside(0.2).size(), 1U);
}

TEST(FruitBasket, IsNoFasterThanItsTopSpeedAndStopsBeforeItTurns) {
    ScenePlayer player{basket()};
    const auto speedOf = [](const std::vector<Action>& actions) {
        return std::get<VelocityAction>(actions.at(0)).velocityMetresPerSecond.x;
    };
    EXPECT_EQ(speedOf(player.moveTowards(6.0, 1.0)), ScenePlayer::maxMetresPerSecond);
    EXPECT_EQ(speedOf(player.moveTowards(1.0, 6.0)), -ScenePlayer::maxMetresPerSecond);
    EXPECT_EQ(speedOf(player.tilt(-9.0)), ScenePlayer::maxMetresPerSecond);
    EXPECT_EQ(speedOf(player.steer(-1)), 0.0);
}

TEST(FruitBasket, StopsHoweverSlowlyItMoves) {
    ScenePlayer player{basket()};
    ASSERT_EQ(player.steer(1).size(), 1U);
    const double fullTilt = 0.5,
                 fullSpeed = -std::get<VelocityAction>(player.tilt(fullTilt).at(0)).velocityMetresPerSecond.x;
    ASSERT_EQ(player.tilt(fullTilt * -0.04 / fullSpeed).size(), 1U) << "0.04 m/s";
    const auto stop = player.tilt(0.0);
    ASSERT_EQ(stop.size(), 1U);
    EXPECT_EQ(std::get<VelocityAction>(stop[0]).velocityMetresPerSecond.x, 0.0);
    EXPECT_TRUE(player.tilt(0.0).empty()) << "it stands already";
}

TEST(FruitBasket, AFruitAtTwiceTheSpeedIsTwiceAsStrong) {
    const Fall full(kinds().at("orange"));
    Scene quarter = full.scene;
    quarter.bodies.back().positionMetres.y -= 0.75 * dropMetres; // a quarter of the height, half the speed
    EXPECT_NEAR(full.landing.amplitude / eventsOf(quarter, 1.0).at(0).amplitude, 2.0, 0.1);
}

// At the wheel one feels how fast one drove, and into what.

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

double massOf(const std::string& body) { return massKg(*findNamed(driving().bodies, body), driving()); }

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
    Scene scene = sceneForUserInput(driving());
    ScenePlayer player{scene};
    EXPECT_TRUE(player.drives());
    EXPECT_TRUE(std::ranges::none_of(scene.script, isAnyOf<MotorAction>, &ScriptInput::action));
    EXPECT_FALSE(scene.script.empty()) << "obstacles fall all the same";
    scene.script.clear();
    const auto act = [&](double seconds, const std::vector<Action>& actions) {
        for (const Action& action : actions) scene.inputs.push_back({seconds, action});
    };
    EXPECT_TRUE(wallsHit(scene, 12.0).empty()) << "nobody drives";
    act(0.5, player.steer(1));
    act(0.7, player.steer(1));
    EXPECT_EQ(std::get<MotorAction>(scene.inputs.back().action).speedRadiansPerSecond,
              -2.0 * ScenePlayer::stepRadiansPerSecond);
    EXPECT_EQ(wallsHit(scene, 12.0), std::vector<std::string>{"right wall"});
    act(7.0, player.steer(-1)); // against its way: it brakes
    EXPECT_EQ(std::get<MotorAction>(scene.inputs.back().action).speedRadiansPerSecond, 0.0);
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
    for (const BodyDescription& body : allBodies(driving()))
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

} // namespace physvib::fruit_basket_test
