// SPDX-License-Identifier: MIT
// What hands did becomes a script: the scene that is saved gives the events of the take, to the bit.
#include "DropScene.h"
#include "Scene/Drawing/RecordedInputs.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneWorld.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace physvib::hand_script_test {

constexpr int stepsPerSecond = 100;

/// A live take: each input acts in the step after those before it.
struct Take {
    std::shared_ptr<const Scene> scene;
    Simulation world;
    InputCheck check;
    std::vector<CollisionEvent> events;

    explicit Take(Scene recordedIn)
        : scene{std::make_shared<const Scene>(std::move(recordedIn))}
        , world{*scene, 1, stepsPerSecond}
        , check{*scene} {}
    void steps(int count) {
        for (int i = 0; i < count; ++i) world.step(events);
    }
    void act(const Action& action) {
        ASSERT_EQ(check.accept(action), "");
        world.addInput(1e-9 * static_cast<double>(world.timeNs()), action);
    }
    SceneRun log() const { return {0, world.timeNs(), 1, scene, world.scene().inputs, {}}; }
};

std::vector<CollisionEvent> eventsOf(const Scene& scene, std::int64_t untilNs) {
    Simulation world{scene, 1, stepsPerSecond};
    std::vector<CollisionEvent> events;
    while (world.timeNs() < untilNs) world.step(events);
    return events;
}

/// As a hand plays: tilts, drags, and holds a body for a while.
void play(Take& take, const std::string& body, std::uint32_t seed, int steps) {
    std::mt19937 random{seed};
    const auto draw = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random() % 1000) / 1000.0;
    };
    take.steps(3);
    for (int done = 0; done < steps;) {
        const int what = static_cast<int>(random() % 3);
        if (what == 0)
            take.act(TiltAction{draw(-1.5, 1.5)});
        else if (what == 1)
            take.act(ImpulseAction{body, {draw(-80.0, 80.0), draw(-80.0, 80.0)}, Vector{0.01, 0.02}});
        else {
            for (int k = 0; k < 20; ++k) {
                take.act(GripAction{body, Vector{draw(0.2, 3.0), draw(0.2, 3.0)}, Vector{0.0, 0.02}, 0.02});
                take.steps(1);
            }
            if (random() % 4 != 0) take.act(GripAction{body, {}, {}}); // else it is held on
        }
        const int on = 1 + static_cast<int>(random() % 40);
        take.steps(on);
        done += on + (what == 2 ? 20 : 0);
    }
}

void recordsWhatIsFelt(const char* name, const std::string& body, int steps) {
    SCOPED_TRACE(name);
    Take take{sceneToRecord(*findBuiltInScene(name))};
    play(take, body, 7, steps);
    const RecordedInputs hands = recordedInputs(take.log());
    EXPECT_GT(hands.inputs.size(), 10U);
    const Scene scene = sceneWithInputs(*take.scene, hands, {0.0, hands.lengthSeconds, false});
    EXPECT_EQ(validate(scene), "");
    const auto read = readScene(sceneJson(scene), "own.json");
    ASSERT_TRUE(read) << read.error;
    const auto events = eventsOf(read.value, take.world.timeNs());
    EXPECT_GT(events.size(), 20U);
    EXPECT_TRUE(events == take.events) << events.size() << " for " << take.events.size();
}

TEST(HandScript, ASavedRecordingGivesTheEventsOfTheTakeToTheBit) {
    recordsWhatIsFelt("shake-the-box", "large rubber ball", 600);
    recordsWhatIsFelt("marbles", findBuiltInScene("marbles")->bodies.back().name, 400);
}

TEST(HandScript, WhatAPlayerDoesIsRecordedBesideTheRestOfTheScript) {
    const Scene basket = sceneToRecord(*findBuiltInScene("fruit-basket"));
    ASSERT_FALSE(basket.script.empty()) << "fruits fall";
    ASSERT_GT(basket.scriptPeriodSeconds, 0.0);
    std::string player;
    for (const BodyDescription& body : basket.bodies)
        if (body.type == BodyType::kinematicBody) player = body.name;
    Take take{basket};
    take.steps(5);
    for (int k = 0; k < 12; ++k) {
        take.act(VelocityAction{player, {k % 2 == 0 ? 2.0 : -2.0, 0.0}, 0.0});
        take.steps(80);
    }
    const RecordedInputs hands = recordedInputs(take.log());
    EXPECT_EQ(hands.lengthSeconds, 9.65);
    const Scene scene = sceneWithInputs(basket, hands, {0.0, hands.lengthSeconds, true});
    EXPECT_EQ(scene.scriptPeriodSeconds, basket.scriptPeriodSeconds) << "the rest goes on as it did";
    EXPECT_TRUE(eventsOf(scene, take.world.timeNs()) == take.events);
    take.steps(2000);
    EXPECT_EQ(recordedInputs(take.log()).lengthSeconds, basket.scriptPeriodSeconds)
        << "then the script begins again";
}

