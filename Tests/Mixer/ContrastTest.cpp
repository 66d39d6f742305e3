// SPDX-License-Identifier: GPL-3.0-or-later
// Every text of the window stands out by 4.5, every control by 3, in both looks, as measured in pictures.
#include "Contrast.h"
#include "Mixer/Widgets/Cards.h"
#include "MixerTesting.h"

namespace physvib {
namespace {

using namespace test;

constexpr double leastOfText = 4.5, leastOfControl = 3.0;
constexpr float scale = 2.0f;

bool isControl(const juce::Component& c) {
    const auto* bar = dynamic_cast<const juce::ScrollBar*>(&c);
    return dynamic_cast<const juce::Button*>(&c) || dynamic_cast<const juce::ComboBox*>(&c) ||
           dynamic_cast<const juce::Slider*>(&c) || dynamic_cast<const juce::TextEditor*>(&c) ||
           dynamic_cast<const Divider*>(&c) || (bar && bar->isVisible());
}

juce::String nameOf(const juce::Component* c) {
    juce::String name;
    for (; c != nullptr; c = c->getParentComponent())
        if (c->getTitle().isNotEmpty()) name = c->getTitle() + (name.isEmpty() ? "" : " < " + name);
    return name;
}

/// What is seen of it: a page that scrolls shows a part.
juce::Rectangle<int> seenOf(juce::Component& root, juce::Component& c) {
    auto area = root.getLocalArea(&c, c.getLocalBounds());
    for (auto* p = c.getParentComponent(); p != nullptr && p != root.getParentComponent();
         p = p->getParentComponent())
        area = area.getIntersection(root.getLocalArea(p, p->getLocalBounds()));
    return area;
}

void expectControls(juce::Component& root, juce::Component& c, const Picture& picture,
                    const std::string& state) {
    for (auto* child : c.getChildren()) {
        if (!child->isVisible()) continue;
        const auto seen = seenOf(root, *child);
        auto* on = seen.isEmpty() ? nullptr : root.getComponentAt(seen.getCentre());
        const bool isSeen = on != nullptr && (on == child || child->isParentOf(on) || on->isParentOf(child));
        if (isControl(*child) && isSeen && child->isEnabled() && seen.getHeight() >= child->getHeight() / 2)
            EXPECT_GE(contrastOfControl(picture.image, seen * juce::roundToInt(scale)), leastOfControl)
                << state << ": " << nameOf(child) << " at " << seen.toString();
        expectControls(root, *child, picture, state);
    }
}

struct Contrasts : testing::TestWithParam<Theme> {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::firstMix(), {.isPaused = true}};
    MixerView view{model};

    Contrasts() {
        view.setSize(1280, 720);
        view.setTheme(GetParam() == Theme::dark ? Theme::light : Theme::dark);
        view.setTheme(GetParam()); // what was written in the other is read in this one
    }
    void expectReadable(const std::string& state) {
        model.dispatchPendingMessages();
        for (int k = 0; k < 2; ++k) view.refresh();
        const auto picture = pictureOf(view, scale);
        for (const auto& text : picture.texts) {
            const auto at = (text.area.toFloat() / scale).getCentre().toInt();
            EXPECT_GE(text.contrast, leastOfText)
                << state << ": " << nameOf(view.getComponentAt(at)) << " at " << at.toString() << ", "
                << text.ink.toDisplayString(false) << " on " << text.ground.toDisplayString(false);
        }
        EXPECT_GT(picture.texts.size(), 5U) << state;
        expectControls(view, view, picture, state);
    }
};

TEST_P(Contrasts, OfEveryPage) {
    for (auto* panel : {&view.tabs(), &view.scope()})
        for (const auto& name : panel->names()) {
            panel->choose(name);
            expectReadable(name.toStdString());
        }
}

TEST_P(Contrasts, OfStatesAndTools) {
    model.change("Strips", [](Mix& m) {
        m.strips[0].isMuted = m.strips[1].isSolo = m.strips[2].isInverted = true;
        m.strips[3].delayMs = 5.0;
    });
    model.report("session.json: expected a number, found none");
    expectReadable("muted and a fault");
    model.setSilent(true);
    expectReadable("silent");
    view.world().drawing().use(DrawTool::rain);
    expectReadable("rain");
    view.world().drawing().use(DrawTool::choose);
    view.world().drawing().choose({model.world().scene().bodies.front().name});
    expectReadable("a body");
}

TEST_P(Contrasts, OfTheStrongestHit) {
    const auto* sentence = dynamic_cast<juce::Label*>(find(view, "Strongest hit"));
    ASSERT_NE(sentence, nullptr);
    model.setSlowness(1);
    ASSERT_TRUE(runUntil([&] { return view.refresh(), sentence->getText().contains(" g "); }, 10.0));
    model.setSlowness(0);
    expectReadable("a hit");
}

TEST_P(Contrasts, OfSixtyFourActuators) {
    while (model.mix().count() < 64 && model.attach(0.5, 0.5)) {
    }
    expectReadable("64 actuators");
}

TEST_P(Contrasts, OfCards) {
    view.setFirstStart(std::make_unique<FirstStart>(
        model, std::vector<FeltChoice>{{"JACK:system, 8 outputs", noDevice, 8},
                                       {"No device: seen, not felt", noDevice, 0}}));
    expectReadable("first start");
    view.setFirstStart(nullptr);
    TestFolder folder;
    folder("there.json").replaceWithText("{}");
    view.setCard(
        std::make_unique<FileCard>(FileCard::Choice{"Save", ".json", folder.folder, true, "session"}));
    expectReadable("files");
    view.setCard(std::make_unique<QuestionCard>(
        "Share", "Words of the question",
        std::vector<QuestionCard::Answer>{{"Take", [] {}}, {"Cancel", [] {}}},
        std::vector<QuestionCard::Field>{{"Link", "http://127.0.0.1:8000/#scene=shake-the-box"}}));
    expectReadable("question");
}

INSTANTIATE_TEST_SUITE_P(Looks, Contrasts, testing::Values(Theme::dark, Theme::light),
                         [](const auto& theme) { return theme.param == Theme::dark ? "dark" : "light"; });

} // namespace
} // namespace physvib
