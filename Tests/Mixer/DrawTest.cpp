// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing by mouse and keys, and the first start, in the mixer's view: what they do is in the world, in the
// saved session, and comes back by undo.
#include "Host/FakeAudioDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Model/MixerWorld.h"
#include "Mixer/Widgets/Cards.h"
#include "Mixer/Window/FirstStart.h"
#include "NewSceneRig.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"

namespace physvib::draw_test {

using namespace test;

struct Board : NewSceneRig {
    int keysHeld = 0; // while the mouse is used
    juce::MouseEvent mouse(Vector at, Vector pressedAt) {
        return mouseAt(pane, world.pixelOfMetres(at), juce::ModifierKeys::leftButtonModifier | keysHeld,
                       world.pixelOfMetres(pressedAt));
    }
    void stroke(Vector from, Vector to) {
        pane.mouseDown(mouse(from, from));
        pane.mouseDrag(mouse(to, from));
        pane.mouseUp(mouse(to, from));
    }
    void drag(Vector from, Vector to) { stroke(from, to), settle(); }
    void key(juce::juce_wchar c) {
        key(KeyPress{static_cast<int>(juce::CharacterFunctions::toUpperCase(c)), {}, c});
    }
    void key(const KeyPress& press) { view.world().keyPressed(press), settle(); }
    /// The next ball of a world: "ball 1", where there is none.
    void drawBall() {
        key('b');
        drag(share(0.5, 0.5), share(0.55, 0.5));
    }
};

struct Drawing : testing::Test, Board {};

TEST_F(Drawing, BallsBoxesAndWallsAreDrawnAndUndone) {
    const auto before = drawn().bodies.size();
    drawBall();
    key('x');
    drag(share(0.2, 0.5), share(0.3, 0.6));
    key('w');
    drag(share(0.1, 0.3), share(0.4, 0.2));
    ASSERT_EQ(drawn().bodies.size(), before + 3);
    EXPECT_EQ(body("ball 1")->type, BodyType::dynamicBody);
    EXPECT_TRUE(body("ball 1")->fixtures[0].isCamera) << "the first that moves is felt";
    EXPECT_EQ(body("wall 1")->type, BodyType::staticBody);
    for (int k = 0; k < 3; ++k) undo();
    EXPECT_EQ(drawn().bodies.size(), before);
    for (int k = 0; k < 3; ++k) model.undoManager().redo();
    EXPECT_EQ(drawn().bodies.size(), before + 3);
    EXPECT_EQ(sceneAtEndOfRun(model.savedSession().log.runs.back()).bodies.size(), before + 3)
        << "in the session that is saved";
}

TEST(DrawingAgain, TheFirstBallInAnySceneIsFelt) {
    for (const char* scene : {"shake-the-box", "drop", "marbles"}) {
        Board board;
        setScene(board.model, *findBuiltInScene(scene));
        board.settle();
        board.pane.addAt(DrawTool::ball, board.share(0.5, 0.8));
        const auto& ball = board.drawn().bodies.back();
        ASSERT_EQ(ball.name, "ball 1") << scene;
        EXPECT_TRUE(isSource(ball)) << scene;
        EXPECT_GT(nth(board.drawn().materials, ball.fixtures[0].material).frequencyHz, 0.0) << scene;
    }
}

TEST_F(Drawing, ByKeysAloneABallIsPutMovedSizedCopiedAndErased) {
    key('b');
    key(KeyPress{KeyPress::returnKey});
    ASSERT_EQ(pane.selected(), (std::vector<std::string>{"ball 1"}));
    const auto ball = [&] { return *body("ball 1"); };
    const auto start = ball();
    key(KeyPress{KeyPress::rightKey});
    EXPECT_GT(ball().positionMetres.x, start.positionMetres.x);
    key('+');
    EXPECT_GT(std::get<CircleShape>(ball().fixtures[0].shape).radiusMetres,
              std::get<CircleShape>(start.fixtures[0].shape).radiusMetres);
    key(KeyPress{'d', juce::ModifierKeys::commandModifier, 0});
    EXPECT_EQ(pane.selected(), (std::vector<std::string>{"ball 2"}));
    key(KeyPress{KeyPress::deleteKey});
    EXPECT_EQ(body("ball 2"), nullptr);
    EXPECT_NE(body("ball 1"), nullptr);
    pane.setTool(DrawTool::hand); // with any tool
    key(KeyPress{'a', juce::ModifierKeys::commandModifier, 0});
    key(KeyPress{KeyPress::deleteKey});
    EXPECT_TRUE(drawn().bodies.empty());
}

TEST_F(Drawing, EveryKeyCountsHoweverSoonTheNextOneComes) {
    drawBall();
    pane.setTool(DrawTool::select);
    pane.select({"ball 1"});
    const double start = body("ball 1")->positionMetres.x;
    std::vector<double> moved;
    for (int k = 0; k < 3; ++k) {
        view.world().keyPressed(KeyPress{KeyPress::rightKey}); // before the window is told of the last
        moved.push_back(body("ball 1")->positionMetres.x - start);
    }
    EXPECT_GT(moved[0], 0.0);
    EXPECT_NEAR(moved[1], 2.0 * moved[0], 1e-4);
    EXPECT_NEAR(moved[2], 3.0 * moved[0], 1e-4);
}

TEST_F(Drawing, EachStrokeOfTheEraserIsOneStepOfUndo) {
    const auto erase = [&](double from, std::initializer_list<double> over) {
        const Vector start = share(from, 0.5);
        pane.mouseDown(mouse(start, start));
        for (const double x : over) pane.mouseDrag(mouse(share(x, 0.5), start));
        pane.mouseUp(mouse(start, start));
        settle();
    };
    for (const double x : {0.2, 0.4, 0.6, 0.8}) pane.addAt(DrawTool::ball, share(x, 0.5));
    settle();
    const auto before = drawn().bodies.size();
    pane.setTool(DrawTool::eraser);
    erase(0.2, {0.4});
    ASSERT_EQ(drawn().bodies.size(), before - 2);
    erase(0.1, {0.6, 0.8}); // begins where nothing is
    ASSERT_EQ(drawn().bodies.size(), before - 4);
    undo();
    EXPECT_EQ(drawn().bodies.size(), before - 2);
    undo();
    EXPECT_EQ(drawn().bodies.size(), before);
}

TEST_F(Drawing, TheBodiesOfARainHaveNumberedNamesWhateverIsLeftOfAnother) {
    const auto before = drawn().bodies.size();
    pane.setRainCount(10);
    key('n');
    drag(share(0.2, 0.5), share(0.4, 0.7));
    ASSERT_EQ(drawn().bodies.size(), before + 10);
    for (int k = 1; k <= 10; ++k) EXPECT_NE(body("rain " + std::to_string(k)), nullptr) << k;
    pane.eraseBodies({"rain 1"});
    key('n');
    drag(share(0.5, 0.5), share(0.7, 0.7));
    EXPECT_EQ(drawn().bodies.size(), before + 19) << model.messageText();
    EXPECT_NE(body("rain 20"), nullptr);
    undo();
    EXPECT_EQ(drawn().bodies.size(), before + 9) << "one rain, one step";
}

TEST(DrawingAgain, AConveyorCarriesBallsOfAnySizeTheWayOfItsDragAndIsOneStep) {
    for (const double size : {0.02, 0.06, 0.12})
        for (const double to : {0.15, 0.85}) {
            Board board;
            const auto before = board.drawn().bodies.size();
            const double from = 1.0 - to, height = board.drawn().fieldHeightMetres;
            const auto at = board.share(from + 0.1 * (to > from ? 1.0 : -1.0), 0.4);
            board.key('c');
            board.drag(board.share(from, 0.4), board.share(to, 0.4));
            ASSERT_EQ(board.pane.selected(), (std::vector<std::string>{"conveyor 1"}));
            board.key('b');
            const double above = at.y + (0.035 + size) * height;
            board.drag({at.x, above}, {at.x + size * height, above});
            Simulation simulation{board.drawn(), 0, 100};
            std::vector<CollisionEvent> events;
            for (int k = 0; k < 200; ++k) simulation.step(events);
            const auto pose = simulation.pose(board.drawn().bodies.size() - 1);
            const double way = (pose.xMetres - at.x) * (to > from ? 1.0 : -1.0);
            EXPECT_GT(way, 0.2 * height) << size << ' ' << to;
            EXPECT_GT(pose.yMetres, at.y) << "and stays on it";
            for (int k = 0; k < 2; ++k) board.undo();
            EXPECT_EQ(board.drawn().bodies.size(), before);
        }
}

TEST(DrawingAgain, AConveyorCarriesARainOfSmallBalls) {
    for (const int count : {20, 200}) {
        Board board;
        board.key('c');
        board.drag(board.share(0.1, 0.2), board.share(0.9, 0.2));
        board.pane.setRainCount(count);
        board.key('n');
        board.drag(board.share(0.15, 0.3), board.share(0.4, 0.5));
        const auto& bodies = board.drawn().bodies;
        Simulation simulation{board.drawn(), 0, 100};
        std::vector<CollisionEvent> events;
        for (int k = 0; k < 300; ++k) simulation.step(events);
        int carried = 0;
        for (std::size_t k = bodies.size() - static_cast<std::size_t>(count); k < bodies.size(); ++k)
            if (simulation.pose(k).xMetres - bodies[k].positionMetres.x >
                0.2 * board.drawn().fieldHeightMetres)
                ++carried;
        EXPECT_GT(carried, 9 * count / 10) << count;
    }
}

TEST_F(Drawing, BesideTheFieldNothingIsDrawnAndAtItsEdgeItIs) {
    const auto before = drawn().bodies.size();
    const double edge = 5.0 / static_cast<double>(world.pixelsPerMetre());
    for (const char tool : {'b', 'x', 'p', 'l', 'w', 'n', 'c'}) {
        key(static_cast<juce::juce_wchar>(tool));
        for (const auto& [x, y] : {std::pair{-0.1, 0.5}, {1.1, 0.5}, {0.5, 1.1}})
            drag(share(x, y), share(x, y));
    }
    EXPECT_EQ(drawn().bodies.size(), before);
    key('w');
    drag({-edge, share(0.0, 0.5).y}, share(0.2, 0.5));
    EXPECT_EQ(drawn().bodies.size(), before + 1) << "a wall from the edge";
}

TEST_F(Drawing, TheMaterialsStayWhereTheyAreWhateverIsChosen) {
    for (const int wide : {1440, 1000}) {
        view.setSize(wide, 800);
        std::vector<juce::Rectangle<int>> first;
        for (const DrawTool tool : {DrawTool::ball, DrawTool::wall, DrawTool::rain, DrawTool::select})
            for (int m = 0; m < std::ssize(drawn().materials); ++m) {
                pane.setTool(tool);
                pane.setMaterial(m);
                std::vector<juce::Rectangle<int>> places;
                for (const auto& material : drawn().materials)
                    places.push_back(the(view, "Material " + utf8(material.name)).getBounds());
                if (first.empty()) first = places;
                EXPECT_EQ(places, first) << wide << " tool " << static_cast<int>(tool) << " material " << m;
            }
    }
}

TEST_F(Drawing, AMaterialThatDoesNotVibrateTakesTheSourceAndTheNextGivesItBack) {
    model.change("Silent", [](Mix& mix) {
        Scene scene = *mix.scene;
        scene.materials.push_back(Material{scene.materials.front()});
        scene.materials.back().name = "wool", scene.materials.back().frequencyHz = 0.0;
        mix.scene = std::make_shared<const Scene>(scene);
    });
    settle();
    for (const DrawTool tool : {DrawTool::ball, DrawTool::wall}) {
        pane.setTool(tool);
        pane.addAt(tool, share(0.5, 0.6));
        const auto name = drawn().bodies.back().name;
        const auto source = [&] { return isSource(*body(name)); };
        const bool before = source();
        const int own = drawn().bodies.back().fixtures[0].material;
        pane.select({name});
        pane.setSelectedMaterial(static_cast<int>(drawn().materials.size()) - 1);
        EXPECT_FALSE(source()) << name;
        pane.setSelectedMaterial(own);
        EXPECT_EQ(source(), before) << name;
    }
}

TEST_F(Drawing, UndoOfAnEraseThatEndsAScriptHasBodiesWhereTheyWere) {
    setScene(model, *findBuiltInScene("shake-the-box"));
    settle();
    pane.addAt(DrawTool::ball, share(0.5, 0.7));
    model.setSlowness(1);
    const auto now = [&] { return model.world().posesNow()("ball 1"); };
    const double drawn = share(0.5, 0.7).y;
    ASSERT_TRUE(runUntil([&] { return view.refresh(), now() && now()->yMetres < 0.9 * drawn; }));
    model.setSlowness(0);
    settle();
    const double there = now()->yMetres;
    pane.selectAll();
    pane.eraseBodies(pane.selected());
    settle();
    ASSERT_EQ(body("ball 1"), nullptr);
    undo();
    settle();
    ASSERT_NE(body("ball 1"), nullptr);
    EXPECT_NEAR(body("ball 1")->positionMetres.y, there, 0.02 * drawn);
}

TEST_F(Drawing, AMaterialIsRenamedByADoubleClickAndEditedByItsButton) {
    drawBall();
    const auto first = utf8(drawn().materials[0].name);
    for (const juce::String title : {"Material " + first, juce::String{"Made of mine"}}) {
        auto* const swatch = find(view, title);
        ASSERT_TRUE(swatch != nullptr && swatch->isVisible()) << title;
        swatch->mouseDoubleClick(mouseAt(*swatch, {4.0f, 4.0f}));
        ASSERT_NE(view.question(), nullptr) << title;
        const juce::String name = title.startsWith("Made") ? "ours" : "mine";
        view.question()->setValue("Name", name);
        view.question()->answer("Change");
        ASSERT_TRUE(runUntil([&] { return drawn().materials[0].name == name.toStdString(); }));
        settle();
        pane.select({drawn().bodies.back().name});
        view.refresh();
    }
    for (const char* title : {"Edit the material", "Material of what is chosen"}) {
        auto* const edit = dynamic_cast<juce::Button*>(find(view, title));
        ASSERT_TRUE(edit != nullptr && edit->isVisible() && edit->onClick) << title;
    }
    view.world().onMaterial(0, true);
    EXPECT_TRUE(view.tabs().find<MaterialsTab>()->isShowing() ||
                view.tabs().find<MaterialsTab>()->isVisible());
    EXPECT_NE(view.openCard(), nullptr) << "of a recording";
}

TEST_F(Drawing, AMaterialIsRenamedAlthoughOneWasMeasuredMeanwhile) {
    drawBall();
    auto& swatch = the(view, "Material " + utf8(drawn().materials[0].name));
    swatch.mouseDoubleClick(mouseAt(swatch, {4.0f, 4.0f}));
    ASSERT_NE(view.question(), nullptr);
    ASSERT_EQ(model.world().edit("Recording", SoundAction{1, 123.0, 4.0}), "");
    model.dispatchPendingMessages();
    view.question()->setValue("Name", "mine");
    view.question()->answer("Change");
    EXPECT_TRUE(runUntil([&] { return view.openCard() == nullptr; }, 1.0)) << "no card stays for ever";
    EXPECT_EQ(drawn().materials[0].name, "mine");
}

TEST_F(Drawing, ANewMaterialIsMadeBesideTheMaterialsAndForWhatIsChosen) {
    for (const juce::String plus : {"New material", "New material for what is chosen"}) {
        drawBall();
        auto* const button = dynamic_cast<juce::Button*>(find(view, plus));
        ASSERT_TRUE(button != nullptr && button->isVisible()) << plus;
        const auto before = drawn().materials;
        button->onClick();
        ASSERT_NE(view.question(), nullptr);
        view.question()->setValue("Name", "mine, " + plus);
        view.question()->answer("Make it");
        ASSERT_TRUE(runUntil([&] { return drawn().materials.size() == before.size() + 1; }))
            << model.messageText();
        settle();
        const int made = static_cast<int>(before.size());
        EXPECT_EQ(drawn().materials.back().name, ("mine, " + plus).toStdString());
        if (plus == "New material")
            EXPECT_EQ(pane.material(), made);
        else
            EXPECT_EQ(drawn().bodies.back().fixtures[0].material, made);
    }
}

TEST_F(Drawing, AJointInTheAirSaysHowUntilOneHolds) {
    drawBall();
    pane.addJointAt(DrawTool::motor, share(0.02, 0.98));
    EXPECT_EQ(model.messages().current().action.name, "Pause");
    pane.addJointAt(DrawTool::motor, share(0.5, 0.5));
    EXPECT_NE(model.messages().current().action.name, "Pause");
}

TEST(DrawingAgain, ARainOfAClickOrAFlatDragIsWithinTheFieldAndOfASize) {
    for (const auto& [from, y] : {std::pair{0.98, 0.02}, {0.98, 0.98}, {0.2, 0.02}, {0.2, 0.98}}) {
        Board board;
        board.pane.setRainCount(50);
        board.key('n');
        board.drag(board.share(from, y), board.share(0.98, y));
        const auto& scene = board.drawn();
        const auto isInside = [&](const BodyDescription& b) {
            return std::get<CircleShape>(b.fixtures[0].shape).radiusMetres >
                       0.012 * scene.fieldHeightMetres &&
                   b.positionMetres.x > 0.0 && b.positionMetres.x < scene.fieldWidthMetres &&
                   b.positionMetres.y > 0.0 && b.positionMetres.y < scene.fieldHeightMetres;
        };
        EXPECT_EQ(std::ranges::count_if(
                      scene.bodies,
                      [&](const BodyDescription& b) { return b.name.starts_with("rain") && isInside(b); }),
                  50)
            << y << ' ' << board.model.messageText();
    }
}

TEST_F(Drawing, ARainComesBallByBallWhileTheWorldRunsAndIsOneStepOfUndo) {
    const auto before = drawn().bodies.size();
    pane.setRainCount(10);
    pane.setRainPattern({20, true});
    key('n');
    drag(share(0.4, 0.4), share(0.6, 0.6));
    EXPECT_EQ(drawn().bodies.size(), before + 1) << "the world stands";
    const auto* first = body("rain 1");
    ASSERT_NE(first, nullptr);
    EXPECT_GT(first->velocityMetresPerSecond.y, 0.0) << "a fountain";
    model.setSlowness(1);
    const auto from = model.session().world().sceneNs();
    ASSERT_TRUE(runUntil([&] { return view.refresh(), drawn().bodies.size() == before + 10; }));
    const double seconds = 1e-9 * static_cast<double>(model.session().world().sceneNs() - from);
    EXPECT_GT(seconds, 0.4) << "20 a second";
    EXPECT_LT(seconds, 1.5);
    EXPECT_NE(body("rain 10"), nullptr);
    undo();
    EXPECT_EQ(drawn().bodies.size(), before);
    stroke(share(0.4, 0.4), share(0.6, 0.6));
    EXPECT_EQ(drawn().bodies.size(), before + 1) << "one begins, after one that was undone";
    undo();
    const auto end = model.session().world().sceneNs() + 300'000'000;
    ASSERT_TRUE(runUntil([&] { return view.refresh(), model.session().world().sceneNs() > end; }));
    EXPECT_EQ(drawn().bodies.size(), before) << "undone while it falls";
    model.setSlowness(0);
    setScene(model, *findBuiltInScene("drop"));
    settle();
    drag(share(0.4, 0.4), share(0.6, 0.6));
    setScene(model, *findBuiltInScene("marbles")); // before any time has passed
    settle();
    model.setSlowness(1), runFor(0.2), view.refresh();
    EXPECT_EQ(body("rain 2"), nullptr) << "a rain is of its scene";
}

TEST_F(Drawing, WhoTakesAnotherToolChoosesNothing) {
    drawBall();
    pane.setTool(DrawTool::select);
    pane.select({"ball 1"});
    pane.setTool(DrawTool::select);
    EXPECT_EQ(pane.selected(), (std::vector<std::string>{"ball 1"}));
    pane.setTool(DrawTool::box);
    EXPECT_TRUE(pane.selected().empty());
    pane.setMaterial(2);
    EXPECT_NE(body("ball 1")->fixtures[0].material, 2) << "of the next box, not of what was chosen";
}

TEST_F(Drawing, ARefusedEditLeavesNoStepAndNoHalf) {
    const auto before = drawn().bodies.size();
    const auto steps = model.undoManager().getUndoDescriptions().size();
    BodyDescription ball = drawn().bodies.front();
    ball.name = "twice";
    EXPECT_NE(model.world().edit("Two", {SpawnAction{ball, {}}, RemoveAction{"nobody"}}), "");
    EXPECT_EQ(drawn().bodies.size(), before);
    EXPECT_EQ(model.undoManager().getUndoDescriptions().size(), steps);
}

TEST_F(Drawing, WhatDoesNotVibrateIsNoHapticSourceAndIsToldInWords) {
    const auto& materials = drawn().materials;
    pane.setMaterial(
        static_cast<int>(std::ranges::find(materials, 0.0, &Material::frequencyHz) - materials.begin()));
    drawBall();
    auto& source = the<juce::Button>(view, "Haptic source");
    source.setToggleState(true, juce::sendNotificationSync);
    EXPECT_TRUE(model.messageText().contains("vibrates")) << model.messageText();
    EXPECT_FALSE(source.getToggleState());
}

TEST_F(Drawing, AMixedMarkIsGivenToAllThatCanHaveItAndThenTakenFromAll) {
    const auto& materials = drawn().materials;
    const int dull =
        static_cast<int>(std::ranges::find(materials, 0.0, &Material::frequencyHz) - materials.begin());
    model.change("Mixed", [&](Mix& mix) {
        Scene scene = drawn();
        for (auto& fixture : scene.bodies.front().fixtures) fixture.material = dull;
        setSource(scene, scene.bodies.front(), false);
        mix.scene = std::make_shared<const Scene>(scene);
    });
    settle();
    key('l');
    drag(share(0.2, 0.3), share(0.4, 0.3));
    for (const double x : {0.3, 0.6}) pane.addAt(DrawTool::ball, share(x, 0.6));
    pane.setTool(DrawTool::select);
    pane.select({"ball 1"});
    pane.changeSelected("Dull", [](const Scene& s, BodyDescription& b) { setSource(s, b, false); });
    pane.selectAll();
    for (const char* title : {"Haptic source", "Moves"}) {
        auto& mark = the<juce::Button>(view, title);
        const auto differs = [&] { return mark.getButtonText().containsChar(0x2260); };
        EXPECT_TRUE(differs() && !mark.getToggleState()) << title;
        for (const bool isOn : {true, false, true}) {
            mark.triggerClick();
            EXPECT_TRUE(runUntil([&] { return mark.getToggleState() == isOn && !differs(); }, 1.0))
                << title << isOn << mark.getButtonText();
        }
    }
    EXPECT_TRUE(isSource(*body("ball 1")));
    EXPECT_FALSE(isSource(drawn().bodies.front())) << "it does not vibrate";
}

TEST_F(Drawing, NoPanelStaysOverAWorldWhoseBodiesAreGone) {
    setScene(model, *findBuiltInScene("drawing"));
    model.setSlowness(1);
    settle();
    const auto isPanelThere = [&] {
        model.dispatchPendingMessages(), view.refresh();
        return the(view, "Chosen bodies").isVisible();
    };
    for (const bool areAll : {false, true}) {
        pane.setTool(DrawTool::select);
        pane.select({"pen"});
        EXPECT_TRUE(isPanelThere());
        if (areAll) pane.selectAll();
        pane.eraseBodies(pane.selected());
        EXPECT_TRUE(runUntil([&] { return !isPanelThere(); }, 1.0)) << areAll;
        EXPECT_EQ(body("pen"), nullptr) << model.messageText();
        undo();
        settle();
    }
}

TEST_F(Drawing, TheWorldSaysWhyNothingIsFelt) {
    const auto says = [&](const char* why) {
        view.refresh();
        return the<juce::Label>(view, "Strongest hit").getText().endsWith(why);
    };
    model.setSlowness(0);
    EXPECT_TRUE(says("paused"));
    model.setSlowness(1);
    EXPECT_TRUE(says("draw a ball: B"));
    setScene(model, *findBuiltInScene("marbles"));
    model.dispatchPendingMessages();
    EXPECT_FALSE(says("draw a ball: B")) << "its script does";
    pane.selectAll();
    pane.changeSelected("Dull", [](const Scene& s, BodyDescription& b) { setSource(s, b, false); });
    model.change("Scene", [&](Mix& m) {
        Scene dull = drawn();
        std::erase_if(dull.script, [](const ScriptInput& input) {
            const auto* brought = bodyAddedBy(input.action);
            return brought != nullptr && isSource(*brought);
        });
        m.scene = std::make_shared<const Scene>(dull);
    });
    EXPECT_TRUE(runUntil([&] { return says("no body is a haptic source"); }));
    model.setSilent(true);
    EXPECT_TRUE(says("silent"));
}

TEST_F(Drawing, ASeesawIsPinnedToTheFieldAndStartsAnewAsItWasDrawn) {
    key('x');
    drag(share(0.3, 0.4), share(0.7, 0.44));
    key('i');
    drag(share(0.5, 0.42), share(0.5, 0.42));
    ASSERT_EQ(drawn().joints.size(), 1u) << model.messageText();
    model.setSlowness(1);
    model.restart(model.mix().seed);
    ASSERT_EQ(drawn().joints.size(), 1u);
    runFor(1.0);
    settle();
    const auto pose = world.poseOfBody("box 1");
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->yMetres, share(0.5, 0.42).y, 0.05 * drawn().fieldHeightMetres) << "it hangs on its pin";
    key('e');
    drag(share(0.5, 0.42), share(0.5, 0.42));
    EXPECT_TRUE(drawn().joints.empty());
}