TEST(HandScript, AnEditEndsTheRecording) {
    Take take{sceneToRecord(*findBuiltInScene("shake-the-box"))};
    take.steps(10);
    take.act(TiltAction{0.5});
    take.steps(20);
    take.act(RemoveAction{"large rubber ball"});
    take.steps(20);
    take.act(TiltAction{-0.5});
    take.steps(20);
    const RecordedInputs hands = recordedInputs(take.log());
    ASSERT_EQ(hands.inputs.size(), 1U);
    EXPECT_EQ(hands.lengthSeconds, 0.3);
}

TEST(HandScript, ATrimKeepsHowTheDeviceWasHeldAndLetsGoOfWhatIsHeld) {
    const Scene scene = sceneToRecord(*findBuiltInScene("shake-the-box"));
    const RecordedInputs hands{{{0.5, TiltAction{0.3}},
                                {1.0, TiltAction{0.6}},
                                {1.5, ImpulseAction{"large rubber ball", {1.0, 0.0}, {}}},
                                {2.0, GripAction{"large rubber ball", Vector{1.0, 1.0}, {}, 0.02}},
                                {3.0, GripAction{"large rubber ball", {}, {}}}},
                               4.0};
    const RecordedInputs part = trimmedInputs(scene, hands, {1.6, 2.5, false});
    ASSERT_EQ(part.inputs.size(), 3U);
    EXPECT_EQ(part.inputs[0], (LiveInput{0.0, TiltAction{0.6}}));
    EXPECT_NEAR(part.inputs[1].timeSeconds, 0.4, 1e-12);
    EXPECT_EQ(part.inputs[2].action, (Action{GripAction{"large rubber ball", {}, {}}})) << "lets go";
    EXPECT_NEAR(part.inputs[2].timeSeconds, 0.9, 1e-12);
    EXPECT_EQ(trimmedInputs(scene, hands, {0.0, 4.0, false}), hands) << "nothing is cut";
    const Scene again = sceneWithInputs(scene, hands, {1.6, 2.5, true});
    EXPECT_NEAR(again.scriptPeriodSeconds, 0.9, 1e-12);
    EXPECT_EQ(validate(again), "");
    EXPECT_EQ(sceneToRecord(again), scene) << "another recording takes its place";
}

TEST(HandScript, OfTiltAndGravityATrimStartsWithTheLater) {
    const Scene scene = sceneToRecord(*findBuiltInScene("shake-the-box"));
    const Action tilt = TiltAction{0.3}, gravity = GravityAction{{0.0, -1.6}};
    for (const auto& [before, later] : {std::pair{tilt, gravity}, {gravity, tilt}}) {
        const RecordedInputs hands{{{0.5, before}, {1.0, later}}, 4.0};
        EXPECT_EQ(trimmedInputs(scene, hands, {1.6, 2.5, false}).inputs,
                  (std::vector<LiveInput>{{0.0, later}}));
    }
}

TEST(HandScript, ATrimStartsWithEveryStateThatLasts) {
    Scene scene = sceneToRecord(*findBuiltInScene("shake-the-box"));
    for (const auto& [name, type] : {std::pair{"lift", BodyType::kinematicBody},
                                     {"belt", BodyType::kinematicBody},
                                     {"ball", BodyType::dynamicBody}}) {
        scene.bodies.push_back(scene.bodies.back());
        scene.bodies.back().name = name, scene.bodies.back().type = type;
    }
    const auto states = [](double value) {
        return std::vector<Action>{TiltAction{value},
                                   HoldAction{1.0, value},
                                   MotorAction{"arm", value, {}},
                                   MotorAction{"wheel", value, 2.0 * value},
                                   VelocityAction{"belt", {value, 0.0}},
                                   VelocityAction{"lift", {0.0, value}}};
    };
    RecordedInputs hands{{{0.1, MotorAction{"arm", 0.0, 9.0}}}, 4.0};
    for (const double value : {0.5, 1.0}) {
        for (const Action& action : states(value)) hands.inputs.push_back({value, action});
        hands.inputs.push_back({value, VelocityAction{"ball", {value, 0.0}}}); // until it hits something
    }
    std::vector<LiveInput> expected;
    for (const Action& action : states(1.0)) expected.push_back({0.0, action});
    std::get<MotorAction>(expected[2].action).maxTorqueNewtonMetres = 9.0; // as it was set before
    EXPECT_EQ(trimmedInputs(scene, hands, {1.6, 2.5, false}).inputs, expected);
    EXPECT_EQ(trimmedInputs(scene, hands, {1.0, 2.5, false}).inputs.size(), 2 * expected.size() + 1)
        << "what comes when it starts is in it as well";
    EXPECT_EQ(trimmedInputs(scene, hands, {3.0, 9.0, false}).lengthSeconds, 1.0) << "not beyond its end";
}

