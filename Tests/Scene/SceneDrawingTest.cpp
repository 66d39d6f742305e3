// SPDX-License-Identifier: MIT
// What is drawn in a world, undone and done again: against snapshots, and against the world that felt it.
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace physvib::scene_drawing_test {

Scene blank() { return newScene(*findBuiltInScene("drop"), SceneGround::floor); }

/// Bodies and joints come back at the end of their lists.
Scene sorted(Scene scene) {
    std::ranges::sort(scene.bodies, {}, &BodyDescription::name);
    std::ranges::sort(scene.joints, {}, &JointDescription::name);
    return scene;
}

/// A world that is drawn in while it runs, as a session's is.
struct Drawn {
    SceneDrawing drawing;
    InputCheck check;
    Simulation world;
    std::vector<CollisionEvent> events;
    std::vector<SceneEdit> done, undone;
    CurrentPose now;

    explicit Drawn(const Scene& scene)
        : drawing{scene}
        , check{scene}
        , world{scene, 1, 100} {}
    std::string act(const Action& action) {
        auto fault = check.accept(action);
        if (!fault.empty()) return fault;
        world.addInput(0.0, action);
        drawing.apply(action);
        return fault;
    }
    std::string run(SceneEdit& edit, bool isForth) {
        std::string fault;
        edit.perform(isForth, drawing, now, [&](std::span<const Action> some) {
            for (const Action& action : some) fault += act(action);
        });
        return fault;
    }
    std::string edit(std::vector<Action> actions) {
        if (auto fault = drawing.check(actions); !fault.empty()) return fault;
        done.emplace_back(std::move(actions));
        undone.clear();
        return run(done.back(), true);
    }
    std::string add(BodyDescription body, const std::string& name) {
        body.name = name;
        return edit({SpawnAction{std::move(body), {}}});
    }
    /// Where it was drawn.
    std::pair<std::string, BodyPlace> where(const std::string& name) const {
        const BodyDescription& body = *drawing.find(name);
        return {name, {body.positionMetres, body.angleRadians}};
    }
    /// Of the last body of that name, as one that is changed has a number of its own.
    std::optional<BodyPose> pose(const std::string& name) const {
        std::optional<BodyPose> last;
        const auto cast = allBodies(world.scene());
        for (std::size_t i = 0; i < cast.size(); ++i)
            if (cast[i].name == name) last = world.pose(i);
        return last;
    }
    CurrentPose poses() const {
        return [this](const std::string& name) { return pose(name); };
    }
    void undo() {
        ASSERT_EQ(run(done.back(), false), "");
        undone.push_back(done.back());
        done.pop_back();
    }
    void redo() {
        ASSERT_EQ(run(undone.back(), true), "");
        done.push_back(undone.back());
        undone.pop_back();
    }
    void steps(int count) {
        for (int i = 0; i < count; ++i) world.step(events);
    }
    /// Names of the bodies that are there in the world.
    std::multiset<std::string> present() const {
        const auto cast = allBodies(world.scene());
        std::multiset<std::string> names;
        for (std::size_t i = 0; i < cast.size(); ++i)
            if (world.pose(i).isPresent) names.insert(cast[i].name);
        return names;
    }
    std::multiset<std::string> drawn() const {
        std::multiset<std::string> names;
        for (const auto& body : drawing.drawn().bodies) names.insert(body.name);
        return names;
    }
};

class Hand {
public:
    Hand(Drawn& drawn, std::uint32_t seed)
        : drawn_{drawn}
        , random_{seed} {}

    std::vector<Action> anything() {
        const auto& drawing = drawn_.drawing;
        switch (drawing.drawn().bodies.size() < 3 ? draw(3) : draw(10)) {
        case 0: return add(makeBall(place(), place()));
        case 1: return add(makeBox(place(), place()));
        case 2:
            return draw(2) == 0 ? add(makeWall(place(), place(), 0.1))
                                : add(makePolygon({place(), place(), place(), place(), place()}));
        case 3: return add(makeLine({place(), place(), place(), place()}, 0.01));
        case 4: return moveActions(drawing, {{any(), {place(), 0.1 * draw(60)}}, {any(), {place(), 0.0}}});
        case 5:
            return {
                changeAction(scaledBody(*drawing.find(any()), 0.5 + 0.1 * draw(10), 0.5 + 0.1 * draw(10)))};
        case 6: return removeActions(drawing, {any(), any()});
        case 7: {
            const std::string a = any(), b = any();
            return joinActions(drawing, static_cast<JointKind>(draw(4)), drawn_.where(a), drawn_.where(b),
                               place(), place())
                .value;
        }
        case 8: {
            std::vector<std::string> names;
            return pasteActions(drawing, copyBodies(drawing, {any(), any()}), {0.2, 0.2}, names);
        }
        default: {
            BodyDescription body = *drawing.find(any());
            const int what = draw(5);
            if (what == 0)
                setMoving(body, draw(2) == 0);
            else if (what == 1)
                setSource(drawing.drawn(), body, draw(2) == 0);
            else if (what == 2)
                setDensity(body, 1.0 + draw(2000));
            else if (what == 3)
                body.fixtures[0].restitution = 0.01 * draw(100);
            else
                body.fixtures[0].material = draw(static_cast<int>(drawing.drawn().materials.size()));
            return {changeAction(std::move(body))};
        }
        }
    }
    int draw(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

private:
    Vector place() {
        const Scene& scene = drawn_.drawing.drawn();
        return {scene.fieldWidthMetres * 0.001 * draw(1000), scene.fieldHeightMetres * 0.001 * draw(1000)};
    }
    std::string any() {
        const auto& bodies = drawn_.drawing.drawn().bodies;
        return bodies[static_cast<std::size_t>(draw(static_cast<int>(bodies.size())))].name;
    }
    std::vector<Action> add(Result<BodyDescription> body) {
        if (!body) return {};
        body.value.name = drawn_.drawing.unusedName("body");
        if (startsAsSource(body.value)) setSource(drawn_.drawing.drawn(), body.value, true);
        return {SpawnAction{body.value, {}}};
    }
    Drawn& drawn_;
    std::mt19937 random_;
};

void drawAtRandom(std::uint32_t seed) {
    SCOPED_TRACE(seed);
    Drawn drawn{blank()};
    Hand hand{drawn, seed};
    std::vector<Scene> model{sorted(drawn.drawing.drawn())}; // after each edit that is done
    std::vector<Scene> ahead;
    int edits = 0;
    while (edits < 200) {
        const int turn = hand.draw(5);
        if (turn == 0 && !drawn.done.empty()) {
            drawn.undo();
            ahead.push_back(model.back());
            model.pop_back();
        } else if (turn == 1 && !drawn.undone.empty()) {
            drawn.redo();
            model.push_back(ahead.back());
            ahead.pop_back();
        } else {
            const auto actions = hand.anything();
            if (actions.empty() || !drawn.edit(actions).empty()) continue;
            model.push_back(sorted(drawn.drawing.drawn()));
            ahead.clear();
            ++edits;
        }
        ASSERT_EQ(sceneJson(sorted(drawn.drawing.drawn())), sceneJson(model.back())) << edits;
        drawn.steps(1);
        ASSERT_EQ(drawn.present(), drawn.drawn()) << edits;
    }
    drawn.steps(100);
    Simulation again{drawn.world.scene(), 1, 100}; // as a render of the session does
    std::vector<CollisionEvent> events;
    while (again.timeNs() < drawn.world.timeNs()) again.step(events);
    EXPECT_TRUE(events == drawn.events) << events.size() << " for " << drawn.events.size();
    EXPECT_EQ(validate(drawn.drawing.drawn()), "");
    while (!drawn.done.empty()) drawn.undo();
    EXPECT_EQ(sceneJson(sorted(drawn.drawing.drawn())), sceneJson(model.front()));
}

TEST(SceneDrawing, WhoHasTurnedForLongComesBackAndWhoFellFarIsAsDrawn) {
    const auto pose = poseWithinLimits({1.0, 2.0, 2202.77});
    EXPECT_NEAR(std::remainder(pose->angleRadians - 2202.77, 2.0 * std::numbers::pi), 0.0, 1e-9);
    EXPECT_LE(std::abs(pose->angleRadians), sceneLimits::maxAngleRadians);
    EXPECT_EQ(poseWithinLimits({1.0, 2.0, -999.0})->angleRadians, -999.0) << "a joint may count its turns";
    EXPECT_FALSE(poseWithinLimits({0.0, -1000.1, 0.0}));
}

TEST(SceneDrawing, TwoHundredEditsAreUndoneDoneAgainAndFeltAgain) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) drawAtRandom(seed);
}