TEST_F(Drawing, AHandleSizesWhereTheBodyStays) {
    key('x');
    drag(share(0.4, 0.4), share(0.6, 0.6));
    key('s');
    pane.select({"box 1"});
    const auto box = [&] { return std::get<BoxShape>(body("box 1")->fixtures[0].shape); };
    const auto before = box();
    drag(share(0.6, 0.6), share(0.7, 0.6));
    EXPECT_NEAR(box().widthMetres, 2.0 * before.widthMetres, 0.1 * before.widthMetres);
    EXPECT_NEAR(box().heightMetres, before.heightMetres, 0.1 * before.heightMetres);
    const auto place = body("box 1")->positionMetres;
    drag(share(0.5, 0.5), share(0.4, 0.7));
    EXPECT_NEAR(body("box 1")->positionMetres.x, place.x - 0.1 * drawn().fieldWidthMetres,
                0.01 * drawn().fieldWidthMetres);
    pane.changeSelected("Bounce",
                        [](const Scene&, BodyDescription& body) { body.fixtures[0].restitution = 0.9; });
    EXPECT_EQ(body("box 1")->fixtures[0].restitution, 0.9);
    undo();
    EXPECT_FALSE(body("box 1")->fixtures[0].restitution);
}

TEST_F(Drawing, ARectangleChoosesShiftAddsAndTheHandleTurnsOnTheGridInSteps) {
    for (const double x : {0.3, 0.6, 0.9}) pane.addAt(DrawTool::box, share(x, 0.5));
    settle();
    key('s');
    const int shift = juce::ModifierKeys::shiftModifier;
    const auto box = share(0.3, 0.5), air = share(0.01, 0.9);
    for (const auto& [keys, from, to, chosen] :
         {std::tuple{0, share(0.2, 0.4), share(0.7, 0.6), std::vector<std::string>{"box 1", "box 2"}},
          {shift, share(0.8, 0.6), share(0.99, 0.4), {"box 1", "box 2", "box 3"}},
          {shift, box, box, {"box 2", "box 3"}},
          {shift, air, air, {"box 2", "box 3"}},
          {0, box, box, {"box 1"}},
          {0, air, air, {}}}) {
        keysHeld = keys;
        stroke(from, to);
        EXPECT_EQ(pane.selected(), chosen);
    }
    for (const auto& [name, degrees] : {std::pair{"box 1", -80.0}, {"box 2", -75.0}}) {
        pane.select({name});
        const double up = 26.0 / static_cast<double>(world.pixelsPerMetre()) +
                          0.5 * std::get<BoxShape>(body(name)->fixtures[0].shape).heightMetres,
                     turn = juce::degreesToRadians(80.0);
        const auto [x, y] = body(name)->positionMetres;
        stroke({x, y + up}, {x + up * std::sin(turn), y + up * std::cos(turn)});
        EXPECT_NEAR(juce::radiansToDegrees(body(name)->angleRadians), degrees, 0.01);
        pane.setSnapping(true);
    }
}

