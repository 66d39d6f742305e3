// SPDX-License-Identifier: MIT
// What is left of a scene and its tables: an edit that would make it invalid leaves it as it was; a hand does
// not hold who was removed, nor his heir; what was lost is counted; a new layout keeps who plays it.
#include "DropScene.h"
#include "Scene/LayoutFile.h"
#include "Scene/PadFile.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFields.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/Simulation.h"
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <random>
#include <set>

namespace physvib::what_is_left_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BodyDescription stone(const std::string& name = "stone") {
    return {name, BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1}}, {1.0, 3.0}};
}

JointDescription rope(const std::string& name = "rope", const std::string& to = "ball") {
    return {name, "plate", to, WeldJoint{}};
}

template <class Change>
BodyDescription ball(Change change) {
    BodyDescription body = dropScene(1.0).bodies[ballIndex];
    change(body);
    return body;
}

TEST(EditedScenes, AreValidWhateverIsAskedFor) {
    struct Row {
        Action action;
        bool isTaken;
    };
    const std::vector<Row> rows{
        {SpawnAction{stone(), {}}, true},
        {SpawnAction{stone(""), {}}, false},
        {SpawnAction{ball([](BodyDescription& b) { b.name = "new", b.fixtures.clear(); }), {}}, false},
        {RemoveAction{"ball"}, true},
        {RemoveAction{"held"}, false}, // by the joint
        {RemoveAction{"nobody"}, false},
        {CameraAction{"ball", everyFixture, true}, true},
        {CameraAction{"ball", everyFixture, false}, false}, // it is none
        {MaterialAction{"ball", everyFixture, 0}, true},
        {MaterialAction{"ball", everyFixture, -1}, false},
        {MaterialAction{"ball", everyFixture, 2}, false},
        {SoundAction{1, 100.0, 20.0}, true},
        {SoundAction{1, 0.0, 20.0}, true}, // which is silence
        {SoundAction{1, -1.0, 20.0}, false},
        {SoundAction{1, nan, 20.0}, false},
        {SoundAction{1, 100.0, -1.0}, false},
        {TextureAction{1, 0.001}, true},
        {TextureAction{1, -0.001}, false},
        {TextureAction{1, 0.001, -1.0}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.positionMetres.x += 0.1; })}, true},
        {ChangeAction{ball([](BodyDescription& b) { b.positionMetres.x = nan; })}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.positionMetres.y = 1e9; })}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.fixtures.clear(); })}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.fixtures[0].shape = CircleShape{0.0}; })}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.fixtures[0].material = 7; })}, false},
        {ChangeAction{ball([](BodyDescription& b) { b.massKg = -1.0; })}, false},
        {JoinAction{rope()}, true},
        {JoinAction{rope("first")}, false}, // there is one of that name
        {JoinAction{rope("rope", "nobody")}, false},
        {JoinAction{rope("rope", "plate")}, false}, // to itself
        {UnjoinAction{"first"}, true},
        {UnjoinAction{"nothing"}, false}};
    std::set<std::size_t> taken, refused;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Scene scene = dropScene(1.0);
        scene.bodies.push_back(stone("held"));
        scene.joints.push_back(rope("first", "held"));
        ASSERT_EQ(validate(scene), "");
        const Scene before = scene;
        const Action& action = rows[i].action;
        editScene(scene, {&action, 1});
        EXPECT_EQ(validate(scene), "") << actionNames[action.index()] << ", row " << i;
        EXPECT_EQ(scene == before, !rows[i].isTaken) << actionNames[action.index()] << ", row " << i;
        (rows[i].isTaken ? taken : refused).insert(action.index());
    }
    for (std::size_t kind = 0; kind < actionNames.size(); ++kind) {
        bool isLastingKind = false;
        for (const Row& row : rows) isLastingKind = isLastingKind || (row.action.index() == kind);
        EXPECT_EQ(isLastingKind, taken.contains(kind) && refused.contains(kind)) << actionNames[kind];
    }
}

TEST(EditedScenes, AreTheSameOfManyEditsAsOfOneAfterTheOther) {
    std::mt19937 random{1};
    for (int k = 0; k < 300; ++k) {
        Scene one = dropScene(1.0), all = one;
        one.bodies.push_back(stone("1")), one.joints.push_back(rope("rope", "1")), all = one;
        std::vector<Action> actions;
        for (int n = 0; n < 8; ++n) {
            const auto name = std::to_string(random() % 4); // 0 has no shape, the rope holds 1
            BodyDescription body = stone(name);
            if (name == "0") body.fixtures.clear();
            if (random() % 8 == 0) actions.push_back(UnjoinAction{"rope"});
            switch (random() % 3) {
            case 0: actions.push_back(SpawnAction{body, {}}); break;
            case 1: actions.push_back(ChangeAction{body}); break;
            default: actions.push_back(RemoveAction{name});
            }
        }
        for (const Action& action : actions) editScene(one, {&action, 1});
        editScene(all, actions);
        EXPECT_EQ(one, all) << k;
    }
}