TEST(SceneDrawing, ABodyThatIsChangedGoesOnAsItMoves) {
    Drawn drawn{blank()};
    auto ball = makeBall({1.0, 2.0}, {1.1, 2.0}).value;
    ball.velocityMetresPerSecond = {0.3, 0.0};
    ASSERT_EQ(drawn.add(ball, "ball"), "");
    drawn.steps(20);
    const auto find = [&] { return drawn.world.pose(allBodies(drawn.world.scene()).size() - 1); };
    const BodyPose before = find();
    ASSERT_EQ(drawn.edit({changeAction(scaledBody(*drawn.drawing.find("ball"), 1.5, 1.5))}), "");
    drawn.steps(1);
    EXPECT_NEAR(find().xMetres, before.xMetres + 0.003, 1e-4) << "on with its speed";
    EXPECT_EQ(drawn.drawing.find("ball")->positionMetres, ball.positionMetres)
        << "the scene starts it where it was drawn";
    EXPECT_NEAR(std::get<CircleShape>(drawn.drawing.find("ball")->fixtures[0].shape).radiusMetres, 0.15,
                1e-9);
    ASSERT_EQ(drawn.edit(moveActions(drawn.drawing, {{"ball", {{0.5, 2.0}, 0.0}}})), "");
    drawn.steps(1);
    EXPECT_NEAR(find().xMetres, 0.503, 1e-4);
    drawn.undo();
    drawn.steps(1);
    EXPECT_NEAR(find().xMetres, 1.003, 1e-4) << "back where it was drawn";
}