TEST_F(Drawing, WhereNoMaterialVibratesTheFirstIsDrawnWith) {
    Scene scene = newScene(drawn(), SceneGround::floor);
    for (auto& material : scene.materials) material.frequencyHz = 0.0;
    for (auto& body : scene.bodies) body.fixtures[0].isCamera = false;
    setScene(model, scene);
    settle();
    drawBall();
    ASSERT_NE(body("ball 1"), nullptr) << model.messageText();
    EXPECT_EQ(body("ball 1")->fixtures[0].material, 0);
}

TEST_F(Drawing, ATypedNumberHasADecimalPointOrComma) {
    for (const auto& [title, typed, value] : {std::tuple{"Bounce", "0,5", 0.5},
                                              {"Bounce", "0.25 lively", 0.25},
                                              {"Density", "1,250 medium", 1250.0},
                                              {"Belt speed", "-1,5 m/s", -1.5},
                                              {"Motor torque", "1,000 N m", 1000.0},
                                              {"Stiffness of the spring", "0,5 Hz", 0.5},
                                              {"Exponent", "1,5", 1.5},
                                              {"Frequency", "1,200.5 Hz", 1200.5},
                                              {"The script begins at", "1,5", 1.5},
                                              {"The script ends at", "to 1,234.50 s", 1234.5}})
        EXPECT_DOUBLE_EQ(the<juce::Slider>(view, title).getValueFromText(typed), value) << title << typed;
}

