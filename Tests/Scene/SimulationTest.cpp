// SPDX-License-Identifier: MIT
// A ball dropped on a plate against the formulas of free fall, and the promises of the event stream.
#include "Scene/World/Simulation.h"
#include "DropScene.h"
#include "Scene/PartNames.h"
#include "Scene/SceneFile.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <stdexcept>
#include <tuple>

namespace physvib::simulation_test {

TEST(Simulation, AHitIsFeltOnThePartOfItsFixture) {
    Scene scene = dropScene(1.0);
    EXPECT_EQ(eventsOf(scene, 1.2).at(0).source.part, 0);
    for (BodyDescription& body : scene.bodies)
        for (FixtureDescription& fixture : body.fixtures) fixture.part = "thumb";
    EXPECT_EQ(eventsOf(scene, 1.2).at(0).source.part, partNamed("thumb"));
    SoundNames names;
    scene.bodies[0].fixtures[0].part = "left knee";
    names.addScene(scene);
    EXPECT_EQ(names.parts.nameOf(partNamed("left knee")), "left knee");
}

TEST(Simulation, BouncingBallHitsOncePerBounceThenRestsInSilence) {
    const auto events = eventsOf(dropScene(1.0), 60.0);
    ASSERT_GE(events.size(), 3U);
    EXPECT_LE(events.size(), 12U);
    EXPECT_LT(events.back().timeNs, 5'000'000'000);
    for (std::size_t i = 1; i < events.size(); ++i)
        EXPECT_LT(events[i].source.impulseNewtonSeconds, events[i - 1].source.impulseNewtonSeconds);
}

TEST(Simulation, TwoCamerasEachGetTheirOwnEvent) {
    Scene scene = dropScene(1.0);
    scene.bodies[ballIndex].fixtures[0].isCamera = true;
    const auto events = eventsOf(scene, 0.6);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].source.fixture, plateIndex);
    EXPECT_EQ(events[1].source.fixture, ballIndex);
    EXPECT_EQ(events[1].source.other, plateIndex);
    EXPECT_EQ(events[1].frequencyHz, 205.0);
    EXPECT_EQ(events[1].decayPerSecond, 40.0);
    EXPECT_EQ(events[0].timeNs, events[1].timeNs);
    EXPECT_NEAR(events[1].source.massKg, dropMass, 1.0e-5);
    const double model = 3.0 / (2.0 * 4.0) * events[1].source.impulseNewtonSeconds;
    EXPECT_DOUBLE_EQ(events[1].amplitude, model / (events[1].source.massKg + plateMass));
}

TEST(Simulation, StreamIsSortedAndSettledAtEveryStep) {
    const Scene scene = shakenScene();
    Simulation simulation(scene, 1, 100);
    std::vector<CollisionEvent> events;
    std::int64_t settledBefore = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::size_t known = events.size();
        simulation.step(events);
        for (std::size_t j = known; j < events.size(); ++j) {
            EXPECT_GE(events[j].timeNs, settledBefore);
            EXPECT_LT(events[j].timeNs, simulation.settledNs());
            EXPECT_TRUE(isPlayable(events[j]));
        }
        settledBefore = simulation.settledNs();
        EXPECT_EQ(simulation.timeNs(), (i + 1) * 10'000'000LL);
    }
    const auto isBefore = [](const CollisionEvent& a, const CollisionEvent& b) {
        return std::tie(a.timeNs, a.source.fixture) < std::tie(b.timeNs, b.source.fixture);
    };
    EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), isBefore));
    EXPECT_GT(events.size(), 100U);
    EXPECT_EQ(simulation.drops(), 0U);
}

TEST(Simulation, SameSeedRepeatsEveryBitAndAnotherSeedDiffers) {
    const Scene scene = shakenScene();
    const auto first = eventsOf(scene, 20.0, 100, 7);
    EXPECT_EQ(first, eventsOf(scene, 20.0, 100, 7));
    EXPECT_NE(first, eventsOf(scene, 20.0, 100, 8));
}

TEST(Simulation, SeedZeroStartsExactlyAsDescribedAndOthersWithinAMillimetre) {
    const Scene scene = dropScene(1.0);
    EXPECT_EQ(Simulation(scene, 0, 100).pose(ballIndex).xMetres, 1.7F);
    const double moved = Simulation(scene, 5, 100).pose(ballIndex).xMetres - 1.7F;
    EXPECT_NE(moved, 0.0);
    EXPECT_LE(std::abs(moved), 1.001e-3);
    EXPECT_EQ(Simulation(scene, 5, 100).pose(plateIndex).xMetres, 2.0);
}

TEST(Simulation, ChangedGravityWakesSleepingBodies) {
    Scene scene = dropScene(0.1);
    scene.bodies[ballIndex].positionMetres.x = 2.0;
    scene.script = {{20.0, 1, 0.0, GravityAction{{5.0, -dropGravity}}}};
    Simulation simulation(scene, 0, 100);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 2000; ++i) simulation.step(events);
    EXPECT_NEAR(simulation.pose(ballIndex).xMetres, 2.0, 1.0e-3);
    for (int i = 0; i < 50; ++i) simulation.step(events);
    EXPECT_GT(simulation.pose(ballIndex).xMetres, 2.2);
}