TEST(SceneDrawing, ASeesawHoldsOnItsPinWhileItIsChanged) {
    Drawn drawn{blank()};
    ASSERT_EQ(drawn.add(makeBox({0.6, 0.9}, {1.8, 1.0}).value, "plank"), "");
    const auto pin = joinActions(drawn.drawing, JointKind::pin, drawn.where("floor"), drawn.where("plank"),
                                 {1.2, 0.95}, {1.2, 0.95});
    ASSERT_TRUE(pin) << pin.error;
    ASSERT_EQ(drawn.edit(pin.value), "");
    const auto height = [&] { return drawn.world.pose(allBodies(drawn.world.scene()).size() - 1).yMetres; };
    drawn.steps(100);
    EXPECT_NEAR(height(), 0.95, 0.01) << "it does not fall";
    ASSERT_EQ(drawn.edit({changeAction(scaledBody(*drawn.drawing.find("plank"), 0.8, 1.0))}), "");
    drawn.steps(100);
    EXPECT_NEAR(height(), 0.95, 0.01) << "nor when it is another size";
    ASSERT_EQ(drawn.edit(moveActions(drawn.drawing, {{"plank", {{1.2, 1.5}, 0.0}}})), "");
    drawn.steps(100);
    EXPECT_NEAR(height(), 1.5, 0.01) << "its pin goes with it";
    drawn.undo();
    drawn.undo();
    drawn.undo();
    drawn.steps(100);
    EXPECT_LT(height(), 0.9) << "without a pin it falls";
}

TEST(SceneDrawing, AHingeKeepsItsLimitsWhileABodyIsChanged) {
    Drawn drawn{blank()};
    ASSERT_EQ(drawn.add(makeBox({1.2, 1.9}, {2.0, 2.0}).value, "arm"), "");
    const RevoluteJoint hinge{{1.2, 1.95}, Interval{-0.1, 0.1}};
    ASSERT_EQ(drawn.edit({JoinAction{{"hinge", "floor", "arm", hinge}}}), "");
    const auto turn = [&] { return drawn.pose("arm")->angleRadians; };
    drawn.steps(100);
    EXPECT_NEAR(turn(), -0.1, 0.02) << "hangs at its limit";
    ASSERT_EQ(drawn.edit({changeAction(scaledBody(*drawn.drawing.find("arm"), 0.9, 1.0))}), "");
    drawn.steps(100);
    EXPECT_NEAR(turn(), -0.1, 0.02);
    for (const double radiansPerSecond : {1.0, 2.0}) { // as a slider is dragged
        const auto motor = motorActions(drawn.drawing, "hinge", {radiansPerSecond, 0.0}, drawn.poses());
        ASSERT_EQ(drawn.edit(motor.value), "");
        drawn.steps(100);
        EXPECT_NEAR(turn(), -0.1, 0.02);
    }
    Simulation saved{drawn.drawing.drawn(), 1, 100};
    for (int i = 0; i < 100; ++i) saved.step(drawn.events);
    EXPECT_NEAR(saved.pose(1).angleRadians, -0.1, 0.02);
}