TEST(HandScript, AScriptIsFullBeforeASceneIs) {
    Take take{sceneToRecord(*findBuiltInScene("shake-the-box"))};
    take.steps(1);
    SceneRun log = take.log();
    for (std::size_t k = 0; k < 2 * sceneLimits::maxInputs; ++k)
        log.inputs.push_back(
            {0.01 * static_cast<double>(k + 1), TiltAction{0.001 * static_cast<double>(k % 100)}});
    log.worldEndNs = 1'000'000'000'000;
    const RecordedInputs hands = recordedInputs(log);
    EXPECT_LT(hands.inputs.size(), sceneLimits::maxInputs);
    EXPECT_EQ(hands.lengthSeconds, log.inputs[hands.inputs.size()].timeSeconds) << "up to what found no room";
    EXPECT_EQ(validate(sceneWithInputs(*log.scene, hands, {0.0, hands.lengthSeconds, false})), "");
}

// A hand that holds a body: where it pulls it, how evenly, how hard at most, and what ends it.

/// A ball of 8.5 kg and a box of 40 kg, far above a plate, without weight.
Scene weightless() {
    Scene scene = dropScene(1.0);
    scene.gravityMetresPerSecond2 = {};
    scene.bodies.push_back({"box", BodyType::dynamicBody, {{BoxShape{0.4, 0.1}, {}, 0.0, 0}}, {3.0, 2.0}});
    return scene;
}

class Held {
public:
    explicit Held(Scene scene)
        : world{scene, 0, 100} {
        EXPECT_EQ(validate(scene), "");
    }
    void run(double seconds) {
        for (int i = 0; i < static_cast<int>(100.0 * seconds + 0.5); ++i) world.step(events);
    }
    void act(Action action) { world.addInput(0.0, std::move(action)); }
    /// m/s in the last step of the next `seconds`.
    Vector speedAfter(double seconds, std::size_t body) {
        run(seconds - 0.01);
        const BodyPose before = world.pose(body);
        run(0.01);
        return {100.0 * (world.pose(body).xMetres - before.xMetres),
                100.0 * (world.pose(body).yMetres - before.yMetres)};
    }
    Simulation world;
    std::vector<CollisionEvent> events;
};

constexpr std::size_t box = 2;

TEST(SceneGrips, AHandTakesABodyWhereItGoes) {
    Held held{weightless()};
    held.act(GripAction{"ball", Vector{3.0, 1.0}, {}, 1.0});
    held.act(GripAction{"box", Vector{1.0, 3.0}, Vector{0.2, 0.0}, 0.0});
    held.run(3.0);
    EXPECT_NEAR(held.world.pose(ballIndex).xMetres, 3.0, 1e-3);
    EXPECT_NEAR(held.world.pose(ballIndex).yMetres, 1.0, 1e-3);
    const BodyPose pose = held.world.pose(box);
    EXPECT_NEAR(pose.xMetres + 0.2 * std::cos(pose.angleRadians), 1.0, 5e-3) << "it is held at its end";
    EXPECT_NEAR(pose.yMetres + 0.2 * std::sin(pose.angleRadians), 3.0, 5e-3);
}

TEST(SceneGrips, AHandGoesStraightAndEvenlyAndTurnsWithoutAStop) {
    Held held{weightless()};
    const double x = held.world.pose(ballIndex).xMetres, y = held.world.pose(ballIndex).yMetres;
    held.act(GripAction{"ball", Vector{x + 2.0, y}, {}, 2.0});
    EXPECT_NEAR(held.speedAfter(1.0, ballIndex).x, 1.0, 0.01);
    held.act(GripAction{"ball", Vector{x + 1.0, y + 0.5}, {}, 0.5}); // it is at x + 1
    const Vector turned = held.speedAfter(0.5, ballIndex);
    EXPECT_NEAR(turned.x, 0.0, 0.1);
    EXPECT_NEAR(turned.y, 1.0, 0.1);
}

