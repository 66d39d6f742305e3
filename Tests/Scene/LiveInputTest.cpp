// SPDX-License-Identifier: MIT
// Inputs while the world runs: they act when they should, are checked first, and a world with them in its
// scene does the same again to the bit.
#include "DropScene.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/Simulation.h"
#include <gtest/gtest.h>
#include <random>

namespace physvib::live_input_test {

BodyDescription stone(const std::string& name, Vector at = {1.0, 1.0}) {
    return {name, BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1, true}}, at};
}

Action anyInput(std::mt19937& random, int& stones) {
    const auto some = [&](double reach) { return (static_cast<double>(random()) * 0x1p-31 - 1.0) * reach; };
    const std::string ball = "ball " + std::to_string(random() % 10);
    switch (random() % 11) {
    case 0: return GravityAction{{some(10.0), some(10.0)}};
    case 1: return TiltAction{some(3.0)};
    case 2: return VelocityAction{ball, {some(5.0), some(5.0)}, some(3.0)};
    case 3:
        return SpawnAction{stone("stone " + std::to_string(stones++), {2.0 + some(1.0), 2.0 + some(1.0)}),
                           {}};
    case 4:
        if (stones == 0) return TiltAction{};
        return RemoveAction{"stone " + std::to_string(random() % static_cast<unsigned>(stones))};
    case 5: return CameraAction{ball, everyFixture, random() % 2 == 0};
    case 6: return MaterialAction{ball, 0, static_cast<int>(random() % 2)};
    case 7: return SoundAction{static_cast<int>(random() % 2), 100.0 + some(50.0), 50.0 + some(20.0)};
    case 8:
        return TextureAction{static_cast<int>(random() % 2), 0.005 + 0.001 * some(4.0), 1.0 + some(1.0),
                             static_cast<GrainPattern>(random() % 2)};
    case 9:
        return random() % 4 == 0 ? GripAction{ball, {}, {}}
                                 : GripAction{ball, Vector{2.0 + some(2.0), 2.0 + some(2.0)},
                                              Vector{some(0.1), some(0.1)}, 0.1 + some(0.1)};
    default: return ImpulseAction{ball, {some(20.0), some(20.0)}, Vector{some(0.1), some(0.1)}};
    }
}

TEST(LiveInputs, AWorldWithThemInItsSceneDoesTheSameAgain) {
    constexpr int stepsPerSecond = 100, steps = 3000;
    const Scene scene = shakenScene();
    Simulation live(scene, 3, stepsPerSecond);
    InputCheck check(scene);
    std::mt19937 random(1);
    std::vector<CollisionEvent> events;
    for (int step = 0, stones = 0; step < steps; ++step) {
        for (int i = static_cast<int>(random() % 4); i < 2; ++i) { // none, one or two
            const Action action = anyInput(random, stones);
            ASSERT_EQ(check.accept(action), "");
            const double delay = 0.001 * static_cast<double>(random() % 30);
            live.addInput(static_cast<double>(live.timeNs()) * 1e-9 + delay, action);
        }
        live.step(events);
    }
    EXPECT_GT(events.size(), 1000U);
    ASSERT_GT(live.scene().inputs.size(), 2000U);

    Simulation again(live.scene(), 3, stepsPerSecond);
    std::vector<CollisionEvent> same;
    for (int step = 0; step < steps; ++step) again.step(same);
    ASSERT_EQ(same.size(), events.size());
    EXPECT_TRUE(same == events);
    ASSERT_EQ(again.bodyCount(), live.bodyCount());
    for (std::size_t i = 0; i < live.bodyCount(); ++i) {
        EXPECT_EQ(again.pose(i).xMetres, live.pose(i).xMetres);
        EXPECT_EQ(again.pose(i).isPresent, live.pose(i).isPresent);
    }
    EXPECT_EQ(posesAt(live.scene(), {3, stepsPerSecond}, 1'000'000'000).bodies.size(),
              allBodies(live.scene()).size());
}

TEST(LiveInputs, ActInTheFirstStepAtOrAfterTheirTime) {
    Scene scene = dropScene(1.0);
    scene.gravityMetresPerSecond2 = {};
    Simulation world(scene, 0, 100);
    std::vector<CollisionEvent> events;
    world.addInput(0.055, VelocityAction{"ball", {1.0, 0.0}, 0.0});
    const double start = world.pose(ballIndex).xMetres;
    for (int i = 0; i < 6; ++i) world.step(events);
    EXPECT_EQ(world.pose(ballIndex).xMetres, start);
    world.step(events); // from 0.06 s on
    EXPECT_NEAR(world.pose(ballIndex).xMetres, start + 0.01, 1e-6);
    EXPECT_EQ(world.scene().inputs[0].timeSeconds, 0.06);
    world.addInput(0.0, VelocityAction{"ball", {0.0, 0.0}, 0.0}); // past: now
    EXPECT_EQ(world.scene().inputs[1].timeSeconds, 0.07);
}

TEST(LiveInputs, ASpawnedCameraIsFeltAndASoundChanges) {
    Scene scene = dropScene(1.0);
    scene.bodies[plateIndex].fixtures[0].isCamera = false;
    Simulation world(scene, 5, 1000);
    std::vector<CollisionEvent> events;
    const auto run = [&](int steps) {
        events.clear();
        for (int i = 0; i < steps; ++i) world.step(events);
    };
    world.addInput(0.0, SpawnAction{stone("stone", {2.5, 0.6}), {}});
    run(300);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events[0].frequencyHz, 205.0);
    const double falls = std::sqrt(2 * 0.2 / dropGravity); // from where it was put
    EXPECT_NEAR(static_cast<double>(events[0].timeNs) * 1e-9, falls, 0.002);
    EXPECT_EQ(events[0].source.fixture, 2);
    world.addInput(0.3, SoundAction{1, 150.0, 20.0});
    run(400);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.back().frequencyHz, 150.0);
    EXPECT_EQ(events.back().decayPerSecond, 20.0);
}