TEST(SceneDrawing, ASuspendedCarStandsAsHighWhereverTheSliderOfItsMotorStops) {
    for (const auto& travel : {std::optional<Interval>{}, std::optional{Interval{-0.3, 0.3}}}) {
        Drawn drawn{blank()};
        ASSERT_EQ(drawn.add(makeBox({1.0, 0.9}, {2.0, 1.1}).value, "car"), "");
        for (const auto& [wheel, x] : {std::pair{"rear", 1.1}, {"front", 1.9}}) {
            ASSERT_EQ(drawn.add(makeBall({x, 0.5}, {x + 0.2, 0.5}).value, wheel), "");
            const WheelJoint axle{{x, 0.5}, {0.0, 1.0}, 3.0, 0.7, travel};
            ASSERT_EQ(drawn.edit({JoinAction{{std::string{wheel} + " axle", "car", wheel, axle}}}), "");
        }
        drawn.steps(500);
        const double height = drawn.pose("car")->yMetres;
        EXPECT_LT(height, 0.95) << "pressed down by its weight";
        for (const double torque : {1.0, 2.0, 3.0}) {
            const auto motor = motorActions(drawn.drawing, "rear axle", {0.0, torque}, drawn.poses());
            ASSERT_EQ(drawn.edit(motor.value), "");
            drawn.steps(500);
            EXPECT_NEAR(drawn.pose("car")->yMetres, height, 0.005) << torque;
        }
    }
}

TEST(SceneDrawing, AJointGoesOnAsItWasWhileABodyIsChanged) {
    const Vector left{1.2, 1.95}, middle{1.6, 1.95}, right{2.0, 1.95}, above{1.6, 2.2}, below{1.65, 1.5};
    const std::vector<Joint> joints{RevoluteJoint{left, Interval{-0.1, 0.3}},
                                    RevoluteJoint{right, Interval{-0.3, 0.1}},
                                    RevoluteJoint{middle, {}, 3.0, 1000.0},
                                    WheelJoint{left, {0.3, 1.0}, 1.5, 0.1, Interval{-0.1, 0.2}, 3.0, 1000.0},
                                    WheelJoint{middle, {0.3, 1.0}, 0.0, 0.0, Interval{-0.1, 0.2}},
                                    DistanceJoint{above, middle, 2.0, 0.1},
                                    DistanceJoint{above, left, 0.0, 0.0, true},
                                    DistanceJoint{below, middle},
                                    WeldJoint{left, 2.0, 0.1},
                                    SliderJoint{middle, {0.3, 1.0}, Interval{-0.1, 0.1}, 0.4, 5000.0},
                                    SliderJoint{middle, {0.0, 1.0}}}; // falls on the floor
    for (std::size_t k = 0; k < joints.size(); ++k)
        for (const char* changed : {"arm", "floor"}) {
            SCOPED_TRACE("joint " + std::to_string(k) + ", changed: " + changed);
            Drawn drawn{blank()}, unchanged{blank()};
            auto box = makeBox({1.2, 1.9}, {2.0, 2.0}).value;
            box.angleRadians = 0.3;
            for (Drawn* each : {&drawn, &unchanged}) {
                ASSERT_EQ(each->add(box, "arm"), "");
                ASSERT_EQ(each->edit({JoinAction{{"joint", "floor", "arm", joints[k], true}}}), "");
                each->steps(20);
            }
            ASSERT_EQ(drawn.edit({changeAction(*drawn.drawing.find(changed))}), "");
            for (int i = 0; i < 8; ++i) {
                drawn.steps(10), unchanged.steps(10);
                const BodyPose now = *drawn.pose("arm"), expected = *unchanged.pose("arm");
                ASSERT_NEAR(now.xMetres, expected.xMetres, 1e-3);
                ASSERT_NEAR(now.yMetres, expected.yMetres, 1e-3);
                ASSERT_NEAR(now.angleRadians, expected.angleRadians, 1e-3);
            }
        }
}