TEST(RemovedBodies, AreHeldByNobodyAndNeitherAreTheirHeirs) {
    Scene scene = dropScene(1.0);
    scene.gravityMetresPerSecond2 = {};
    Simulation world{scene, 0, 100};
    std::vector<CollisionEvent> events;
    const auto run = [&](double seconds) {
        for (int i = 0; i < static_cast<int>(100.0 * seconds); ++i) world.step(events);
    };
    std::size_t number = 2;
    for (int round = 0; round < 4; ++round, number += 2) {
        for (const std::string name : {"one", "two"}) {
            BodyDescription body = stone(name);
            body.positionMetres = {1.0, name == "one" ? 2.5 : 3.2};
            world.addInput(0.0, SpawnAction{body, {}});
        }
        world.addInput(0.0, GripAction{"one", Vector{2.0, 2.5}, {}, 0.2});
        if (round % 2 == 0) world.addInput(0.0, GripAction{"two", Vector{2.0, 3.2}, {}, 0.2});
        run(1.0);
        EXPECT_NEAR(world.pose(number).xMetres, 2.0, 0.01) << "round " << round;
        EXPECT_NEAR(world.pose(number + 1).xMetres, round % 2 == 0 ? 2.0 : 1.0, 0.01) << "round " << round;
        world.addInput(0.0, RemoveAction{"two"});
        world.addInput(0.0, RemoveAction{"one"});
        run(3.0); // they are destroyed meanwhile, and their places are used again
    }
}

TEST(DroppedHits, AreCountedByARunOfEveryTake) {
    Scene scene = dropScene(0.02);
    BodyDescription small = scene.bodies[ballIndex];
    scene.bodies.erase(scene.bodies.begin() + ballIndex);
    scene.bodies[plateIndex].fixtures[0].shape = BoxShape{95.0, 0.3};
    small.fixtures[0].shape = CircleShape{0.03};
    for (int i = 0; i < 1100; ++i) {
        small.name = "ball " + std::to_string(i);
        small.positionMetres = {-43.0 + 0.08 * i, 0.3 + 0.03 + 0.02};
        scene.bodies.push_back(small);
    }
    Simulation alone{scene, 1, 100};
    std::vector<CollisionEvent> events;
    while (alone.settledNs() < 150'000'000) alone.step(events);
    ASSERT_GT(alone.drops(), 0U);
    const SceneEvents once = simulateScene(scene, {}, 150'000'000);
    EXPECT_EQ(once.drops, alone.drops());
    const auto shared = std::make_shared<const Scene>(scene);
    const std::vector<SceneRun> takes{{0, alone.timeNs(), 1, shared, {}, {}},
                                      {alone.timeNs(), 0, 1, shared, {}, {}}};
    EXPECT_EQ(simulateRuns(takes, {}, alone.timeNs() + 150'000'000).drops, 2 * alone.drops());
}

/// A layout acts from the first event at its time, a stop at its own, on a controller that is rendered too.
TEST(PadCommands, ControlsActFromTheirOwnNanosecond) {
    ActuatorLayout phone;
    layoutPreset("phone4", phone);
    const PhantomPanner near{phone, PanningLaw::linear, 1.0, 1.0, 1.0},
        far{phone, PanningLaw::linear, 1.0, 10.0, 1.0};
    PadModel law = builtInPads().front().law;
    law.placeWeight = 1.0;
    constexpr std::int64_t at = 500'000'000;
    CollisionEvent hit{.timeNs = at, .frequencyHz = 100.0, .decayPerSecond = 5.0, .amplitude = 0.6};
    hit.x = 0.95, hit.y = 0.5;
    const auto told = [&](const PhantomPanner& first, std::vector<RenderControl> controls) {
        std::string words;
        for (const PadCommand& c : padCommands(law, {&hit, 1}, controls, first, 900'000'000))
            words +=
                std::to_string(c.timeNs) + " " + std::to_string(c.low) + " " + std::to_string(c.high) + "\n";
        return words;
    };
    const std::string nearWords = told(near, {}), farWords = told(far, {});
    ASSERT_NE(nearWords, farWords);
    for (const std::int64_t offset : {-at, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, at / 2}) {
        RenderControl layout;
        layout.kind = RenderControl::Kind::panner;
        layout.timeNs = at + offset;
        layout.panner = &far;
        EXPECT_EQ(told(near, {layout}), offset <= 0 ? farWords : nearWords) << offset;
    }
}

TEST(NewLayouts, KeepTheActuatorsAndTheirFullScales) {
    std::vector<ActuatorDescription> before(4);
    for (std::size_t j = 0; j < before.size(); ++j) {
        before[j].label = "old " + std::to_string(j);
        before[j].actuator = "kind-" + std::to_string(j);
        before[j].fullScaleG = 0.5 + static_cast<double>(j);
        before[j].part = "thumb";
    }
    for (const char* name : {"phone1", "phone2", "phone4", "phone6", "glove5", "vest16"}) {
        ActuatorLayout preset;
        if (!layoutPreset(name, preset)) continue;
        const LayoutDescription plain = presetLayout(name);
        LayoutDescription kept = describeLayout(name, preset);
        copyActuatorProperties(kept, before);
        for (const LayoutDescription& layout : {presetLayout(name, before), kept})
            for (std::size_t j = 0; j < layout.actuators.size(); ++j) {
                const ActuatorDescription& now = layout.actuators[j];
                const ActuatorDescription& expected = j < before.size() ? before[j] : plain.actuators[j];
                EXPECT_EQ(now.actuator, expected.actuator) << name << ' ' << j;
                EXPECT_EQ(now.fullScaleG, expected.fullScaleG) << name << ' ' << j;
                EXPECT_EQ(now.label, plain.actuators[j].label);
                EXPECT_EQ(now.part, plain.actuators[j].part);
            }
    }
}

} // namespace physvib::what_is_left_test