TEST(InputCheck, SaysWhatIsWrongAndForgetsIt) {
    InputCheck check(dropScene(1.0));
    const auto isRefused = [&](const Action& action, const char* why) {
        EXPECT_EQ(check.accept(action), why);
    };
    isRefused(ImpulseAction{"bull", {}, {}}, "body: expected the name of a body, found \"bull\"");
    isRefused(ImpulseAction{"ball", {1e12, 0.0}, {}}, "impulse_ns[0]: expected -1e+09 to 1e+09, found 1e+12");
    isRefused(MaterialAction{"ball", 0, 7}, "material: expected one of the 2 materials of the scene");
    isRefused(SpawnAction{stone("ball", {1, 1}), {}},
              "bodies: expected names of their own, found \"ball\" twice");
    isRefused(ImpulseAction{"stone", {}, {}}, "body: expected the name of a body, found \"stone\"");
    EXPECT_EQ(check.accept(SpawnAction{stone("stone", {1, 1}), {}}), "");
    EXPECT_EQ(check.accept(ImpulseAction{"stone", {}, {}}), "");
}

TEST(InputCheck, SpawningAndRemovingGoesOnForMonths) {
    const Scene scene = dropScene(1.0);
    InputCheck check(scene, InputCheck::unlimited);
    Scene whole = scene;
    const auto take = [&](Action action) {
        ASSERT_EQ(check.accept(action), "");
        whole.inputs.push_back({0.0, std::move(action)});
    };
    for (int i = 0; i < 4200; ++i) { // more than a world may hold at once
        const std::string name = "stone " + std::to_string(i % 3000);
        take(SpawnAction{stone(name, {1.0, 1.0}), {}});
        take(CameraAction{name, everyFixture, i % 2 == 0});
        take(TiltAction{0.1});
        take(RemoveAction{name});
        take(RemoveAction{name}); // nothing happens
    }
    EXPECT_EQ(validate(whole), "");
    take(SpawnAction{stone("stone", {1.0, 1.0}), {}});
    EXPECT_EQ(check.accept(SpawnAction{stone("stone", {2.0, 1.0}), {}}),
              "bodies: expected names of their own, found \"stone\" twice");
    EXPECT_EQ(check.accept(ImpulseAction{"stone 5", {}, {}}),
              "body: expected the name of a body, found \"stone 5\"")
        << "gone long ago";
}