std::vector<CollisionEvent> eventsOf(const Scene& scene, std::uint32_t seed, std::int64_t untilNs) {
    Simulation world{scene, seed, 100};
    std::vector<CollisionEvent> events;
    while (world.timeNs() < untilNs) world.step(events);
    return events;
}

TEST_F(Drawing, WhatHandsDidIsTheScenesScriptAndTheSceneGivesTheSameHits) {
    drawBall();
    MixerScript& script = model.script();
    script.start();
    ASSERT_TRUE(runUntil([&] { return model.poll(), script.seconds() > 0.05; }))
        << "the world goes, though it stood still";
    EXPECT_EQ(model.world().apply(TiltAction{0.4}), "");
    EXPECT_EQ(model.world().apply(ImpulseAction{"ball 1", {300.0, 200.0}, Vector{0.01, 0.0}}), "");
    ASSERT_TRUE(runUntil([&] { return model.poll(), script.seconds() > 0.8; }));
    EXPECT_EQ(model.world().apply(GripAction{"ball 1", Vector{1.0, 1.0}, {}, 0.1}), "");
    ASSERT_TRUE(runUntil([&] { return model.poll(), script.seconds() > 1.5; }));
    EXPECT_EQ(script.inputs(), 3U);
    const std::size_t take = model.savedSession().log.runs.size() - 1;
    script.stop();
    ASSERT_NE(script.recording(), nullptr);
    const SceneRun& live = model.savedSession().log.runs[take];
    ASSERT_EQ(live.inputs.size(), 3U);
    const auto endNs = static_cast<std::int64_t>(1e9 * script.recording()->lengthSeconds);
    const auto events = eventsOf(drawn(), live.seed, endNs);
    EXPECT_GT(events.size(), 0U) << "the ball hits the floor";
    EXPECT_TRUE(events == eventsOf(live.fullScene(), live.seed, endNs));

    script.setTrim({0.5, 1.2, true});
    EXPECT_NEAR(drawn().scriptPeriodSeconds, 0.7, 1e-9);
    EXPECT_EQ(script.trim(), (ScriptTrim{0.5, 1.2, true}));
    undo();
    EXPECT_EQ(script.trim(), (ScriptTrim{0.0, script.recording()->lengthSeconds, false}))
        << "untrimmed again";
    undo();
    EXPECT_TRUE(drawn().script.empty()) << "as before the recording: one edit";
    EXPECT_NE(body("ball 1"), nullptr);
    EXPECT_EQ(script.recording(), nullptr);
}