TEST(SceneDrawing, AMotorThatIsDrawnInGoesAtTheScriptsPace) {
    for (const Joint& joint : {Joint{RevoluteJoint{{1.6, 1.95}, {}, 0.2, 1000.0}},
                               Joint{SliderJoint{{1.6, 1.95}, {1.0, 0.0}, {}, 0.2, 1000.0}}}) {
        Drawn drawn{blank()};
        ASSERT_EQ(drawn.add(makeBox({1.2, 1.9}, {2.0, 2.0}).value, "arm"), "");
        drawn.world.addPace({0.0, 0.0, 0.5});
        drawn.steps(1);
        ASSERT_EQ(drawn.edit({JoinAction{{"joint", "floor", "arm", joint}}}), "");
        const auto movedIn = [&](int steps) { // radians or metres
            const auto sum = [](const BodyPose& pose) { return pose.xMetres + pose.angleRadians; };
            const double before = sum(drawn.world.pose(1));
            drawn.steps(steps);
            return sum(drawn.world.pose(1)) - before;
        };
        EXPECT_NEAR(movedIn(100), 0.1, 0.002);
        drawn.world.addPace({1.0, 0.5, 1.0});
        drawn.steps(1);
        EXPECT_NEAR(movedIn(100), 0.2, 0.002);
    }
}

struct Car : testing::Test {
    Drawn drawn{blank()};
    const Vector pin{1.2, 1.7}, top{1.5, 1.95};
    void SetUp() override {
        ASSERT_EQ(drawn.add(makeBox({1.0, 1.9}, {2.0, 2.0}).value, "car"), "");
        ASSERT_EQ(drawn.add(makeBall(pin, {1.3, 1.7}).value, "wheel"), "");
    }
    std::string join(const Joint& joint, const char* a = "car", const char* name = "joint") {
        return drawn.edit({JoinAction{{name, a, "wheel", joint}}});
    }
    static std::optional<BodyPose> pose(const std::string& body) {
        using std::numbers::pi;
        return body == "car" ? BodyPose{2.0, 1.0, 0.5 * pi} : BodyPose{2.15, 0.7, pi}; // 0.1 m sprung
    }
};

TEST_F(Car, WhoIsMovedTakesJointsAlongAsItTurns) {
    const std::array<Joint, 4> joints{WheelJoint{pin, {0.0, 1.0}}, SliderJoint{pin, {1.0, 0.0}},
                                      RevoluteJoint{pin}, DistanceJoint{top, pin}};
    const auto expectNear = [](const Vector& found, const Vector& expected) {
        EXPECT_NEAR(found.x, expected.x, 1e-9);
        EXPECT_NEAR(found.y, expected.y, 1e-9);
    };
    for (const auto& [movesCar, movesWheel] : {std::pair{true, false}, {false, true}, {true, true}})
        for (const Joint& joint : joints) {
            ASSERT_EQ(join(joint), "");
            auto car = drawn.where("car"), wheel = drawn.where("wheel");
            const Vector carFrom = car.second.metres, wheelFrom = wheel.second.metres, carTo{2.0, 1.5},
                         wheelTo{0.4, 1.0};
            car.second = {carTo, car.second.angleRadians + 0.5 * std::numbers::pi};
            wheel.second = {wheelTo, wheel.second.angleRadians + std::numbers::pi};
            std::map<std::string, BodyPlace> places;
            if (movesCar) places.insert(car);
            if (movesWheel) places.insert(wheel);
            const auto withCar = [&](const Vector& p) {
                return movesCar ? Vector{carTo.x - (p.y - carFrom.y), carTo.y + (p.x - carFrom.x)} : p;
            };
            const auto withWheel = [&](const Vector& p) {
                return movesWheel ? Vector{wheelTo.x - (p.x - wheelFrom.x), wheelTo.y - (p.y - wheelFrom.y)}
                                  : p;
            };
            const auto actions = moveActions(drawn.drawing, places);
            const auto joined = std::ranges::find_if(actions, isAnyOf<JoinAction>);
            ASSERT_NE(joined, actions.end());
            std::visit(
                [&](const auto& kind) {
                    if constexpr (requires { kind.anchorMetres; })
                        expectNear(kind.anchorMetres, movesCar ? withCar(pin) : withWheel(pin));
                    else {
                        expectNear(kind.anchorAMetres, withCar(top));
                        expectNear(kind.anchorBMetres, withWheel(pin));
                    }
                    if constexpr (requires { kind.axis; }) {
                        const Vector axis = std::get<std::decay_t<decltype(kind)>>(joint).axis;
                        expectNear(kind.axis, movesCar ? Vector{-axis.y, axis.x} : axis);
                    }
                },
                std::get<JoinAction>(*joined).joint.joint);
            ASSERT_EQ(drawn.edit({UnjoinAction{"joint"}}), "");
        }
}