TEST(Simulation, SmallFastBodiesDoNotPassThroughMovingOnes) {
    Scene scene = dropScene(1.0);
    const auto box = [](double width, double height) -> std::vector<FixtureDescription> {
        return {{BoxShape{width, height}, {}, 0.0, 0, true}};
    };
    scene.bodies[ballIndex].fixtures[0].shape = CircleShape{0.03};
    scene.bodies[plateIndex] = {"shelf", BodyType::dynamicBody, box(2.4, 0.1), {2.0, 1.05}};
    scene.bodies.push_back({"left support", BodyType::staticBody, box(0.2, 1.0), {1.0, 0.5}});
    scene.bodies.push_back({"right support", BodyType::staticBody, box(0.2, 1.0), {3.0, 0.5}});
    scene.bodies[2].massKg = scene.bodies[3].massKg = plateMass;
    scene.gravityMetresPerSecond2 = {0.0, -100.0};
    for (double height = 8.0; height < 8.4; height += 0.1) { // 40 m/s, 0.4 m per step
        scene.bodies[ballIndex].positionMetres = {2.0, height};
        Simulation simulation(scene, 0, 100);
        std::vector<CollisionEvent> events;
        for (int i = 0; i < 60; ++i) {
            simulation.step(events);
            ASSERT_GT(simulation.pose(ballIndex).yMetres, 1.0) << height;
        }
    }
}

TEST(Simulation, CameraSwitchedOnLaterFeelsFromThenOn) {
    Scene scene = dropScene(1.0);
    scene.bodies[plateIndex].fixtures[0].isCamera = false;
    const auto all = eventsOf(dropScene(1.0), 3.0);
    ASSERT_GE(all.size(), 3U);
    const double between = 0.5e-9 * static_cast<double>(all[0].timeNs + all[1].timeNs);
    const double beyond = 0.5e-9 * static_cast<double>(all[1].timeNs + all[2].timeNs);
    scene.script = {{between, 1, 0.0, CameraAction{"plate", 0, true}},
                    {beyond, 1, 0.0, CameraAction{"plate", everyFixture, false}}};
    EXPECT_EQ(eventsOf(scene, 3.0), (std::vector{all[1]}));
}

TEST(Simulation, ChangedMaterialIsHeardInTheNextHit) {
    Scene scene = dropScene(1.0);
    scene.materials.push_back({"glass", 2500.0, 0.5, 0.5, 1200.0, 15.0});
    const auto before = eventsOf(scene, 3.0);
    const double between = 0.5e-9 * static_cast<double>(before[0].timeNs + before[1].timeNs);
    scene.script = {{between, 1, 0.0, MaterialAction{"plate", 0, 2}}};
    const auto events = eventsOf(scene, 3.0);
    ASSERT_EQ(events.size(), before.size());
    EXPECT_EQ(events[0].frequencyHz, 80.0);
    EXPECT_EQ(events[1].frequencyHz, 1200.0);
    EXPECT_EQ(events[1].decayPerSecond, 15.0);
}

TEST(Simulation, NormalisationMayBeGiven) {
    Scene scene = dropScene(1.0);
    scene.normalisation = {0.25, 30.0};
    const auto hit = eventsOf(scene, 1.0).at(0);
    EXPECT_DOUBLE_EQ(hit.amplitude, 3.0 * 0.25 * hit.source.impulseNewtonSeconds / (plateMass + 30.0));
}

TEST(Simulation, SpawnedBodiesStrikeUnderTheirOwnNumbers) {
    Scene scene = dropScene(1.0);
    BodyDescription stone = scene.bodies[ballIndex];
    stone.name = "stone";
    stone.positionMetres = {1.0, 1.45};
    scene.script = {{1.0, 3, 0.2, SpawnAction{stone, {0.7, 0.0}}}};
    scene.bodies.pop_back();
    std::vector<int> strikers;
    for (const CollisionEvent& event : eventsOf(scene, 1.95)) strikers.push_back(event.source.other);
    EXPECT_EQ(strikers, (std::vector{1, 2, 3}));
}

TEST(Simulation, RefusesAnInvalidSceneAndStepRate) {
    Scene scene = dropScene(1.0);
    EXPECT_THROW(Simulation(scene, 0, 0), std::invalid_argument);
    EXPECT_THROW(Simulation(scene, 0, 10'001), std::invalid_argument);
    scene.bodies[ballIndex].fixtures[0].shape = CircleShape{-1.0};
    EXPECT_THROW(Simulation(scene, 0, 100), std::invalid_argument);
}

// What becomes of a scene's contacts is counted while it runs.

TEST(SceneCounts, AreThoseOfItsEventsAndItsContacts) {
    const SceneEvents made = simulateScene(builtInScenes().front(), {}, 5'000'000'000);
    EXPECT_GE(made.counts.events, made.events.size()); // those of the last step are still to come
    EXPECT_LE(made.counts.events, made.events.size() + 20);
    EXPECT_GT(made.events.size(), 20U);
    EXPECT_GT(made.counts.contacts, made.counts.withoutSource);
    EXPECT_EQ(made.counts.dropped, 0U);
    EXPECT_EQ(made.counts.muted, 0U);
    // or 1.5 steps of the gravity that there is while the box is shaken
    EXPECT_GE(made.counts.thresholdMetresPerSecond, 0.15);
    EXPECT_LE(made.counts.thresholdMetresPerSecond, 1.5 * 0.01 * 25.0);
}

} // namespace physvib::simulation_test
