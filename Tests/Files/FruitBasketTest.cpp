// SPDX-License-Identifier: MIT
// In the fruit basket one feels the fruits: each kind with its own sound, the heavier the stronger.
#include "Files/SceneCatalogue.h"
#include "Physics/BodyMass.h"
#include "Physics/DropScene.h"
#include "SceneHits.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace physvib {
namespace {

constexpr double floorTop = 0.22;
constexpr double dropMetres = 2.0;

const Scene& basket() {
    return *findBuiltInScene("fruit-basket");
}

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
        fruit.positionMetres = {2.8, floorTop + dropMetres + radius};
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
        const double basketMass = massKg(basket().bodies[0], basket()); // also the largest: m_h of Eq. 5.7
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
    for (const CollisionEvent& event : eventsOf(basket(), 60.0, 100, 1)) {
        ASSERT_GE(event.source.other, 0);
        const Material& fruit = hits.materialOf(event.source.other);
        EXPECT_TRUE(isOf(event, fruit)) << fruit.name << " sounds with " << event.frequencyHz << " Hz";
        sounds.insert(fruit.name);
        parts.insert(fruit.name + " at " + std::to_string(event.source.fixture));
    }
    EXPECT_EQ(sounds, (std::set<std::string>{"cherry", "coconut", "fig", "melon", "orange", "plum"}));
    EXPECT_EQ(parts.size(), 6U * 4U); // floor, two sides, cover
}

TEST(FruitBasket, SoundsAreAllDifferent) {
    std::set<double> frequencies;
    for (const Material& material : basket().materials) frequencies.insert(material.frequencyHz);
    EXPECT_EQ(frequencies.size(), basket().materials.size());
}

TEST(FruitBasket, AnEatenMelonIsFeltNoMoreUntilTheNextOneFallsIn) {
    int before = 0, after = 0;
    for (const CollisionEvent& event : eventsOf(basket(), 60.0, 100, 1)) {
        if (!isOf(event, materialNamed("melon"))) continue;
        EXPECT_FALSE(event.timeNs > 27'020'000'000 && event.timeNs < 30'400'000'000) << event.timeNs;
        ++(event.timeNs < 30'000'000'000 ? before : after);
    }
    EXPECT_GE(before, 10);
    EXPECT_GE(after, 10);
}

} // namespace
} // namespace physvib