TEST(SceneDrawing, ALineIsHitFromBothSidesHoweverItIsDrawn) {
    for (const bool isLeftToRight : {true, false}) {
        Drawn drawn{blank()};
        const Vector a{0.5, 1.0}, b{2.0, 1.0};
        ASSERT_EQ(
            drawn.add(makeLine(isLeftToRight ? std::vector{a, b} : std::vector{b, a}, 0.01).value, "line"),
            "");
        ASSERT_EQ(drawn.add(makeBall({1.2, 1.5}, {1.3, 1.5}).value, "ball"), "");
        drawn.steps(300);
        EXPECT_NEAR(drawn.world.pose(2).yMetres, 1.1, 0.02) << isLeftToRight;
    }
}

TEST(SceneDrawing, ARopeIsSlackUntilItIsTaut) {
    Drawn drawn{blank()};
    ASSERT_EQ(drawn.add(makeBall({1.0, 2.0}, {1.1, 2.0}).value, "ball"), "");
    const auto rope = joinActions(drawn.drawing, JointKind::rope, drawn.where("floor"), drawn.where("ball"),
                                  {1.8, 2.0}, {1.0, 2.0});
    ASSERT_TRUE(rope) << rope.error;
    ASSERT_EQ(drawn.edit(rope.value), "");
    double lowest = 9.0, longest = 0.0;
    for (int i = 0; i < 100; ++i) {
        drawn.steps(1);
        const BodyPose pose = drawn.world.pose(1);
        lowest = std::min(lowest, pose.yMetres);
        longest = std::max(longest, std::hypot(pose.xMetres - 1.8, pose.yMetres - 2.0));
    }
    EXPECT_LT(lowest, 1.5) << "it swings";
    EXPECT_LT(longest, 0.83);
    drawn.now = drawn.poses();
    for (const bool isAlone : {false, true}) { // the rope goes with it, or alone
        ASSERT_EQ(drawn.edit(isAlone ? std::vector<Action>{UnjoinAction{"joint 1"}}
                                     : removeActions(drawn.drawing, {"ball"})),
                  "");
        drawn.steps(30);
        drawn.undo();
        drawn.steps(30);
        const BodyPose ball = *drawn.pose("ball");
        EXPECT_LT(std::hypot(ball.xMetres - 1.8, ball.yMetres - 2.0), 0.83) << "it holds where it held";
    }
}

TEST(SceneDrawing, WhatIsSavedIsReadAndStartsThere) {
    Drawn drawn{blank()};
    ASSERT_EQ(drawn.add(makeBox({0.6, 0.9}, {1.8, 1.0}).value, "plank"), "");
    const auto floor = drawn.where("floor");
    ASSERT_EQ(drawn.edit(joinActions(drawn.drawing, JointKind::slider, floor, drawn.where("plank"),
                                     {1.2, 0.95}, {1.2, 1.95})
                             .value),
              "");
    const auto same = readScene(sceneJson(drawn.drawing.drawn()), "own.json");
    ASSERT_TRUE(same) << same.error;
    EXPECT_EQ(same.value, drawn.drawing.drawn());
    const Scene now = sceneNow(drawn.drawing.drawn(), [](const std::string& body) {
        return body == "plank" ? std::optional{BodyPose{1.2, 1.25, 0.0}} : std::nullopt;
    });
    const auto* unmoved = &now.bodies[1];
    EXPECT_EQ(unmoved->positionMetres, (Vector{1.2, 1.25}));
    const Scene both = sceneNow(drawn.drawing.drawn(), [&](const std::string& body) {
        return std::optional{body == "plank" ? BodyPose{1.2, 1.25, 0.0}
                                             : BodyPose{floor.second.metres.x, floor.second.metres.y, 0.0}};
    });
    const auto& slider = std::get<SliderJoint>(both.joints[0].joint);
    EXPECT_NEAR(slider.travelMetres->lower, -0.3, 1e-9) << "as far down as it has come up";
    EXPECT_NEAR(slider.travelMetres->upper, 0.7, 1e-9);
    EXPECT_EQ(validate(both), "");
}

TEST_F(Car, IsSavedWithItsAxleAndLimitsAsTheyAreNow) {
    ASSERT_EQ(join(WheelJoint{pin, {0.0, 1.0}, 2.0, 0.5, Interval{-0.2, 0.3}}), "");
    ASSERT_EQ(join(RevoluteJoint{pin, Interval{-0.5, 1.0}}, "car", "hinge"), "");
    const Scene now = sceneNow(drawn.drawing.drawn(), pose);
    const auto& wheel = std::get<WheelJoint>(now.joints[0].joint);
    const Interval hinge = *std::get<RevoluteJoint>(now.joints[1].joint).limitsRadians;
    constexpr double quarter = 0.5 * std::numbers::pi;
    const double found[] = {wheel.anchorMetres.x, wheel.axis.x, wheel.travelMetres->lower,
                            hinge.lower,          hinge.upper,  wheel.restMetres},
                 expected[] = {2.15, -1.0, -0.3, -0.5 - quarter, 1.0 - quarter, -0.1};
    for (std::size_t k = 0; k < std::size(found); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9) << k;
}