TEST(SceneGrips, AHandPullsByTenWeightsAtMostWhateverTheMass) {
    for (const char* name : {"ball", "box"}) {
        Held held{weightless()};
        held.act(GripAction{name, Vector{1000.0, 2.0}, {}, 0.0});
        EXPECT_NEAR(held.speedAfter(0.1, name == std::string{"ball"} ? ballIndex : box).x,
                    0.1 * sceneLimits::maxGripMetresPerSecond2, 0.6)
            << name;
    }
}

TEST(SceneGrips, WhatIsLetGoGoesOn) {
    Held held{weightless()};
    held.act(GripAction{"ball", Vector{3.7, 1.45}, {}, 2.0});
    held.run(1.0);
    held.act(GripAction{"ball", {}, {}});
    held.act(GripAction{"ball", {}, {}}); // once is enough
    const Vector speed = held.speedAfter(0.5, ballIndex), later = held.speedAfter(0.2, ballIndex);
    EXPECT_EQ(speed, later);
    EXPECT_NEAR(speed.x, 1.0, 0.02);
}

TEST(SceneGrips, ABodyThatIsRemovedOrStartsAnewIsLetGo) {
    Scene scene = weightless();
    const BodyDescription stone{"stone", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1}}, {1.0, 3.0}};
    scene.script = {{0.0, 1, 0.0, SpawnAction{stone, {}}},
                    {0.1, 1, 0.0, GripAction{"stone", Vector{3.0, 3.0}, {}, 0.0}}};
    scene.scriptPeriodSeconds = 2.0;
    Held held{scene};
    held.run(1.9);
    EXPECT_NEAR(held.world.pose(3).xMetres, 3.0, 0.01);
    held.run(0.19); // it starts anew at 2 s, and is held again at 2.1 s
    EXPECT_EQ(held.world.pose(3).xMetres, 1.0);

    held.act(SpawnAction{{"coin", BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1}}, {1.0, 2.5}}, {}});
    held.act(GripAction{"coin", Vector{2.0, 2.5}, {}, 0.5});
    held.run(0.2);
    held.act(RemoveAction{"coin"});
    held.act(GripAction{"coin", Vector{1.0, 1.0}, {}, 0.5}); // nothing happens
    held.run(2.0);                                           // it is destroyed meanwhile
    EXPECT_EQ(held.world.bodiesInBox2d(), 4U);
}

TEST(SceneGrips, WhatDoesNotMoveByForcesDoesNotNotice) {
    Held held{dropScene(1.0)};
    held.act(GripAction{"plate", Vector{0.0, 0.0}, {}, 0.0});
    held.run(0.5);
    EXPECT_EQ(held.world.pose(plateIndex).xMetres, 2.0);
    InputCheck check{dropScene(1.0)};
    EXPECT_EQ(check.accept(GripAction{"nobody", Vector{}, {}}),
              "body: expected the name of a body, found \"nobody\"");
    EXPECT_EQ(check.accept(GripAction{"ball", Vector{1e4, 0.0}, {}}),
              "to_m[0]: expected -1000 to 1000, found 10000");
    EXPECT_EQ(check.accept(GripAction{"ball", Vector{}, {}, -1.0}), "over_s: expected 0 to 86400, found -1");
}

TEST(SceneGrips, ScrapingIsFeltAndATextureMakesASurfaceRough) {
    Scene scene = dropScene(0.01);
    Held held{scene};
    held.run(1.0);
    const auto slides = [&] {
        return std::ranges::count_if(
            held.events, [](const CollisionEvent& e) { return e.source.kind != ContactKind::hit; });
    };
    held.act(GripAction{"ball", Vector{2.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_EQ(slides(), 0) << "smooth";
    held.act(TextureAction{0, 0.005});
    held.act(GripAction{"ball", Vector{1.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_GT(slides(), 100) << "1 m of grains of 5 mm";
    held.act(TextureAction{0});
    held.run(0.2);
    held.events.clear();
    held.act(GripAction{"ball", Vector{2.5, 0.44}, Vector{0.0, 0.1}, 0.5});
    held.run(0.7);
    EXPECT_EQ(slides(), 0) << "smooth again";
}

} // namespace physvib::hand_script_test
