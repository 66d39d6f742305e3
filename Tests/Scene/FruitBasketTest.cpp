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
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace physvib {
namespace {

constexpr double floorTop = 0.9, basketAt = 4.0;
constexpr double dropMetres = 2.0;

const Scene& basket() { return *findBuiltInScene("fruit-basket"); }

bool isOf(const CollisionEvent& event, const Material& material) {
    return event.frequencyHz == material.frequencyHz && event.decayPerSecond == material.decayPerSecond;
}

const Material& materialNamed(const std::string& name) {
    return *std::ranges::find(basket().materials, name, &Material::name);
}

/// The first fruit of each kind, by its material.
std::map<std::string, BodyDescription> kinds() {
    std::map<std::string, BodyDescription> found;
    for (const BodyDescription& body : sceneCast(basket()))
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
        const double basketMass =
            massKg(*std::ranges::find(basket().bodies, "basket", &BodyDescription::name), basket());
        const double amplitude =
            basket().driveGain * impulse / (2.0 * basket().fieldWidthMetres * 2.0 * basketMass);
        EXPECT_NEAR(fall.landing.amplitude, amplitude, 0.02 * amplitude) << kind;
        amplitudes[fall.massKg] = fall.landing.amplitude;
    }
    ASSERT_EQ(amplitudes.size(), 6U);
    for (auto next = std::next(amplitudes.begin()); next != amplitudes.end(); ++next)
        EXPECT_GT(next->second, std::prev(next)->second) << next->first << " kg";
}

TEST(FruitBasket, TheHigherTheFallTheHarderTheLanding) {
    const Fall full(kinds().at("orange"));
    double before = 0.0;
    for (const double height : {0.25, 0.5, 1.0, 2.0}) {
        Scene scene = full.scene;
        scene.bodies.back().positionMetres.y += height - dropMetres;
        const double amplitude = eventsOf(scene, 1.0).at(0).amplitude;
        EXPECT_GT(amplitude, 1.3 * before); // the root of 2 by each doubling
        before = amplitude;
    }
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
    Scene scene = sceneForHands(basket());
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
        return std::ranges::count_if(scene.script, [](const ScriptInput& input) {
            return std::holds_alternative<VelocityAction>(input.action);
        });
    };
    EXPECT_GT(moves(basket()), 10) << "the script catches for whoever only looks";
    EXPECT_EQ(moves(sceneForHands(basket())), 0);
    EXPECT_GT(sceneForHands(basket()).script.size(), 20U) << "fruits fall all the same";
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
        if (!actions.empty()) speed = std::get<VelocityAction>(actions.front()).metresPerSecond.x;
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
    EXPECT_EQ(std::get<VelocityAction>(stop.front()).metresPerSecond.x, 0.0);
}

TEST(FruitBasket, AFruitAtTwiceTheSpeedIsTwiceAsStrong) {
    const Fall full(kinds().at("orange"));
    Scene quarter = full.scene;
    quarter.bodies.back().positionMetres.y -= 0.75 * dropMetres; // a quarter of the height, half the speed
    EXPECT_NEAR(full.landing.amplitude / eventsOf(quarter, 1.0).at(0).amplitude, 2.0, 0.1);
}

} // namespace
} // namespace physvib