TEST_F(Drawing, AnEditOfTheDrawingEndsTheRecordingWhoseEndsAreDragged) {
    MixerScript& script = model.script();
    script.start();
    ASSERT_TRUE(runUntil([&] { return model.poll(), script.seconds() > 0.05; }));
    EXPECT_EQ(model.world().apply(TiltAction{0.4}), "");
    drawBall();
    EXPECT_TRUE(runUntil([&] { return model.poll(), !script.isRecording(); }));
    ASSERT_EQ(drawn().script.size(), 1U);
    EXPECT_NE(body("ball 1"), nullptr);
    show();
    auto& strip = the(view, "Script of hands");
    ASSERT_TRUE(runUntil([&] { return pane.setTool(DrawTool::hand), show(), strip.isVisible(); }));
    const double length = script.recording()->lengthSeconds;
    for (const auto& [from, to, begin, end] :
         {std::tuple{0.1, 0.25, 0.25, 1.0}, {0.9, 0.75, 0.25, 0.75}, {0.7, 0.2, 0.25, 0.75}}) { // an empty
                                                                                                // part is
                                                                                                // none
        const auto at = [&](double share) {
            return mouseAt(strip,
                           {12.0f + static_cast<float>(share) * static_cast<float>(strip.getWidth() - 24),
                            static_cast<float>(strip.getHeight()) - 19.0f});
        };
        strip.mouseDown(at(from)), strip.mouseDrag(at(to)), strip.mouseUp(at(to));
        show();
        EXPECT_NEAR(script.trim().fromSeconds, begin * length, 0.01);
        EXPECT_NEAR(script.trim().toSeconds, end * length, 0.01);
    }
    EXPECT_NEAR(the<juce::Slider>(view, "The script ends at").getValue(), 0.75 * length, 0.01);
}