TEST(SceneDrawing, WhatIsSavedWhileItHangsRestsWhereItWouldHaveRested) {
    const Vector ball{1.6, 2.0}, above{1.6, 2.3}, below{1.61, 1.4}, side{1.3, 2.0};
    const std::vector<Joint> joints{WheelJoint{ball, {0.0, 1.0}, 2.0, 0.5},
                                    WheelJoint{ball, {0.0, 1.0}, 2.0, 0.5, Interval{-0.04, 0.04}},
                                    DistanceJoint{above, ball, 2.0, 0.5},
                                    DistanceJoint{below, ball, 0.0, 0.0, true}, // falls, then it is taut
                                    WeldJoint{side, 3.0, 0.5}};
    for (std::size_t k = 0; k < joints.size(); ++k)
        for (const int steps : {20, 600}) {
            SCOPED_TRACE("joint " + std::to_string(k) + ", saved after " + std::to_string(steps) + " steps");
            Drawn drawn{blank()};
            BodyDescription body = makeBall(ball, {1.7, 2.0}).value;
            body.linearDampingPerSecond = 1.0;
            ASSERT_EQ(drawn.add(body, "ball"), "");
            ASSERT_EQ(drawn.edit({JoinAction{{"joint", "floor", "ball", joints[k]}}}), "");
            drawn.steps(steps);
            const auto read = readScene(sceneJson(sceneNow(drawn.drawing.drawn(), drawn.poses())), "now");
            ASSERT_TRUE(read) << read.error;
            Simulation saved{read.value, 0, 100};
            drawn.steps(1500);
            for (int i = 0; i < 1500; ++i) saved.step(drawn.events);
            const BodyPose found = saved.pose(1), expected = drawn.world.pose(1);
            EXPECT_NEAR(found.xMetres, expected.xMetres, 5e-3);
            EXPECT_NEAR(found.yMetres, expected.yMetres, 5e-3);
            EXPECT_NEAR(found.angleRadians, expected.angleRadians, 5e-3);
        }
}

// A seed moves bodies a little at the start, and what has turned for long is told without whole turns.
TEST(SceneDrawing, WhatIsSavedHasRigidJointsAtRestAndNoWholeTurns) {
    Scene scene = blank();
    for (const double x : {1.0, 1.4}) {
        scene.bodies.push_back(makeBall({x, 2.0}, {x + 0.1, 2.0}).value);
        scene.bodies.back().name = x == 1.0 ? "a" : "b";
    }
    scene.joints = {{"rod", "a", "b", DistanceJoint{{1.0, 2.0}, {1.4, 2.0}}},
                    {"spring", "a", "b", DistanceJoint{{1.0, 2.0}, {1.4, 2.0}, 2.0, 0.5}},
                    {"rigid", "a", "b", WeldJoint{{1.2, 2.0}}},
                    {"soft", "a", "b", WeldJoint{{1.2, 2.0}, 3.0, 0.5}}};
    const double fullTurns = 318.0 * std::numbers::pi;
    const Scene now = sceneNow(scene, [&](const std::string& body) {
        return std::optional{body == "a" ? BodyPose{1.0, 2.0, 0.0} : BodyPose{1.5, 2.0, fullTurns + 0.1}};
    });
    EXPECT_EQ(std::get<DistanceJoint>(now.joints[0].joint).restMetres, 0.0);
    EXPECT_NEAR(std::get<DistanceJoint>(now.joints[1].joint).restMetres, -0.1, 1e-9);
    EXPECT_EQ(std::get<WeldJoint>(now.joints[2].joint).restRadians, 0.0);
    EXPECT_NEAR(std::get<WeldJoint>(now.joints[3].joint).restRadians, -0.1, 1e-9);
}