TEST(InputCheck, CountsWhatIsThereAtOnce) {
    Scene scene = dropScene(1.0);
    for (int i = 0; i < 5000; ++i)
        scene.inputs.push_back({0.0, SpawnAction{stone("stone " + std::to_string(i), {1.0, 1.0}), {}}});
    EXPECT_EQ(validate(scene), "bodies: expected at most 4096 in all, found 4097");
}

TEST(InputCheck, EndsWithTheLimit) {
    InputCheck check(dropScene(1.0));
    std::string fault;
    int taken = 0;
    for (; fault.empty() && taken < 200'000; ++taken) fault = check.accept(TiltAction{0.0});
    EXPECT_EQ(taken, 100'001);
    EXPECT_EQ(fault, "expected at most 100000 inputs");
}

// What counts towards the limit of live inputs, and what is kept of the earlier ones: bodies that come,
// change and go never make a later input invalid.

/// Takes them one after the other, until an error, which is that of all at once.
std::string takeAll(InputCheck& check, const std::vector<Action>& actions) {
    std::string error, atOnce = InputCheck{check}.accept(actions);
    for (std::size_t i = 0; i < actions.size() && error.empty(); ++i) error = check.accept(actions[i]);
    EXPECT_EQ(error, atOnce);
    return error;
}

TEST(InputCheck, InputsOfTheSceneCountTowardsTheLimit) {
    Scene scene = dropScene(1.0);
    scene.inputs = {{0.0, TiltAction{0.1}}, {0.5, TiltAction{0.2}}};
    InputCheck check(scene, 3);
    EXPECT_EQ(check.accept(TiltAction{0.3}), "");
    EXPECT_EQ(check.accept(TiltAction{0.4}), "expected at most 3 inputs");
}

TEST(InputCheck, RefusedInputsDoNotCount) {
    InputCheck check(dropScene(1.0), 2);
    for (int i = 0; i < 5; ++i) EXPECT_NE(check.accept(RemoveAction{"nobody"}), "");
    EXPECT_NE(check.accept(std::vector<Action>{TiltAction{0.1}, RemoveAction{"nobody"}}), "");
    EXPECT_EQ(takeAll(check, {TiltAction{0.1}, TiltAction{0.2}}), "");
    EXPECT_EQ(check.accept(TiltAction{0.3}), "expected at most 2 inputs");
}

// As many as a file may hold: of what is taken beyond that, the take could not be loaded again.
TEST(InputCheck, AGroupCountsForAllItsInputs) {
    const Action tilt = TiltAction{0.1};
    const std::string fault = "expected at most 6 inputs";
    for (const auto& groups : std::vector<std::vector<std::size_t>>{
             {6}, {1, 5}, {5, 1}, {2, 4}, {3, 3}, {2, 2, 2}, {3, 2, 1}, {1, 1, 1, 1, 1, 1}}) {
        InputCheck check(dropScene(1.0), 6);
        std::size_t left = 6;
        for (const std::size_t size : groups) {
            EXPECT_EQ(check.accept(std::vector(left + 1, tilt)), fault) << left << " left";
            EXPECT_EQ(check.accept(std::vector(size, tilt)), "") << left << " left";
            left -= size;
        }
        EXPECT_EQ(check.accept(tilt), fault) << groups.size() << " groups";
    }
}

TEST(InputCheck, AJointGoesWithABodyThatIsForgotten) {
    InputCheck check(dropScene(1.0), InputCheck::unlimited);
    for (std::size_t i = 0; i < InputCheck::maxRemembered + 20; ++i) {
        const std::string name = "stone " + std::to_string(i);
        const JointDescription pin{"pin " + std::to_string(i), "plate", name, RevoluteJoint{}, false};
        ASSERT_EQ(takeAll(check, {SpawnAction{stone(name), {}}, JoinAction{pin}, RemoveAction{name}}), "")
            << i;
    }
    EXPECT_EQ(check.accept(TiltAction{0.1}), "");
}

TEST(InputCheck, ABodyThatWasSpawnedCanBeSwitchedAndChanged) {
    InputCheck check(dropScene(1.0));
    EXPECT_EQ(takeAll(check, {SpawnAction{stone("stone"), {}}, CameraAction{"stone", everyFixture, false},
                              ChangeAction{stone("stone"), true}, TiltAction{0.1}}),
              "");
}

} // namespace physvib::live_input_test