TEST(NewScene, ABallThatFallsInANewBoxIsFelt) {
    for (const SceneGround ground : {SceneGround::box, SceneGround::floor}) {
        const Scene& like = *findBuiltInScene("shake-the-box");
        for (const auto& material : like.materials) {
            Scene scene = newScene(like, ground);
            BodyDescription ball;
            ball.name = "ball";
            ball.positionMetres = {3.0, 2.0};
            ball.fixtures.resize(1);
            ball.fixtures[0].shape = CircleShape{0.15};
            ball.fixtures[0].material = static_cast<int>(&material - like.materials.data());
            scene.bodies.push_back(ball);
            const auto events = simulateScene(scene, {1, 100}, 2'000'000'000).events;
            ASSERT_FALSE(events.empty()) << material.name;
            double strongest = 0.0;
            for (const auto& e : events) strongest = std::max(strongest, std::abs(e.amplitude));
            EXPECT_GT(strongest, 0.001) << material.name << ": -60 dB";
            std::cout << material.name << ": " << strongest << " of full scale\n";
        }
    }
}

/// More than the machine steps in real time.
Scene heap() {
    Scene scene = newScene(*findBuiltInScene("shake-the-box"), SceneGround::box);
    for (int k = 0; k < 2000; ++k) {
        BodyDescription ball;
        ball.name = "b" + std::to_string(k);
        ball.positionMetres = {0.5 * scene.fieldWidthMetres, 0.5 * scene.fieldHeightMetres};
        ball.fixtures.resize(1);
        ball.fixtures[0].shape = CircleShape{0.1 * scene.fieldHeightMetres};
        scene.bodies.push_back(std::move(ball));
    }
    return scene;
}

TEST(BigWorld, SaysThatItIsTooMuchAndIsDrawnMeanwhile) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    setScene(model, heap());
    ASSERT_TRUE(runUntil([&] { return view.refresh(), model.messageText().contains("of real time"); }));
    EXPECT_TRUE(model.messageText().startsWith("2,004 bodies: ")) << model.messageText();
    EXPECT_EQ(view.snapshot().poses.size(), 2004U);
}

