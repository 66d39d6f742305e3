// SPDX-License-Identifier: GPL-3.0-or-later
// The panels at any size: nothing cut, nothing crushed, and what is dragged stays.
#include "Mixer/Materials/MaterialsTab.h"
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Strips/ScopeView.h"
#include "Mixer/Studies/StudiesTab.h"
#include "MixerTesting.h"
#include <cmath>

namespace physvib::arrangement_test {

using namespace test;

constexpr std::array<std::pair<int, int>, 6> sizes{{{MixerView::minWidth, MixerView::minHeight},
                                                    {1024, 700},
                                                    {1280, 720},
                                                    {1440, 900},
                                                    {2560, 1440},
                                                    {3840, 2160}}};

constexpr std::array<std::pair<Mode, Panels>, 6> orders{{{Mode::play, {}},
                                                         {Mode::play, {false, true}},
                                                         {Mode::play, {true, true}},
                                                         {Mode::engineer, {}},
                                                         {Mode::engineer, {false, true}},
                                                         {Mode::engineer, {true, true}}}};

std::vector<juce::Rectangle<int>> panelsOf(const Arrangement& a) {
    return {a.world, a.tabs, a.scope, a.strips, a.sideDivider, a.lowerDivider, a.scopeDivider};
}

TEST(Arrangement, PanelsFillTheWindowWithoutOverlapAtEverySizeAndDivider) {
    for (const auto& [width, height] : sizes)
        for (const auto& [mode, panels] : orders)
            for (const int strips : {300, 760, 9000})
                for (const double share : {0.0, 0.05, 0.5, 0.95}) {
                    const juce::Rectangle<int> area{4, 64, width - 8, height - 102};
                    const auto a = arrange(area, {strips / 2, strips}, {share, share, share}, mode, panels);
                    const auto where = juce::String{width} + " strips " + juce::String{strips} + " at " +
                                       juce::String{share} + (mode == Mode::play ? " play " : " engineer ") +
                                       (panels.hasDrawer ? "drawer " : "") + (panels.hasLower ? "lower" : "");
                    int covered = 0;
                    const auto placed = panelsOf(a);
                    for (std::size_t i = 0; i < placed.size(); ++i) {
                        if (placed[i].isEmpty()) continue; // folded
                        EXPECT_TRUE(area.contains(placed[i])) << where << " panel " << i;
                        covered += placed[i].getWidth() * placed[i].getHeight();
                        for (std::size_t k = 0; k < i; ++k)
                            EXPECT_TRUE(placed[i].getIntersection(placed[k]).isEmpty())
                                << where << " " << i << " " << k;
                    }
                    EXPECT_EQ(covered, area.getWidth() * area.getHeight()) << where;
                    const int folded = mode == Mode::play ? 0 : TabPanel::foldedPixels;
                    EXPECT_GE(a.world.getHeight(), Arrangement::minWorldHeight) << where;
                    EXPECT_GE(a.world.getWidth(), Arrangement::minSide) << where;
                    EXPECT_GE(a.tabs.getWidth(), panels.hasDrawer ? Arrangement::minSide : folded) << where;
                    EXPECT_GE(a.scope.getHeight(), panels.hasLower ? Arrangement::minLower : folded) << where;
                    if (!panels.hasLower) continue;
                    EXPECT_GE(a.strips.getWidth(), Arrangement::minStrips) << where;
                    EXPECT_GE(a.scope.getWidth(), Arrangement::minScope) << where;
                }
}

TEST(Arrangement, TheWorldGetsTheLargestPart) {
    for (const auto& [width, height] : sizes) {
        const auto a = arrange({width, height}, {514, 760}, {}, Mode::engineer, {true, true});
        const auto area = [](const juce::Rectangle<int>& r) { return r.getWidth() * r.getHeight(); };
        for (const auto& other : {a.tabs, a.scope, a.strips}) EXPECT_GT(area(a.world), area(other)) << width;
    }
}

TEST(Arrangement, ManyStripsLeaveTheScopeItsPart) {
    for (const auto& [width, height] : sizes) {
        const auto a = arrange({width, height}, {4500, 9000}, {}, Mode::engineer, {false, true});
        EXPECT_LE(a.strips.getWidth(), std::max(width * 70 / 100, Arrangement::minStrips)) << width;
    }
}

TEST(Arrangement, DividersAreKeptAsTextAndNonsenseIsAutomatic) {
    const Dividers dividers{0.3125, 0.25, 0.5};
    EXPECT_EQ(Dividers::fromText(dividers.toText()), dividers);
    EXPECT_EQ(Dividers::fromText("nan 7 -1"), Dividers{});
    EXPECT_EQ(Dividers::fromText(""), Dividers{});
}

struct ArrangedView : testing::Test, MixerInView {
    void attachUpTo(int count) {
        while (model.mix().count() < count && model.attach(0.5, 0.5)) {
        }
        model.dispatchPendingMessages();
    }
    juce::Point<float> fieldSize() {
        const auto& world = view.world().view();
        return world.pixelOfShare({1.0, 0.0}) - world.pixelOfShare({0.0, 1.0});
    }
};

// Of the whole window, with its bar.
TEST_F(ArrangedView, TheWorldHasTheRoom) {
    for (const auto& [width, height, engineer, play] :
         {std::tuple{1024, 700, 0.45, 0.85}, {1280, 800, 0.55, 0.85}, {1440, 900, 0.55, 0.85}}) {
        view.setSize(width, height);
        for (const auto& [mode, least] : {std::pair{Mode::engineer, engineer}, {Mode::play, play}}) {
            view.setMode(mode);
            const double share = 1.0 * view.world().getWidth() * view.world().getHeight() / (width * height);
            EXPECT_GE(share, least) << width << (mode == Mode::play ? " to play" : " engineer");
            const auto field = fieldSize();
            if (width == 1280)
                EXPECT_GE(field.x * field.y / static_cast<float>(width * height),
                          mode == Mode::play ? 0.6f : 0.25f);
        }
    }
}

TEST_F(ArrangedView, ASmallWindowFoldsTheStripsUntilOneAsksForThem) {
    view.setMode(Mode::engineer);
    view.setSize(1280, 800);
    EXPECT_TRUE(the(view, "Mixer").isVisible());
    view.setSize(1024, 700);
    EXPECT_FALSE(the(view, "Mixer").isVisible());
    for (const char* title : {"Silence", "Master in a row", "Device state", "Strongest hit", "Scope"})
        EXPECT_TRUE(the(view, title).isVisible()) << title;
    const auto field = fieldSize();
    EXPECT_GE(field.x * field.y / (1024.0f * 700.0f), 0.3f);
    view.keyPressed(KeyPress{KeyPress::F3Key});
    EXPECT_TRUE(the(view, "Mixer").isVisible());
    EXPECT_EQ(view.panelLayout(), "engineer - 01");
    view.setSize(1280, 800);
    view.setSize(1024, 700);
    EXPECT_TRUE(the(view, "Mixer").isVisible()) << "as it was asked for";
}

TEST_F(ArrangedView, WhateverScrollsTheStripsAWholeOneStandsAtTheEdge) {
    view.setMode(Mode::engineer);
    view.setPanels({false, true});
    view.setSize(1280, 800);
    attachUpTo(24);
    auto& strips = the(view, "Mixer");
    juce::Viewport* row = nullptr;
    for (auto* child : strips.getChildren())
        if (auto* port = dynamic_cast<juce::Viewport*>(child)) row = port;
    ASSERT_NE(row, nullptr);
    for (const int x : {13, 100, 211, 333}) {
        row->setViewPosition(x, 0);
        bool isWhole = false;
        for (auto* strip : row->getViewedComponent()->getChildren())
            isWhole = isWhole || strip->getX() == row->getViewPositionX();
        EXPECT_TRUE(isWhole) << x;
    }
}

TEST_F(ArrangedView, ToPlayThereIsTheWorldAndWhatSilencesLimitsAndWarns) {
    view.setSize(1280, 800);
    const auto isThere = [&](const char* title) {
        return the(view, title).isShowing() || the(view, title).isVisible();
    };
    const auto areThere = [&](std::initializer_list<const char*> titles, bool are) {
        for (const char* title : titles) EXPECT_EQ(isThere(title), are) << title;
    };
    const std::initializer_list<const char*> engineers{"Tabs", "Scope", "Drag strength", "Seed",
                                                       "Slow motion"};
    areThere(engineers, true);
    view.keyPressed(KeyPress{KeyPress::F2Key});
    ASSERT_EQ(view.mode(), Mode::play);
    areThere(engineers, false);
    areThere({"Silence", "Record", "Tools", "Master gain, in a row", "Strongest hit", "Device state", "Mode"},
             true);
    areThere({"Mixer"}, false);
    view.keyPressed(KeyPress{KeyPress::F3Key});
    areThere({"Mixer", "Scope"}, true);
    areThere({"Master in a row"}, false);
    view.keyPressed(KeyPress{KeyPress::F4Key});
    areThere({"Tabs"}, true);
    model.report("a fault");
    model.dispatchPendingMessages();
    areThere({"Trouble"}, true);
    view.keyPressed(KeyPress{KeyPress::escapeKey});
    EXPECT_TRUE(model.isSilent());
    const auto order = view.panelLayout();
    view.setMode(Mode::engineer);
    EXPECT_EQ(view.panels(), (Panels{false, true})) << "each mode keeps its own";
    view.setPanelLayout(order);
    EXPECT_EQ(view.mode(), Mode::play);
    EXPECT_EQ(view.panels(), (Panels{true, true}));
    for (const char* nonsense : {"", "engineer", "play x 1 77"}) view.setPanelLayout(nonsense);
    EXPECT_EQ(view.mode(), Mode::play) << "a first start";
}

TEST_F(ArrangedView, APressOnTheNameOfAPageOpensAndFoldsIt) {
    const auto press = [&](const char* title) {
        auto& button = the<juce::Button>(view.tabs(), title);
        button.setToggleState(true, juce::dontSendNotification);
        button.onClick();
    };
    EXPECT_FALSE(view.panels().hasDrawer);
    const int wide = view.world().getWidth();
    press("Output");
    EXPECT_TRUE(view.panels().hasDrawer);
    EXPECT_TRUE(view.tabs().find<OutputTab>()->isVisible());
    EXPECT_LT(view.world().getWidth(), wide);
    press("Output");
    EXPECT_FALSE(view.panels().hasDrawer);
    EXPECT_FALSE(view.tabs().find<OutputTab>()->isVisible()) << "a folded page shows and hears nothing";
    EXPECT_EQ(view.world().getWidth(), wide);
}

TEST_F(ArrangedView, StripsWidenWithTheirPanelAndScrollWhenTheyAreMany) {
    const auto widthOf = [&](const char* title) { return the(view, title).getWidth(); };
    view.setPanels({false, true});
    view.setSize(1280, 720);
    const int narrow = widthOf("Strip A");
    auto* attach = find(view, "Attach an actuator");
    EXPECT_TRUE(find(view, "Mixer")
                    ->getLocalBounds()
                    .contains(the(view, "Mixer").getLocalArea(attach, attach->getLocalBounds())))
        << "the next place is in sight";
    view.setSize(3840, 2160);
    EXPECT_EQ(widthOf("Strip A"), StripView::maxWidth);
    EXPECT_GE(narrow, StripView::width);
    EXPECT_LT(narrow, StripView::maxWidth);
    EXPECT_TRUE(attach->isVisible());
    view.setSize(1024, 700);
    EXPECT_GE(widthOf("Mute A"), 24) << "for a pointer";
    EXPECT_GE(the(view, "Gain of A").getHeight(), 100 + 16) << "the throw, and half a cap at each end";
    attachUpTo(6);
    auto& last = the(view, "Strip F");
    const auto* row = last.findParentComponentOfClass<juce::Viewport>();
    EXPECT_EQ(row->getViewWidth() % (last.getX() / 5), 0) << "whole ones";
    attachUpTo(64);
    EXPECT_EQ(widthOf("Strip A"), StripView::width) << "64 scroll";
    EXPECT_FALSE(attach->isVisible()) << "there is no 65th";
}

TEST_F(ArrangedView, ADividerIsDraggedMovedByKeysAndMadeAutomatic) {
    view.setSize(1440, 900);
    view.setPanels({true, true});
    auto* divider = dynamic_cast<Divider*>(find(view, "Divider of world and tabs"));
    auto& tabs = the(view, "Tabs");
    ASSERT_NE(divider, nullptr);
    const int before = tabs.getWidth();
    divider->onMove(-50);
    EXPECT_NEAR(tabs.getWidth(), before + 50, 1);
    const int dragged = tabs.getWidth();
    EXPECT_TRUE(divider->keyPressed(KeyPress{KeyPress::rightKey}));
    EXPECT_NEAR(tabs.getWidth(), dragged - 16, 1);
    EXPECT_FALSE(divider->keyPressed(KeyPress{KeyPress::upKey}));
    const auto kept = view.dividers();
    EXPECT_GT(kept.side, 0.0);
    divider->mouseDoubleClick(mouseAt(*divider, {4.0f, 4.0f}));
    EXPECT_EQ(tabs.getWidth(), before);
    view.setDividers(kept);
    EXPECT_NEAR(tabs.getWidth(), dragged - 16, 1);
    auto& lower = the<Divider>(view, "Divider of upper and lower panels");
    const int high = the(view, "Scope").getHeight();
    lower.onMove(-40);
    EXPECT_NEAR(the(view, "Scope").getHeight(), high + 40, 1);
    EXPECT_TRUE(lower.keyPressed(KeyPress{KeyPress::downKey}));
    EXPECT_NEAR(the(view, "Scope").getHeight(), high + 24, 1);
    auto& between = the<Divider>(view, "Divider of scope and strips");
    const int wide = the(view, "Mixer").getWidth();
    between.onMove(30);
    EXPECT_NEAR(the(view, "Mixer").getWidth(), wide - 30, 1);
}

TEST_F(ArrangedView, ANarrowBarHasTwoLinesAndNothingOfItIsCut) {
    for (const auto& [width, height] : sizes) {
        view.setSize(width, height);
        auto* bar = find(view, "Transport and device");
        EXPECT_EQ(bar->getHeight() > TopBar::lineHeight, width < 1260) << width;
        std::vector<juce::Rectangle<int>> places;
        for (auto* child : bar->getChildren()) {
            if (child->getBounds().isEmpty() || !child->isVisible()) continue;
            EXPECT_TRUE(bar->getLocalBounds().contains(child->getBounds()))
                << child->getTitle() << " at " << width;
            for (const auto& other : places)
                EXPECT_TRUE(other.getIntersection(child->getBounds()).isEmpty())
                    << child->getTitle() << " at " << width;
            places.push_back(child->getBounds());
        }
        EXPECT_GE(the(*bar, "Device state").getWidth(), 200) << width;
    }
}

TEST_F(ArrangedView, TheToolsKeepTheirSizeInALowWindow) {
    for (const auto& [width, height] : sizes) {
        view.setSize(width, height);
        auto& tools = the(view, "Tools");
        for (auto* tool : tools.getChildren()) {
            EXPECT_GE(tool->getHeight(), 26) << tool->getTitle() << " at " << height;
            EXPECT_TRUE(tools.getLocalBounds().contains(tool->getBounds()))
                << tool->getTitle() << " at " << height;
        }
        std::map<int, int> columns, rows;
        for (auto* tool : tools.getChildren()) ++columns[tool->getX()], ++rows[tool->getY()];
        for (const auto& [y, inLine] : rows)
            EXPECT_EQ(static_cast<std::size_t>(inLine), columns.size()) << y << " at " << height;
        for (int j = 0; j < 4; ++j) {
            auto& world = view.world().view();
            const auto badge = view.world().getLocalPoint(&world, world.actuatorPixel(j)).toInt();
            EXPECT_FALSE(tools.getBounds().expanded(12).contains(badge)) << j << " at " << width;
            EXPECT_FALSE(view.world().bannerArea().expanded(0, 12).contains(badge)) << j << " at " << width;
        }
    }
}

TEST_F(ArrangedView, AMessageLiesOverTheWorldAndMovesNothing) {
    view.setSize(1440, 900);
    const auto before = view.world().getBounds();
    const auto place = view.world().view().actuatorPixel(0);
    model.report("a fault");
    model.dispatchPendingMessages();
    auto* banner = find(view, "Trouble");
    ASSERT_TRUE(banner->isVisible());
    EXPECT_EQ(view.world().getBounds(), before);
    EXPECT_EQ(view.world().view().actuatorPixel(0), place);
    EXPECT_TRUE(before.contains(banner->getBounds()));
    EXPECT_GT(view.getIndexOfChildComponent(banner), view.getIndexOfChildComponent(&view.world()))
        << "over it";
    EXPECT_TRUE(banner->findColour(juce::Label::backgroundColourId).isOpaque());
}

TEST_F(ArrangedView, AShowIsTheWorldAndTheButtonThatSilences) {
    view.setSize(1440, 900);
    view.setShowMode(true);
    EXPECT_EQ(view.world().getBounds(), view.getLocalBounds());
    auto& silence = the(view, "Silence");
    EXPECT_TRUE(silence.isVisible());
    EXPECT_GE(silence.getWidth(), 120);
    for (const char* title : {"Tabs", "Scope", "Mixer", "Tools", "Record", "Drag strength"})
        EXPECT_FALSE(the(view, title).isVisible()) << title;
    view.keyPressed(KeyPress{KeyPress::escapeKey});
    EXPECT_TRUE(model.isSilent());
    view.setShowMode(false);
    for (const char* title : {"Tabs", "Scope", "Mixer", "Tools", "Record", "Drag strength"})
        EXPECT_TRUE(the(view, title).isVisible()) << title;
    EXPECT_LT(view.world().getWidth(), view.getWidth());
}

TEST_F(ArrangedView, APageWithoutRoomScrolls) {
    view.setSize(1280, 720);
    view.setPanels({true, true});
    view.tabs().choose("Output");
    view.refresh(); // what it says takes room
    auto* page = view.tabs().find<OutputTab>();
    EXPECT_GE(page->getHeight(), page->minHeight(page->getWidth()));
    auto* viewport = page->findParentComponentOfClass<juce::Viewport>();
    ASSERT_NE(viewport, nullptr);
    EXPECT_LT(viewport->getHeight(), page->getHeight());
    EXPECT_TRUE(viewport->isVerticalScrollBarShown());
    view.setSize(1016, 660); // a display of 1024 x 700 without the window's frame
    for (const juce::Component* other : {static_cast<juce::Component*>(view.tabs().find<StudiesTab>()),
                                         static_cast<juce::Component*>(view.tabs().find<MaterialsTab>())})
        EXPECT_LE(other->getHeight(), other->findParentComponentOfClass<juce::Viewport>()->getHeight());
    view.setSize(3840, 2160);
    EXPECT_EQ(viewport->getHeight(), page->getHeight());
}

TEST_F(ArrangedView, TheListOfMaterialsShowsWholeRows) {
    view.setSize(1016, 660);
    view.tabs().choose("Materials");
    auto& list = the<juce::ListBox>(view, "List of materials");
    EXPECT_GE(list.getHeight(), 5 * list.getRowHeight());
    EXPECT_EQ(list.getHeight() % list.getRowHeight(), 0);
}

TEST_F(ArrangedView, TheListOfActuatorsShowsWholeRows) {
    attachUpTo(12);
    for (const auto& [width, height] : sizes) {
        view.setSize(width, height);
        view.tabs().choose("Actuators");
        auto* list = dynamic_cast<juce::ListBox*>(find(view, "List of actuators"));
        const auto* viewport = list->findParentComponentOfClass<juce::Viewport>();
        const int seen = viewport->getLocalBounds()
                             .getIntersection(viewport->getLocalArea(list, list->getLocalBounds()))
                             .getHeight();
        EXPECT_EQ(seen, list->getHeight()) << "the page does not scroll at " << width << "x" << height;
        EXPECT_GE(seen, 2 * list->getRowHeight()) << width << "x" << height;
        EXPECT_EQ(seen % list->getRowHeight(), 0) << width << "x" << height;
    }
}

TEST_F(ArrangedView, TheStrongestHitIsToldInLinesThatFit) {
    auto& sentence = the<juce::Label>(view, "Strongest hit");
    for (const auto& [width, height] : sizes) {
        view.setSize(width, height);
        ASSERT_TRUE(runUntil([&] { return view.refresh(), sentence.getText().contains(" g "); }, 10.0));
        const auto lines = juce::StringArray::fromLines(sentence.getText());
        EXPECT_LE(lines.size(), 2);
        for (const auto& line : lines) {
            EXPECT_LE(text::pixelWidth(sentence.getFont(), line), sentence.getWidth() - 10)
                << line << " at " << width;
            EXPECT_FALSE(line.trimStart().startsWith("/")) << line;
        }
    }
}

TEST_F(ArrangedView, TheScopeSaysHowManyItShowsWhereThereIsLittleRoom) {
    attachUpTo(64);
    for (const auto& [width, height] : sizes) {
        view.setSize(width, height);
        auto* scope = view.scope().find<ScopeView>();
        auto& spectra = the(view, "Spectra");
        const int lanes = (spectra.isVisible() ? spectra.getX() - gap : scope->getWidth()) - 26;
        EXPECT_GE(lanes, text::pixelWidth(text::font(text::small), "the first 8 of 64")) << width;
    }
}

} // namespace physvib::arrangement_test
