// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the pointer has its own menu; motors, rain, and an inspector that covers nothing selected.
#include "Mixer/World/DrawBar.h"
#include "NewSceneRig.h"

namespace physvib::world_menu_test {

using namespace test;

struct Field : NewSceneRig {
    WorldPanel& panel = view.world();

    void add(DrawTool tool, double x, double y) { pane.addAt(tool, share(x, y)), settle(); }
    juce::PopupMenu makeMenu(Vector place) { return panel.makeMenu(world.pixelOfMetres(place)); }
};

struct OnField : testing::Test, Field {};

TEST_F(OnField, EachThingHasItsOwn) {
    add(DrawTool::ball, 0.5, 0.5);
    const auto ball = wordsOf(makeMenu(share(0.5, 0.5))), empty = wordsOf(makeMenu(share(0.2, 0.8))),
               badge = wordsOf(panel.makeMenu(world.actuatorPixel(0)));
    for (const char* words : {"ball 1", "Material", "Motor here", "Copy", "Delete"})
        EXPECT_TRUE(ball.contains(words)) << words << ": " << ball.joinIntoString(", ");
    for (const char* words : {"Add ball", "Add box", "Add rain", "Paste here", "Attach an actuator here"})
        EXPECT_TRUE(empty.contains(words)) << words << ": " << empty.joinIntoString(", ");
    for (const char* words : {"Actuator A", "Test pulse", "Sweep", "Mute", "Detach"})
        EXPECT_TRUE(badge.contains(words)) << words << ": " << badge.joinIntoString(", ");
    EXPECT_FALSE(ball.contains("Detach") || badge.contains("Material") || empty.contains("Delete"));
    const auto& floor = drawn().bodies[0];
    const auto under =
        wordsOf(makeMenu(world.poseOfBody(floor.name) ? Vector{world.poseOfBody(floor.name)->xMetres,
                                                               world.poseOfBody(floor.name)->yMetres}
                                                      : Vector{}));
    EXPECT_TRUE(under.contains(utf8(floor.name)) && under.contains("Material")) << under.joinIntoString(", ");
}

TEST_F(OnField, ABodyThatWasLetGoIsNotHeldAgain) {
    add(DrawTool::ball, 0.5, 0.5);
    for (int k = 0; k < 20; ++k) world.onHold("ball 1", {}, share(0.5, 0.5 + 0.01 * k)); // one still waits
    world.onRelease("ball 1");
    runFor(0.05);
    view.refresh();
    const GripAction* last = nullptr;
    const auto saved = model.savedSession();
    for (const LiveInput& input : saved.log.runs.back().inputs)
        if (const auto* grip = std::get_if<GripAction>(&input.action)) last = grip;
    ASSERT_NE(last, nullptr);
    EXPECT_FALSE(last->toMetres);
}

TEST_F(OnField, WhatItSaysIsDone) {
    add(DrawTool::ball, 0.5, 0.5);
    const auto at = share(0.5, 0.5);
    const int own = body("ball 1")->fixtures[0].material;
    int other = 0;
    while (other == own || nth(drawn().materials, other).frequencyHz <= 0.0) ++other;
    press(makeMenu(at), utf8(nth(drawn().materials, other).name));
    EXPECT_EQ(body("ball 1")->fixtures[0].material, other) << model.messageText();
    press(makeMenu(at), "Copy");
    press(makeMenu(share(0.2, 0.8)), "Paste here");
    settle();
    const auto* pasted = body("ball 2");
    ASSERT_NE(pasted, nullptr) << model.messageText();
    EXPECT_NEAR(pasted->positionMetres.x, share(0.2, 0.8).x, 0.01 * drawn().fieldWidthMetres);
    EXPECT_NEAR(pasted->positionMetres.y, share(0.2, 0.8).y, 0.01 * drawn().fieldHeightMetres);
    pane.setTool(DrawTool::hand);
    press(makeMenu(at), "Delete");
    EXPECT_EQ(body("ball 1"), nullptr);
    undo();
    EXPECT_NE(body("ball 1"), nullptr);
    settle();
    press(makeMenu(share(0.8, 0.8)), "Add box");
    EXPECT_NE(body("box 1"), nullptr);
    EXPECT_EQ(pane.tool(), DrawTool::hand) << "the tool stays";
    press(makeMenu(share(0.6, 0.9)), "Attach an actuator here");
    EXPECT_EQ(model.mix().count(), 5);
    settle();
    press(panel.makeMenu(world.actuatorPixel(4)), "Detach");
    EXPECT_EQ(model.mix().count(), 4);
    const auto strikes = model.savedSession().log.strikes.size();
    press(panel.makeMenu(world.actuatorPixel(1)), "Mute");
    EXPECT_TRUE(model.mix().strips[1].isMuted);
    press(panel.makeMenu(world.actuatorPixel(1)), "Test pulse");
    EXPECT_EQ(model.savedSession().log.strikes.size(), strikes + 1);
}

TEST_F(OnField, ARightClickOpensItWithEveryToolAndDrawsNothing) {
    int asked = 0;
    world.onMenu = pane.onMenu = [&](juce::Point<float>) { ++asked; };
    const auto bodies = drawn().bodies.size();
    const auto click = mouseAt(pane, {300.0f, 200.0f}, juce::ModifierKeys::rightButtonModifier);
    for (const auto& words : drawTools) {
        pane.setTool(words.tool);
        pane.mouseDown(click);
        pane.mouseUp(click);
    }
    EXPECT_EQ(asked, static_cast<int>(drawTools.size()));
    world.mouseDown(mouseAt(world, {300.0f, 200.0f}, juce::ModifierKeys::rightButtonModifier));
    EXPECT_EQ(asked, static_cast<int>(drawTools.size()) + 1);
    EXPECT_EQ(drawn().bodies.size(), bodies);
}

TEST_F(OnField, SpeedAndTorqueAreChangedInTheInspectorAndUndone) {
    add(DrawTool::box, 0.5, 0.5);
    press(makeMenu(share(0.5, 0.5)), "Motor here");
    ASSERT_EQ(drawn().joints.size(), 1u) << model.messageText();
    settle();
    const auto before = driveOf(drawn().joints[0]);
    EXPECT_GT(before.maxTorqueNewtonMetres, 0.0);
    press(makeMenu(share(0.5, 0.5)), "Motor: speed and torque");
    auto *speed = dynamic_cast<juce::Slider*>(find(panel, "Motor speed")),
         *torque = dynamic_cast<juce::Slider*>(find(panel, "Motor torque"));
    ASSERT_TRUE(speed != nullptr && torque != nullptr);
    EXPECT_NEAR(speed->getValue(), before.speedRadiansPerSecond, 0.05);
    EXPECT_TRUE(speed->getTextFromValue(speed->getValue()).endsWith(" rad/s"));
    EXPECT_TRUE(torque->getTextFromValue(torque->getValue()).endsWith(" N m"));
    EXPECT_GT(speed->getHeight(), 14);
    speed->setValue(-8.0, juce::sendNotificationSync);
    torque->setValue(5'000.0, juce::sendNotificationSync);
    ASSERT_EQ(drawn().joints.size(), 1u) << model.messageText();
    EXPECT_NEAR(driveOf(drawn().joints[0]).speedRadiansPerSecond, -8.0, 1e-9);
    EXPECT_NEAR(driveOf(drawn().joints[0]).maxTorqueNewtonMetres, 5'000.0, 1e-9);
    settle();
    model.setSlowness(1);
    const double angle = world.poseOfBody("box 1")->angleRadians;
    runFor(1.0);
    view.refresh();
    EXPECT_LT(world.poseOfBody("box 1")->angleRadians, angle - 1.0) << "it turns the other way now";
    undo();
    undo();
    EXPECT_EQ(driveOf(drawn().joints[0]), before);
    pane.select({"box 1"});
    add(DrawTool::ball, 0.2, 0.8);
    pane.setTool(DrawTool::select);
    pane.select({"ball 1"});
    EXPECT_FALSE(speed->isVisible()) << "a body without one has no such rows";
}

TEST_F(OnField, HangsABodyAndItsStiffnessIsChangedInTheInspectorAndUndone) {
    add(DrawTool::ball, 0.5, 0.5);
    press(makeMenu(share(0.5, 0.5)), "Spring here");
    ASSERT_EQ(drawn().joints.size(), 1u) << model.messageText();
    settle();
    const auto spring = std::get<DistanceJoint>(drawn().joints[0].joint);
    EXPECT_FALSE(spring.isSlack);
    EXPECT_GT(spring.springHz, 0.0);
    press(makeMenu(share(0.5, 0.5)), "Spring: stiffness");
    auto& stiffness = the<juce::Slider>(panel, "Stiffness of the spring");
    EXPECT_NEAR(stiffness.getValue(), spring.springHz, 0.05);
    EXPECT_GT(stiffness.getHeight(), 14);
    EXPECT_LE(stiffness.getBottom(), stiffness.getParentComponent()->getHeight());
    stiffness.setValue(0.5, juce::sendNotificationSync);
    ASSERT_EQ(drawn().joints.size(), 1u) << model.messageText();
    const auto softer = std::get<DistanceJoint>(drawn().joints[0].joint);
    EXPECT_NEAR(softer.springHz, 0.5, 1e-9);
    EXPECT_EQ(softer.anchorAMetres, spring.anchorAMetres);
    EXPECT_EQ(softer.anchorBMetres, spring.anchorBMetres) << "its length stays";
    settle();
    const double from = world.poseOfBody("ball 1")->yMetres;
    model.setSlowness(1);
    runFor(0.7);
    view.refresh();
    const double y = world.poseOfBody("ball 1")->yMetres, high = drawn().fieldHeightMetres;
    EXPECT_LT(y, from - 0.02 * high) << "it gives way";
    undo();
    EXPECT_EQ(std::get<DistanceJoint>(drawn().joints[0].joint), spring);
}

TEST_F(OnField, HasTheNumberAndMaterialThatWereChosenAsOneEdit) {
    pane.setTool(DrawTool::rain);
    auto& count = the<juce::ComboBox>(panel, "Balls of a rain");
    EXPECT_TRUE(count.isVisible());
    count.setSelectedId(100, juce::sendNotificationSync);
    pane.setMaterial(2);
    const auto before = drawn().bodies.size();
    add(DrawTool::rain, 0.5, 0.7);
    ASSERT_EQ(drawn().bodies.size(), before + 100) << model.messageText();
    const auto& balls = drawn().bodies;
    for (std::size_t i = before; i < balls.size(); ++i) {
        EXPECT_EQ(balls[i].fixtures[0].material, 2);
        const double radius = std::get<CircleShape>(balls[i].fixtures[0].shape).radiusMetres;
        for (std::size_t k = before; k < i; ++k)
            EXPECT_GT(std::hypot(balls[i].positionMetres.x - balls[k].positionMetres.x,
                                 balls[i].positionMetres.y - balls[k].positionMetres.y),
                      2.0 * radius)
                << "they do not touch";
    }
    undo();
    EXPECT_EQ(drawn().bodies.size(), before) << "one edit";
    pane.setTool(DrawTool::ball);
    EXPECT_FALSE(count.isVisible());
}

TEST_F(OnField, NeverCoversWhatIsSelectedNorBesideADrawerBadgesAndTheTopWallAndNamesItsMaterial) {
    auto* inspector = find(panel, "Chosen bodies");
    for (const bool hasDrawers : {false, true}) {
        if (hasDrawers) view.setMode(Mode::engineer), view.setPanels({true, true}), view.setSize(1280, 800);
        for (const auto& [x, y] :
             {std::pair{0.93, 0.93}, {0.07, 0.93}, {0.93, 0.1}, {0.07, 0.15}, {0.5, 0.5}}) {
            add(DrawTool::ball, x, y);
            pane.setTool(DrawTool::select);
            const auto name = drawn().bodies.back().name;
            pane.select({name});
            view.refresh();
            ASSERT_TRUE(inspector->isVisible());
            const auto place = (inspector->getBounds() - world.getPosition()).toFloat();
            const float side = hasDrawers ? 40.0f : 70.0f;
            EXPECT_FALSE(
                place.intersects(juce::Rectangle<float>{side, side}.withCentre(world.pixelOfBody(name))))
                << x << ", " << y;
            EXPECT_TRUE(panel.getLocalBounds().contains(inspector->getBounds())) << x << ", " << y;
            for (int j = 0; hasDrawers && j < model.mix().count(); ++j)
                EXPECT_FALSE(place.intersects(world.badgeAt(j))) << j << " at " << x << ", " << y;
            if (hasDrawers)
                EXPECT_GT(place.getY(), world.pixelOfShare({0.0, 1.0}).y + 4.0f) << "the wall is in sight";
        }
    }
    pane.setMaterial(3);
    model.dispatchPendingMessages();
    pane.select({drawn().bodies.back().name});
    EXPECT_EQ(pane.material(), 3);
    const auto& named = the<juce::Button>(*inspector, "Material of what is chosen");
    EXPECT_EQ(named.getButtonText(), utf8(drawn().materials[3].name));
}

TEST_F(OnField, ASwatchGivesWhatIsChosenItsMaterialAndOneUndoTakesItBack) {
    std::vector<std::string> names;
    for (const double x : {0.3, 0.6})
        add(DrawTool::ball, x, 0.5), names.push_back(drawn().bodies.back().name);
    pane.setTool(DrawTool::ball); // the palette is for the next one
    pane.select(names);
    const auto materials = [&] {
        std::vector<int> all;
        for (const auto& name : names) all.push_back(body(name)->fixtures[0].material);
        return all;
    };
    const auto before = materials();
    ASSERT_NE(before[0], 1);
    auto& swatch = the<juce::Button>(panel, "Made of " + utf8(drawn().materials[1].name));
    EXPECT_GE(std::min(swatch.getWidth(), swatch.getHeight()), 24);
    EXPECT_TRUE(swatch.getParentComponent()->getLocalBounds().contains(swatch.getBounds()));
    const int next = pane.material();
    swatch.onClick();
    settle();
    EXPECT_EQ(materials(), (std::vector{1, 1})) << model.messageText();
    EXPECT_TRUE(swatch.getToggleState());
    EXPECT_EQ(pane.material(), next);
    undo();
    EXPECT_EQ(materials(), before);
}

TEST_F(OnField, CoversNoBadgeAndStaysWhereItIs) {
    view.setSize(1280, 800);
    pane.setTool(DrawTool::rain);
    pane.addAt(DrawTool::rain, share(0.5, 0.9));
    settle();
    pane.setTool(DrawTool::select);
    pane.select({drawn().bodies.back().name});
    view.refresh();
    auto& inspector = the(panel, "Chosen bodies");
    ASSERT_TRUE(inspector.isVisible());
    const auto place = inspector.getBounds();
    EXPECT_LE(place.getWidth() * place.getHeight(), 210 * 160) << "small beside a small field";
    for (int j = 0; j < model.mix().count(); ++j)
        EXPECT_TRUE(place.getIntersection(world.badgeAt(j).toNearestInt() + world.getPosition()).isEmpty())
            << j;
    for (int k = 0; k < 5; ++k) view.refresh();
    EXPECT_EQ(inspector.getBounds(), place);
    view.setMode(Mode::play); // no room beside the field
    view.setSize(1024, 700);
    view.refresh();
    auto& world = panel.view();
    const auto field = juce::Rectangle<float>{world.pixelOfShare({0.0, 1.0}), world.pixelOfShare({1.0, 0.0})};
    EXPECT_TRUE((inspector.getBounds() - world.getPosition()).toFloat().getIntersection(field).isEmpty())
        << "nothing of the field is hidden";
    EXPECT_GE(field.getWidth() * field.getHeight(), 0.45f * 1024.0f * 700.0f);
    model.report("a message");
    model.dispatchPendingMessages();
    for (const Mode mode : {Mode::play, Mode::engineer}) {
        view.setMode(mode);
        const auto banner = the(view, "Trouble").getBounds() - panel.getPosition();
        for (const char* title : {"Materials to draw with", "Chosen bodies"})
            EXPECT_FALSE(banner.intersects(the(panel, title).getBounds())) << title;
    }
}

TEST(Inspector, HasAPlaceOfItsOwnWhereverTheBodyIs) {
    for (const auto& [width, height] : {std::pair{1440, 900}, {1024, 700}}) {
        Field f;
        f.view.setSize(width, height);
        f.view.setMode(width > 1200 ? Mode::engineer : Mode::play);
        f.pane.setTool(DrawTool::select);
        auto& inspector = the(f.panel, "Chosen bodies");
        std::vector<juce::Rectangle<int>> places;
        for (const double y : {0.2, 0.5, 0.8}) {
            f.add(DrawTool::ball, 0.45, y);
            f.pane.setTool(DrawTool::select);
            f.pane.select({f.drawn().bodies.back().name});
            f.view.refresh();
            places.push_back(inspector.getBounds());
        }
        EXPECT_TRUE(places[0] == places[1] && places[1] == places[2])
            << width << ": " << places[0].toString() << "; " << places[2].toString();
    }
}

TEST_F(OnField, OfSixtyFourActuatorsEachShowsItsWholeLabel) {
    while (model.mix().count() < 64 && model.attach(0.5, 0.5)) {
    }
    model.dispatchPendingMessages();
    for (int j = 0; j < 64; ++j) {
        const auto label = utf8(nth(model.mix().layout.actuators, j).label);
        EXPECT_GE(world.badgeAt(j).getWidth(), text::width(text::font(text::small, juce::Font::bold), label))
            << label;
    }
}

} // namespace physvib::world_menu_test