TEST(PaceWatch, SaysTwiceASecondWhatShareOfRealTimeAWorldKeeps) {
    RealTimeMonitor pace;
    EXPECT_FALSE(pace.poll(100'000'000, 0));
    EXPECT_EQ(pace.poll(500'000'000, 0), 1.0);
    EXPECT_FALSE(pace.poll(700'000'000, 150'000'000));
    EXPECT_NEAR(*pace.poll(1'000'000'000, 345'000'000), 0.31, 1e-9);
    EXPECT_FALSE(pace.poll(0, 0)) << "another session";
    EXPECT_EQ(pace.poll(500'000'000, 600'000'000), 0.0) << "its first step is not over";
    EXPECT_EQ(pace.poll(1'000'000'000, 20'000'000), 1.0)
        << "what it has caught up with is no more than real time";
}

TEST(FirstStart, APicoComesFirstThenTheInterfaceAndNoDeviceLastAndItReplacesTheFirstLayout) {
    const std::string pico = "PhysVib pico8, USB Audio; Direct hardware device without any conversions";
    const auto ordered = sortedByLikelihood({{"None", "no device", 0},
                                             {"ALSA", "HDMI 0", 8},
                                             {"ALSA", "Default ALSA Output", 32},
                                             {"JACK", "system", 8},
                                             {"ALSA", pico, 8},
                                             {"ALSA", "USB Audio", 8}});
    std::vector<std::string> names;
    for (const auto& device : ordered) names.push_back(device.name);
    EXPECT_EQ(names, (std::vector<std::string>{pico, "system", "USB Audio", "Default ALSA Output", "HDMI 0",
                                               "no device"}));
    EXPECT_STREQ(layoutPresetFor(8, pico), "pico8");
    EXPECT_STREQ(layoutPresetFor(4, "CoreAudio:PhysVib pico4"), "pico4");
    EXPECT_STREQ(layoutPresetFor(8, picoDeviceName), "pico8") << "as play calls the first one";
    EXPECT_STREQ(layoutPresetFor(8, "system"), "phone4");
    Mix mix = MixerModel::defaultMix();
    fitLayoutTo(8, mix, "ALSA:PhysVib pico8");
    EXPECT_EQ(mix.layout.name, "pico8");
    EXPECT_EQ(mix.count(), 8);
    setLayout(mix, "ring4");
    fitLayoutTo(8, mix, "ALSA:PhysVib pico8");
    EXPECT_EQ(mix.layout.name, "ring4");
    fitLayoutTo(2, mix, "ALSA:PhysVib pico8");
    EXPECT_EQ(mix.layout.name, "phone2") << "a system may show two outputs of it";
}

TEST(FirstStart, ADeviceWithoutOutputsIsNoChoiceAndNoDeviceSaysWhatThatMeans) {
    FakeInterface server, ears;
    server.name = "PulseAudio Sound Server";
    server.outputs = 0;
    ears.name = "ears";
    ears.outputs = 2;
    const auto titles = [](const std::vector<PlaybackChoice>& choices) {
        juce::StringArray all;
        for (const auto& choice : choices) all.add(choice.title);
        return all.joinIntoString("; ");
    };
    EXPECT_EQ(titles(playbackChoices(fakeDrivers({&server, &ears}), {})),
              "Headphones: Fake:ears; Fake:ears, 2 outputs: two actuators; No device: seen, not felt");
    const auto none = playbackChoices(fakeDrivers({&server}), {});
    EXPECT_EQ(titles(none), "No device: seen, not felt");
    MixerModel model{onlyNoDevice(), noDevice};
    FirstStart card{model, none};
    bool hasEnded = false;
    card.onEnd = [&](bool) { hasEnded = true; };
    card.keyPressed(KeyPress{KeyPress::returnKey});
    EXPECT_TRUE(hasEnded);
    EXPECT_TRUE(model.messageText().contains("not felt")) << "never without a word";
}

TEST(FirstStart, TestsFromTheLevelOfBeforeIfThatIsLower) {
    MixerModel model{onlyNoDevice(), noDevice};
    model.change("Level", [](Mix& mix) { mix.levelDb = -40.0; });
    model.setSlowness(0);
    FirstStart card{model, {{"four", noDevice, 4}}};
    card.test(4);
    EXPECT_EQ(model.mix().levelDb, -40.0);
    card.end(true);
    EXPECT_EQ(model.session().world().slowness(), 0) << "as it was";
}

TEST(FirstStart, HeadphonesByNameComeBeforeAControllerAndOtherSpeakersBehindIt) {
    FakeInterface speakers, ears, hands;
    speakers.name = "Monitor speakers";
    ears.name = "USB Headset";
    speakers.outputs = ears.outputs = 2;
    const std::vector<DetectedSink> pad{{&findSinkKind({"PAD", {}}), {"DualSense"}}};
    const auto first = [](const std::vector<PlaybackChoice>& choices, std::size_t k) {
        return choices[k].title;
    };
    const auto plain = playbackChoices(fakeDrivers({&speakers}), pad);
    EXPECT_TRUE(first(plain, 0).startsWith("Game controller")) << first(plain, 0);
    EXPECT_TRUE(first(plain, 1).startsWith("Headphones: ")) << first(plain, 1);
    const auto named = playbackChoices(fakeDrivers({&speakers, &ears}), pad);
    EXPECT_EQ(first(named, 0), "Headphones: Fake:USB Headset");
    EXPECT_TRUE(named[0].isHeadphones);
    EXPECT_TRUE(first(named, 1).startsWith("Game controller")) << first(named, 1);
    const auto many = playbackChoices(fakeDrivers({&hands, &ears}), pad); // eight outputs
    EXPECT_EQ(many[0].outputs, 8);
    EXPECT_EQ(first(many, 1), "Headphones: Fake:USB Headset");
}

TEST(FirstStart, ABoardIsOfferedBeforeHeadphonesByNameAndThoseBeforeControllers) {
    FakeInterface ears;
    ears.name = "USB Headset";
    ears.outputs = 2;
    const auto choices =
        playbackChoices(fakeDrivers({&ears}), {{&findSinkKind({"PAD", {}}), {"DualSense"}},
                                               {&findSinkKind({"BOARD", {}}), {"/dev/ttyACM0", "ST-Link"}}});
    ASSERT_GE(choices.size(), 4U);
    EXPECT_EQ(choices[0].title, "Four-channel board: /dev/ttyACM0  ST-Link");
    EXPECT_EQ(choices[0].device.sinks, (std::vector<SinkName>{{"BOARD", "/dev/ttyACM0"}}));
    EXPECT_EQ(choices[0].outputs, 4);
    EXPECT_TRUE(choices[1].isHeadphones) << choices[1].title;
    EXPECT_TRUE(choices[2].title.startsWith("Game controller"));
    EXPECT_EQ(choices.back().outputs, 0) << "no device at last";
}

TEST(FirstStart, OneClickToTheFirstPulseThenEachActuatorInTurn) {
    MixerModel model{onlyNoDevice(), noDevice};
    bool hasEnded = false;
    FirstStart card{model, {{"no device, four outputs", noDevice, 4}}};
    card.onEnd = [&](bool hasChosen) { hasEnded = hasChosen; };
    card.test(4); // as Play here does when the device is open
    EXPECT_EQ(card.tested(), 0);
    EXPECT_EQ(model.mix().levelDb, FirstStart::startDb) << "from low";
    EXPECT_TRUE(runUntil([&] { return model.poll().meters.peaks[0] > 0.01f; }));
    card.raiseLevel();
    EXPECT_EQ(model.mix().levelDb, FirstStart::startDb + FirstStart::stepDb);
    card.confirmPulseAt(0.5, 0.25);
    EXPECT_NEAR(model.mix().layout.geometry.places[0].xMetres,
                0.5 * model.mix().layout.geometry.extentWidthMetres, 1e-12);
    card.keyPressed(KeyPress{KeyPress::returnKey});
    EXPECT_EQ(card.tested(), 2);
    card.keyPressed(KeyPress{'N', {}, 'n'});
    EXPECT_EQ(model.mix().strips[2].output, -1);
    EXPECT_FALSE(hasEnded);
    card.confirmPulse();
    EXPECT_TRUE(hasEnded);
    EXPECT_GT(model.session().world().slowness(), 0) << "the world goes on";
    EXPECT_EQ(model.messageText(), "It stays as quiet as it was tested: the master's fader raises it");
}

TEST(FirstStart, HeadphonesHaveTheFirstActuatorLeftAndTheSecondRight) {
    MixerModel model{onlyNoDevice(), noDevice};
    bool hasEnded = false;
    FirstStart card{model, {{"headphones", noDevice, 2, false, true}}};
    card.onEnd = [&](bool hasChosen) { hasEnded = hasChosen; };
    card.openChosen();
    EXPECT_TRUE(hasEnded);
    ASSERT_EQ(model.mix().count(), 2);
    EXPECT_EQ(model.output().channelMap(), (std::vector{0, 1}));
    EXPECT_EQ(model.mix().levelDb, defaultContactDb) << "no louder than a monitor begins";
    EXPECT_TRUE(model.device().listening().settings().contacts.empty());
    EXPECT_FALSE(model.undoManager().canUndo()) << "which would be louder";
    const auto end = juce::Time::getMillisecondCounter() + 2500; // the device is looked at once a second
    EXPECT_TRUE(runUntil([&] { return model.poll(), juce::Time::getMillisecondCounter() > end; }));
    EXPECT_EQ(model.messageText(), "");
}

} // namespace physvib::draw_test