TEST_F(Car, ACopyHasTheJointsBetweenItsBodies) {
    ASSERT_EQ(join(WheelJoint{pin, {0.0, 1.0}}), "");
    ASSERT_EQ(join(DistanceJoint{top, pin}, "car", "rod"), "");
    ASSERT_EQ(join(DistanceJoint{top, pin}, "floor", "other"), "");
    std::vector<std::string> names;
    const auto copy = copyBodies(drawn.drawing, {"car", "wheel"});
    ASSERT_EQ(drawn.edit(pasteActions(drawn.drawing, copy, {0.5, 0.25}, names)), "");
    const Vector pin1{pin.x + 0.5, pin.y + 0.25}, top1{top.x + 0.5, top.y + 0.25};
    EXPECT_EQ((std::vector(drawn.drawing.drawn().joints.begin() + 3, drawn.drawing.drawn().joints.end())),
              (std::vector<JointDescription>{{"joint 1", "car 1", "wheel 1", WheelJoint{pin1, {0.0, 1.0}}},
                                             {"joint 2", "car 1", "wheel 1", DistanceJoint{top1, pin1}}}));
}

TEST_F(Car, ABodyGoesWithTheJointsThatHoldItAndWithNothingElseOfTheirNames) {
    ASSERT_EQ(drawn.add(makeBall({0.5, 1.0}, {0.6, 1.0}).value, "rod"), "");
    ASSERT_EQ(join(RevoluteJoint{pin}, "car", "floor"), "");
    ASSERT_EQ(join(DistanceJoint{top, pin}, "floor", "rod"), "");
    Scene scene = drawn.drawing.drawn();
    scene.script = {{0.0, 1, 0.0, MotorAction{"floor", 1.0, {}}},
                    {0.0, 1, 0.0, ImpulseAction{"rod", {}, {}}}};
    const Scene left = sceneWithout(scene, {"floor"});
    EXPECT_TRUE(left.script == scene.script);
    ASSERT_EQ(drawn.edit(removeActions(drawn.drawing, {"floor"})), "");
    for (const Scene& one : {left, drawn.drawing.drawn()}) {
        ASSERT_EQ(one.joints.size(), 1U);
        EXPECT_EQ(one.joints[0].name, "floor");
        EXPECT_EQ(one.bodies.size(), 3U) << "car, wheel and rod";
    }
}

TEST(SceneDrawing, SaysWhatCannotBeDrawn) {
    EXPECT_EQ(makeBall({1.0, 1.0}, {1.001, 1.0}).error, "ball: expected at least 0.01 m across");
    EXPECT_EQ(makePolygon({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}).error,
              "polygon: expected at least 3 corners that are not in a line");
    EXPECT_EQ(
        std::get<PolygonShape>(makePolygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}).value.fixtures[0].shape)
            .verticesMetres.size(),
        4U)
        << "the place inside is none of its corners";
    Scene scene = blank();
    scene.script.push_back({0.0, 1, 0.0, UnjoinAction{"joint"}});
    EXPECT_EQ(validate(scene),
              "script[0].input: expected another: change, join and unjoin are live inputs only");
    InputCheck check{blank()};
    EXPECT_EQ(check.accept(UnjoinAction{"joint"}), "joint: expected the name of a joint, found \"joint\"");
    BodyDescription ball = makeBall({1.0, 1.0}, {1.1, 1.0}).value;
    ball.name = "ball";
    EXPECT_EQ(check.accept(ChangeAction{ball, false}),
              "body.name: expected the name of a body, found \"ball\"");
}

TEST(InputCheck, DrawingGoesOnForMonths) {
    InputCheck check{blank(), InputCheck::unlimited};
    BodyDescription ball = makeBall({1.0, 1.0}, {1.1, 1.0}).value;
    for (int i = 0; i < 400; ++i) {
        ball.name = "ball " + std::to_string(i);
        ASSERT_EQ(check.accept(SpawnAction{ball, {}}), "") << i;
        JointDescription pin{"pin", "floor", ball.name, RevoluteJoint{}, false};
        ASSERT_EQ(check.accept(JoinAction{pin}), "") << i;
        ASSERT_EQ(check.accept(ChangeAction{ball, true}), "") << i;
        ASSERT_EQ(check.accept(UnjoinAction{"pin"}), "") << i;
        ASSERT_EQ(check.accept(RemoveAction{ball.name}), "") << i;
        ASSERT_EQ(check.accept(ChangeAction{ball, false}), "") << "it is back";
        if (i % 3 == 0) continue;
        ASSERT_EQ(check.accept(RemoveAction{ball.name}), "") << i;
    }
    EXPECT_NE(check.accept(ChangeAction{ball, false}), "expected at most 100000 inputs");
}

} // namespace physvib::scene_drawing_test
