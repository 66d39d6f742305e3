// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the pointer has its own menu; motors, rain, and an inspector that covers nothing selected.
#include "Mixer/World/DrawBar.h"
#include "NewSceneRig.h"

namespace physvib {
namespace {

using namespace test;

struct Field : NewSceneRig {
    WorldPanel& panel = view.world();

    void add(DrawTool tool, double x, double y) { pane.addAt(tool, share(x, y)), settle(); }
    juce::PopupMenu menuAt(Vector place) { return panel.menuAt(world.placeOfMetres(place)); }
};

juce::StringArray wordsOf(const juce::PopupMenu& menu) {
    juce::StringArray words;
    for (juce::PopupMenu::MenuItemIterator it{menu}; it.next();)
        if (!it.getItem().isSeparator) words.add(it.getItem().text);
    return words;
}

void press(const juce::PopupMenu& menu, const juce::String& words) {
    for (juce::PopupMenu::MenuItemIterator it{menu, true}; it.next();)
        if (it.getItem().text == words) {
            ASSERT_TRUE(it.getItem().isEnabled) << words;
            return it.getItem().action();
        }
    FAIL() << words << " is not among " << wordsOf(menu).joinIntoString(", ");
}

TEST(WorldMenu, EachThingHasItsOwn) {
    Field f;
    f.add(DrawTool::ball, 0.5, 0.5);
    const auto ball = wordsOf(f.menuAt(f.share(0.5, 0.5))), empty = wordsOf(f.menuAt(f.share(0.2, 0.8))),
               badge = wordsOf(f.panel.menuAt(f.world.placeOfEnchanter(0)));
    for (const char* words : {"ball 1", "Material", "Motor here", "Copy", "Delete"})
        EXPECT_TRUE(ball.contains(words)) << words << ": " << ball.joinIntoString(", ");
    for (const char* words : {"Add ball", "Add box", "Add rain", "Paste here", "Attach an actuator here"})
        EXPECT_TRUE(empty.contains(words)) << words << ": " << empty.joinIntoString(", ");
    for (const char* words : {"Actuator A", "Test pulse", "Sweep", "Mute", "Detach"})
        EXPECT_TRUE(badge.contains(words)) << words << ": " << badge.joinIntoString(", ");
    EXPECT_FALSE(ball.contains("Detach") || badge.contains("Material") || empty.contains("Delete"));
    const auto& floor = f.drawn().bodies[0];
    const auto under =
        wordsOf(f.menuAt(f.world.poseOfBody(floor.name) ? Vector{f.world.poseOfBody(floor.name)->xMetres,
                                                                 f.world.poseOfBody(floor.name)->yMetres}
                                                        : Vector{}));
    EXPECT_TRUE(under.contains(utf8(floor.name)) && under.contains("Material")) << under.joinIntoString(", ");
}

TEST(Hands, ABodyThatWasLetGoIsNotHeldAgain) {
    Field f;
    f.add(DrawTool::ball, 0.5, 0.5);
    for (int k = 0; k < 20; ++k)
        f.world.onHold("ball 1", {}, f.share(0.5, 0.5 + 0.01 * k)); // one still waits
    f.world.onLetGo("ball 1");
    runFor(0.05);
    f.view.refresh();
    const GripAction* last = nullptr;
    const auto saved = f.model.saved();
    for (const LiveInput& input : saved.log.takes.back().inputs)
        if (const auto* grip = std::get_if<GripAction>(&input.action)) last = grip;
    ASSERT_NE(last, nullptr);
    EXPECT_FALSE(last->toMetres);
}

TEST(WorldMenu, WhatItSaysIsDone) {
    Field f;
    f.add(DrawTool::ball, 0.5, 0.5);
    const auto at = f.share(0.5, 0.5);
    const int drawn = f.model.world().drawing().find("ball 1")->fixtures[0].material;
    int other = 0;
    while (other == drawn || f.drawn().materials[static_cast<std::size_t>(other)].frequencyHz <= 0.0) ++other;
    press(f.menuAt(at), utf8(f.drawn().materials[static_cast<std::size_t>(other)].name));
    EXPECT_EQ(f.model.world().drawing().find("ball 1")->fixtures[0].material, other) << f.model.trouble();
    press(f.menuAt(at), "Copy");
    press(f.menuAt(f.share(0.2, 0.8)), "Paste here");
    f.settle();
    const auto* pasted = f.model.world().drawing().find("ball 2");
    ASSERT_NE(pasted, nullptr) << f.model.trouble();
    EXPECT_NEAR(pasted->positionMetres.x, f.share(0.2, 0.8).x, 0.01 * f.drawn().fieldWidthMetres);
    EXPECT_NEAR(pasted->positionMetres.y, f.share(0.2, 0.8).y, 0.01 * f.drawn().fieldHeightMetres);
    f.pane.use(DrawTool::hand);
    press(f.menuAt(at), "Delete");
    EXPECT_EQ(f.model.world().drawing().find("ball 1"), nullptr);
    f.model.undoManager().undo();
    EXPECT_NE(f.model.world().drawing().find("ball 1"), nullptr);
    f.settle();
    press(f.menuAt(f.share(0.8, 0.8)), "Add box");
    EXPECT_NE(f.model.world().drawing().find("box 1"), nullptr);
    EXPECT_EQ(f.pane.tool(), DrawTool::hand) << "the tool stays";
    press(f.menuAt(f.share(0.6, 0.9)), "Attach an actuator here");
    EXPECT_EQ(f.model.mix().count(), 5);
    f.settle();
    press(f.panel.menuAt(f.world.placeOfEnchanter(4)), "Detach");
    EXPECT_EQ(f.model.mix().count(), 4);
    const auto strikes = f.model.saved().log.strikes.size();
    press(f.panel.menuAt(f.world.placeOfEnchanter(1)), "Mute");
    EXPECT_TRUE(f.model.mix().strips[1].isMuted);
    press(f.panel.menuAt(f.world.placeOfEnchanter(1)), "Test pulse");
    EXPECT_EQ(f.model.saved().log.strikes.size(), strikes + 1);
}

TEST(WorldMenu, ARightClickOpensItWithEveryToolAndDrawsNothing) {
    Field f;
    int asked = 0;
    f.world.onMenu = f.pane.onMenu = [&](juce::Point<float>) { ++asked; };
    const auto bodies = f.drawn().bodies.size();
    const auto click = mouseAt(f.pane, {300.0f, 200.0f}, juce::ModifierKeys::rightButtonModifier);
    for (const auto& words : drawTools) {
        f.pane.use(words.tool);
        f.pane.mouseDown(click);
        f.pane.mouseUp(click);
    }
    EXPECT_EQ(asked, static_cast<int>(drawTools.size()));
    f.world.mouseDown(mouseAt(f.world, {300.0f, 200.0f}, juce::ModifierKeys::rightButtonModifier));
    EXPECT_EQ(asked, static_cast<int>(drawTools.size()) + 1);
    EXPECT_EQ(f.drawn().bodies.size(), bodies);
}

TEST(Motor, SpeedAndTorqueAreChangedInTheInspectorAndUndone) {
    Field f;
    f.add(DrawTool::box, 0.5, 0.5);
    press(f.menuAt(f.share(0.5, 0.5)), "Motor here");
    ASSERT_EQ(f.drawn().joints.size(), 1u) << f.model.trouble();
    f.settle();
    const auto before = driveOf(f.drawn().joints[0]);
    EXPECT_GT(before.maxTorqueNewtonMetres, 0.0);
    press(f.menuAt(f.share(0.5, 0.5)), "Motor: speed and torque");
    auto *speed = dynamic_cast<juce::Slider*>(find(f.panel, "Motor speed")),
         *torque = dynamic_cast<juce::Slider*>(find(f.panel, "Motor torque"));
    ASSERT_TRUE(speed != nullptr && torque != nullptr);
    EXPECT_NEAR(speed->getValue(), before.radiansPerSecond, 0.05);
    EXPECT_TRUE(speed->getTextFromValue(speed->getValue()).endsWith(" rad/s"));
    EXPECT_TRUE(torque->getTextFromValue(torque->getValue()).endsWith(" N m"));
    EXPECT_GT(speed->getHeight(), 14);
    speed->setValue(-8.0, juce::sendNotificationSync);
    torque->setValue(5'000.0, juce::sendNotificationSync);
    ASSERT_EQ(f.drawn().joints.size(), 1u) << f.model.trouble();
    EXPECT_NEAR(driveOf(f.drawn().joints[0]).radiansPerSecond, -8.0, 1e-9);
    EXPECT_NEAR(driveOf(f.drawn().joints[0]).maxTorqueNewtonMetres, 5'000.0, 1e-9);
    f.settle();
    f.model.setSlowness(1);
    const double angle = f.world.poseOfBody("box 1")->angleRadians;
    runFor(1.0);
    f.view.refresh();
    EXPECT_LT(f.world.poseOfBody("box 1")->angleRadians, angle - 1.0) << "it turns the other way now";
    f.model.undoManager().undo();
    f.model.undoManager().undo();
    EXPECT_EQ(driveOf(f.drawn().joints[0]), before);
    f.pane.choose({"box 1"});
    f.add(DrawTool::ball, 0.2, 0.8);
    f.pane.use(DrawTool::choose);
    f.pane.choose({"ball 1"});
    EXPECT_FALSE(speed->isVisible()) << "a body without one has no such rows";
}

TEST(Spring, HangsABodyAndItsStiffnessIsChangedInTheInspectorAndUndone) {
    Field f;
    f.add(DrawTool::ball, 0.5, 0.5);
    press(f.menuAt(f.share(0.5, 0.5)), "Spring here");
    ASSERT_EQ(f.drawn().joints.size(), 1u) << f.model.trouble();
    f.settle();
    const auto spring = std::get<DistanceJoint>(f.drawn().joints[0].joint);
    EXPECT_FALSE(spring.isSlack);
    EXPECT_GT(spring.springHz, 0.0);
    press(f.menuAt(f.share(0.5, 0.5)), "Spring: stiffness");
    auto* stiffness = dynamic_cast<juce::Slider*>(find(f.panel, "Stiffness of the spring"));
    ASSERT_NE(stiffness, nullptr);
    EXPECT_NEAR(stiffness->getValue(), spring.springHz, 0.05);
    EXPECT_GT(stiffness->getHeight(), 14);
    EXPECT_LE(stiffness->getBottom(), stiffness->getParentComponent()->getHeight());
    stiffness->setValue(0.5, juce::sendNotificationSync);
    ASSERT_EQ(f.drawn().joints.size(), 1u) << f.model.trouble();
    const auto softer = std::get<DistanceJoint>(f.drawn().joints[0].joint);
    EXPECT_NEAR(softer.springHz, 0.5, 1e-9);
    EXPECT_EQ(softer.anchorAMetres, spring.anchorAMetres);
    EXPECT_EQ(softer.anchorBMetres, spring.anchorBMetres) << "its length stays";
    f.settle();
    const double from = f.world.poseOfBody("ball 1")->yMetres;
    f.model.setSlowness(1);
    runFor(0.7);
    f.view.refresh();
    const double y = f.world.poseOfBody("ball 1")->yMetres, high = f.drawn().fieldHeightMetres;
    EXPECT_LT(y, from - 0.02 * high) << "it gives way";
    f.model.undoManager().undo();
    EXPECT_EQ(std::get<DistanceJoint>(f.drawn().joints[0].joint), spring);
}

TEST(Rain, HasTheNumberAndMaterialThatWereChosenAsOneEdit) {
    Field f;
    f.pane.use(DrawTool::rain);
    auto* count = dynamic_cast<juce::ComboBox*>(find(f.panel, "Balls of a rain"));
    ASSERT_NE(count, nullptr);
    EXPECT_TRUE(count->isVisible());
    count->setSelectedId(100, juce::sendNotificationSync);
    f.pane.setMaterial(2);
    const auto before = f.drawn().bodies.size();
    f.add(DrawTool::rain, 0.5, 0.7);
    ASSERT_EQ(f.drawn().bodies.size(), before + 100) << f.model.trouble();
    const auto& balls = f.drawn().bodies;
    for (std::size_t i = before; i < balls.size(); ++i) {
        EXPECT_EQ(balls[i].fixtures[0].material, 2);
        const double radius = std::get<CircleShape>(balls[i].fixtures[0].shape).radiusMetres;
        for (std::size_t k = before; k < i; ++k)
            EXPECT_GT(std::hypot(balls[i].positionMetres.x - balls[k].positionMetres.x,
                                 balls[i].positionMetres.y - balls[k].positionMetres.y),
                      2.0 * radius)
                << "they do not touch";
    }
    f.model.undoManager().undo();
    EXPECT_EQ(f.drawn().bodies.size(), before) << "one edit";
    f.pane.use(DrawTool::ball);
    EXPECT_FALSE(count->isVisible());
}

TEST(Inspector, NeverCoversWhatIsSelectedAndNamesItsMaterial) {
    Field f;
    f.pane.use(DrawTool::choose);
    auto* inspector = find(f.panel, "Chosen bodies");
    for (const auto& [x, y] : {std::pair{0.93, 0.93}, {0.07, 0.93}, {0.93, 0.15}, {0.07, 0.15}, {0.5, 0.5}}) {
        f.add(DrawTool::ball, x, y);
        f.pane.use(DrawTool::choose);
        const auto name = f.drawn().bodies.back().name;
        f.pane.choose({name});
        f.view.refresh();
        ASSERT_TRUE(inspector->isVisible());
        const auto body = juce::Rectangle<float>{70.0f, 70.0f}.withCentre(f.world.placeOfBody(name));
        EXPECT_FALSE((inspector->getBounds() - f.world.getPosition()).toFloat().intersects(body))
            << x << ", " << y;
        EXPECT_TRUE(f.panel.getLocalBounds().contains(inspector->getBounds())) << x << ", " << y;
    }
    f.pane.setMaterial(3);
    f.model.dispatchPendingMessages();
    f.pane.choose({f.drawn().bodies.back().name});
    EXPECT_EQ(f.pane.material(), 3);
    const auto& named = dynamic_cast<juce::Button&>(*find(*inspector, "Material of what is chosen"));
    EXPECT_EQ(named.getButtonText(), utf8(f.drawn().materials[3].name));
}

TEST(Inspector, ASwatchGivesWhatIsChosenItsMaterialAndOneUndoTakesItBack) {
    Field f;
    std::vector<std::string> names;
    for (const double x : {0.3, 0.6})
        f.add(DrawTool::ball, x, 0.5), names.push_back(f.drawn().bodies.back().name);
    f.pane.use(DrawTool::ball); // the palette is for the next one
    f.pane.choose(names);
    const auto materials = [&] {
        std::vector<int> all;
        for (const auto& name : names)
            all.push_back(f.model.world().drawing().find(name)->fixtures[0].material);
        return all;
    };
    const auto before = materials();
    ASSERT_NE(before[0], 1);
    auto* const swatch =
        dynamic_cast<juce::Button*>(find(f.panel, "Made of " + utf8(f.drawn().materials[1].name)));
    ASSERT_NE(swatch, nullptr);
    EXPECT_GE(std::min(swatch->getWidth(), swatch->getHeight()), 24);
    EXPECT_TRUE(swatch->getParentComponent()->getLocalBounds().contains(swatch->getBounds()));
    const int next = f.pane.material();
    swatch->onClick();
    f.settle();
    EXPECT_EQ(materials(), (std::vector{1, 1})) << f.model.trouble();
    EXPECT_TRUE(swatch->getToggleState());
    EXPECT_EQ(f.pane.material(), next);
    f.model.undoManager().undo();
    EXPECT_EQ(materials(), before);
}

TEST(Inspector, CoversNoBadgeAndStaysWhereItIs) {
    Field f;
    f.view.setSize(1280, 800);
    f.pane.use(DrawTool::rain);
    f.pane.addAt(DrawTool::rain, f.share(0.5, 0.9));
    f.settle();
    f.pane.use(DrawTool::choose);
    f.pane.choose({f.drawn().bodies.back().name});
    f.view.refresh();
    auto* inspector = find(f.panel, "Chosen bodies");
    ASSERT_TRUE(inspector->isVisible());
    const auto place = inspector->getBounds();
    EXPECT_LE(place.getWidth() * place.getHeight(), 210 * 160) << "small beside a small field";
    for (int j = 0; j < f.model.mix().count(); ++j)
        EXPECT_TRUE(
            place.getIntersection(f.world.badgeAt(j).toNearestInt() + f.world.getPosition()).isEmpty())
            << j;
    for (int k = 0; k < 5; ++k) f.view.refresh();
    EXPECT_EQ(inspector->getBounds(), place);
    f.view.setMode(Mode::play); // no room beside the field
    f.view.setSize(1024, 700);
    f.view.refresh();
    auto& world = f.panel.view();
    const auto field = juce::Rectangle<float>{world.placeOfShare({0.0, 1.0}), world.placeOfShare({1.0, 0.0})};
    EXPECT_TRUE((inspector->getBounds() - world.getPosition()).toFloat().getIntersection(field).isEmpty())
        << "nothing of the field is hidden";
    EXPECT_GE(field.getWidth() * field.getHeight(), 0.45f * 1024.0f * 700.0f);
    f.model.report("a message");
    f.model.dispatchPendingMessages();
    for (const Mode mode : {Mode::play, Mode::engineer}) {
        f.view.setMode(mode);
        const auto banner = find(f.view, "Trouble")->getBounds() - f.panel.getPosition();
        for (const char* title : {"Materials to draw with", "Chosen bodies"})
            EXPECT_FALSE(banner.intersects(find(f.panel, title)->getBounds())) << title;
    }
}

TEST(Inspector, CoversNoCornerNoBodyAndNoTopWallBesideADrawer) {
    Field f;
    f.view.setMode(Mode::engineer);
    f.view.setPanels({true, true});
    f.view.setSize(1280, 800);
    auto* inspector = find(f.panel, "Chosen bodies");
    for (const auto& [x, y] : {std::pair{0.9, 0.9}, {0.1, 0.9}, {0.5, 0.5}, {0.9, 0.1}}) {
        f.add(DrawTool::ball, x, y);
        f.pane.use(DrawTool::choose);
        const auto name = f.drawn().bodies.back().name;
        f.pane.choose({name});
        f.view.refresh();
        const auto place = inspector->getBounds() - f.world.getPosition();
        EXPECT_FALSE(place.toFloat().intersects(
            juce::Rectangle<float>{40.0f, 40.0f}.withCentre(f.world.placeOfBody(name))))
            << x << ", " << y;
        for (int j = 0; j < f.model.mix().count(); ++j)
            EXPECT_FALSE(place.toFloat().intersects(f.world.badgeAt(j))) << j << " at " << x << ", " << y;
        EXPECT_GT(place.toFloat().getY(), f.world.placeOfShare({0.0, 1.0}).y + 4.0f)
            << "the wall is in sight";
        EXPECT_TRUE(f.panel.getLocalBounds().contains(inspector->getBounds()));
    }
}

TEST(Inspector, HasAPlaceOfItsOwnWhereverTheBodyIs) {
    for (const auto& [width, height] : {std::pair{1440, 900}, {1024, 700}}) {
        Field f;
        f.view.setSize(width, height);
        f.view.setMode(width > 1200 ? Mode::engineer : Mode::play);
        f.pane.use(DrawTool::choose);
        auto* inspector = find(f.panel, "Chosen bodies");
        std::vector<juce::Rectangle<int>> places;
        for (const double y : {0.2, 0.5, 0.8}) {
            f.add(DrawTool::ball, 0.45, y);
            f.pane.use(DrawTool::choose);
            f.pane.choose({f.drawn().bodies.back().name});
            f.view.refresh();
            places.push_back(inspector->getBounds());
        }
        EXPECT_TRUE(places[0] == places[1] && places[1] == places[2])
            << width << ": " << places[0].toString() << "; " << places[2].toString();
    }
}

TEST(Badges, OfSixtyFourActuatorsEachShowsItsWholeLabel) {
    Field f;
    while (f.model.mix().count() < 64 && f.model.attach(0.5, 0.5)) {
    }
    f.model.dispatchPendingMessages();
    for (int j = 0; j < 64; ++j) {
        const auto label = utf8(f.model.mix().layout.enchanters[static_cast<std::size_t>(j)].label);
        EXPECT_GE(f.world.badgeAt(j).getWidth(),
                  text::width(text::font(text::small, juce::Font::bold), label))
            << label;
    }
}

} // namespace
} // namespace physvib
